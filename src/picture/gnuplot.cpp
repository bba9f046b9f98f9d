#include "picture/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/lists.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"

namespace gearlash {
namespace {

// ---- texts --------------------------------------------------------------------------------------

/// The number of letters from `place` on that are a subscript: "n" after "ω_", or the letters after
/// a single capital and "_", as in J_L and F_Total. Names such as "my_servo" have none.
std::size_t subscript_length(const std::string& text, std::size_t place) {
  const auto is_letter = [&](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  if (place < 2 || text[place - 1] != '_') return 0;
  const bool after_omega = text.substr(0, place - 1).ends_with("ω");
  const bool after_capital = std::isupper(static_cast<unsigned char>(text[place - 2])) != 0 &&
                             (place == 2 || (text[place - 3] != '_' && !is_letter(place - 3)));
  if (!after_omega && !after_capital) return 0;
  std::size_t length = 0;
  while (is_letter(place + length)) ++length;
  return length;
}

/// gnuplot text in single quotes, all of it in `style` if one is given. Quotes and markup in the
/// text are escaped; only subscripts such as those of ω_n and J_L are set low.
std::string quoted(const std::string& text, const std::string& style = "") {
  std::string safe = style.empty() ? "'" : "'{" + style + " ";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) < 0x20) continue;
    if (const std::size_t length = subscript_length(text, i + 1); c == '_' && length > 0) {
      safe += "_{" + text.substr(i + 1, length) + "}";
      i += length;
      continue;
    }
    if (std::string_view("\\_^{}@&~").find(c) != std::string_view::npos) safe += '\\';
    safe += c;
    if (c == '\'') safe += c;
  }
  return safe + (style.empty() ? "'" : "}'");
}

/// The text in as many lines as it needs, of about the same length.
std::vector<std::string> in_lines(const std::string& text, std::size_t width) {
  constexpr std::size_t word = 8;
  const std::size_t count = width_in_columns(text) / width + 1;
  const std::size_t even = width_in_columns(text) / count + word;
  std::istringstream wrapped_text(wrapped(text, std::min(even, width)));
  std::vector<std::string> lines;
  for (std::string line; std::getline(wrapped_text, line);) lines.push_back(line);
  return lines;
}

/// In letters.
std::size_t longest(const std::vector<Tic>& tics) {
  std::size_t length = 0;
  for (const Tic& tic : tics) length = std::max(length, width_in_columns(tic.text));
  return length;
}

// ---- the page -----------------------------------------------------------------------------------

// Pixels of a picture 900 wide.
constexpr double page_width = 900.0;
constexpr double title_line = 24.0;
constexpr double subtitle_line = 22.0;
constexpr double between_panels = 12.0;
constexpr double panel_title = 26.0;
constexpr double axis_room = 72.0;
constexpr double legend_line = 24.0;
constexpr double letter = 8.6;

/// A panel with its place on the page.
struct PlacedPanel {
  const Panel& panel;
  double left;
  double right;
  double top;  ///< from the page's top
  bool is_last;

  double bottom() const { return top + panel.height; }
  /// Long names below the axis are slanted.
  bool is_slanted() const {
    std::size_t letters = 0;
    for (const Tic& tic : panel.x.tics) letters += width_in_columns(tic.text);
    return static_cast<double>(letters) * letter > right - left;
  }
};

struct Page {
  double height = 0.0;
  std::vector<std::string> titles = {};
  std::vector<std::string> subtitles = {};
  std::vector<PlacedPanel> panels = {};
  std::vector<const Layer*> legend = {};
  int legend_columns = 1;
};

void place_column(const PlotColumn& column, double from, double to, double top, Page& page) {
  std::size_t names = 0;
  for (const Panel& panel : column) names = std::max(names, longest(panel.y.tics));
  constexpr double shortest_names = 95.0;
  const double left = from + std::max(shortest_names, 58.0 + letter * static_cast<double>(names));
  const double right = to - 0.03 * (to - from) - 1.0;
  for (const Panel& panel : column) {
    if (!panel.title.empty() && &panel != &column.front()) top += panel_title;
    page.panels.push_back({panel, left, right, top, &panel == &column.back()});
    top += panel.height + between_panels;
  }
  const PlacedPanel& last = page.panels.back();
  const double slanted =
      last.is_slanted() ? 0.6 * letter * static_cast<double>(longest(last.panel.x.tics)) : 0.0;
  page.height = std::max(page.height, last.bottom() + axis_room + slanted);
}

void place_legend(const Plot& plot, Page& page) {
  std::size_t length = 1;
  for (const PlotColumn& column : plot.columns) {
    for (const Panel& panel : column) {
      for (const Layer& layer : panel.layers) {
        if (!layer.in_legend) continue;
        page.legend.push_back(&layer);
        length = std::max(length, width_in_columns(layer.name));
      }
    }
  }
  constexpr double sample = 6.0;  // letters
  constexpr double line = 88.0;
  page.legend_columns =
      std::clamp(static_cast<int>(line / (sample + static_cast<double>(length))), 1, 4);
  const auto entries = static_cast<double>(page.legend.size());
  page.height += 10.0 + legend_line * std::ceil(entries / page.legend_columns);
}

Page page_of(const Plot& plot) {
  constexpr std::size_t letters_of_title = 84;
  constexpr std::size_t letters_of_subtitle = 104;
  Page page{.titles = in_lines(plot.title, letters_of_title)};
  for (const std::string& subtitle : plot.subtitles) {
    for (std::string& line : in_lines(subtitle, letters_of_subtitle)) {
      page.subtitles.push_back(std::move(line));
    }
  }
  const bool has_titles =
      any_of(plot.columns, [](const PlotColumn& column) { return !column.front().title.empty(); });
  const double top = 20.0 + title_line * static_cast<double>(page.titles.size()) +
                     subtitle_line * static_cast<double>(page.subtitles.size()) +
                     (has_titles ? panel_title : 0.0);
  const double width = page_width / static_cast<double>(plot.columns.size());
  for (std::size_t i = 0; i < plot.columns.size(); ++i) {
    place_column(plot.columns[i], width * static_cast<double>(i),
                 width * static_cast<double>(i + 1), top, page);
  }
  place_legend(plot, page);
  return page;
}

// ---- commands -----------------------------------------------------------------------------------

double font_size(PictureFormat format) {
  return format == PictureFormat::svg ? 15.0 : format == PictureFormat::png ? 25.0 : 8.2;
}

std::string terminal(PictureFormat format, double height) {
  const std::string font = fmt::format("enhanced font 'sans-serif,{}'", font_size(format));
  switch (format) {
    case PictureFormat::svg:
      return fmt::format(
          "set terminal svg {} size 900,{:.0f} background rgb 'white' linewidth 1.2\n", font,
          height);
    case PictureFormat::png:
      return fmt::format(
          "set terminal pngcairo {} size 1800,{:.0f} linewidth 2.4 dashlength 1.4 pointscale 2\n",
          font, 2.0 * height);
    case PictureFormat::pdf:
      return fmt::format("set terminal pdfcairo {} size 18cm,{:.4g}cm linewidth 1.2\n", font,
                         height / 50.0);
  }
  return "";
}

std::string heading(const Page& page) {
  const double middle = 0.5 * (page.panels.front().left + page.panels.back().right) / page_width;
  std::string labels;
  double from_top = 22.0;
  const auto add = [&](const std::string& text, const char* style, double line) {
    labels += fmt::format("set label {} at screen {:.4f}, screen {:.4f} center\n",
                          quoted(text, style), middle, 1.0 - from_top / page.height);
    from_top += line;
  };
  for (const std::string& title : page.titles) add(title, "/:Bold", title_line);
  for (const std::string& subtitle : page.subtitles) add(subtitle, "/*0.87", subtitle_line);
  return labels;
}

/// `name` is 'x' or 'y'.
std::string axis_commands(char name, const PlotAxis& axis, bool is_numbered, bool is_slanted) {
  const auto tic_text = [&](const Tic& tic) {
    return fmt::format("{} {:.9g}{}", quoted(is_numbered ? tic.text : ""), tic.at,
                       tic.text.empty() ? " 1" : "");
  };
  const std::string grid =
      fmt::format("set grid {}tics linewidth 0.5 linecolor rgb '#c4c4c4'\n", name);
  return fmt::format(
      "set {0}range [{1:.9g}:{2:.9g}]\n{3}set logscale {0}\nset {0}tics {4} ({5})\n{6}", name,
      axis.low, axis.high, axis.logarithmic ? "" : "un",
      is_slanted ? "rotate by 35 right" : "norotate", listed(axis.tics, tic_text),
      axis.has_grid ? grid : "");
}

/// The names of the axes: gnuplot leaves out one of y for which it sees no room.
std::string axis_labels(const PlacedPanel& placed) {
  constexpr double from_numbers = 46.0;
  const double left =
      placed.left - from_numbers - letter * static_cast<double>(longest(placed.panel.y.tics));
  return fmt::format(
      "set xlabel {}\nset label {} at screen {:.4f}, graph 0.5 center rotate by 90\n",
      quoted(placed.is_last ? placed.panel.x.label : ""), quoted(placed.panel.y.label),
      left / page_width);
}

/// How gnuplot draws the layer, from its colour on.
std::string style_of(const Layer& layer) {
  switch (layer.kind) {
    case LayerKind::line:
      return fmt::format("lines linewidth {} dashtype {} linecolor rgb '{}'", layer.width,
                         layer.dashes.empty() ? "1" : "(" + layer.dashes + ")", layer.colour);
    case LayerKind::area:
      return fmt::format("filledcurves closed fillstyle solid noborder linecolor rgb '{}'",
                         layer.colour);
    case LayerKind::marks:
      return fmt::format("points pointtype {} pointsize {} linewidth 1.4 linecolor rgb '{}'",
                         static_cast<int>(layer.mark) + 1, layer.size, layer.colour);
  }
  return "";
}

std::string legend_entry(const Layer& layer) {
  const std::string style =
      layer.kind == LayerKind::area
          ? fmt::format("boxes fillstyle solid border linecolor rgb '#a0a0a0' fillcolor rgb '{}'",
                        layer.colour)
          : style_of(layer);
  return "keyentry with " + style + " title " + quoted(layer.name);
}

std::string plot_command(const std::vector<std::string>& layers) {
  return fmt::format("plot 1/0 notitle{}{}\n", layers.empty() ? "" : ", \\\n     ",
                     fmt::join(layers, ", \\\n     "));
}

std::string data_of(const Layer& layer, const std::string& name) {
  std::string rows;
  for (const MapPoint& point : layer.points) {
    const bool is_drawn = std::isfinite(point.x) && std::isfinite(point.y);
    rows += is_drawn ? fmt::format("{:.14g} {:.14g}\n", point.x, point.y) : "\n";
  }
  return fmt::format("${} << EOD\n{}EOD\n", name, rows);
}

std::string text_command(const PlotText& text) {
  return fmt::format(
      "set label {} at {:.7g},{:.7g} center rotate by {:.1f} front textcolor rgb '{}'\n",
      quoted(text.text, fmt::format("/{}*{}", text.is_bold ? ":Bold" : "", text.size)), text.at.x,
      text.at.y, text.slope, text.colour);
}

std::string panel_commands(const PlacedPanel& placed, std::size_t number, double height) {
  const Panel& panel = placed.panel;
  std::string script = fmt::format(
                           "unset grid\n"
                           "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
                           "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
                           placed.left / page_width, placed.right / page_width,
                           1.0 - placed.top / height, 1.0 - placed.bottom() / height) +
                       axis_commands('x', panel.x, placed.is_last, placed.is_slanted()) +
                       axis_commands('y', panel.y, true, false) + axis_labels(placed);
  if (!panel.title.empty()) {
    script += fmt::format("set label {} at graph 0.5, graph 1 center offset 0,0.7\n",
                          quoted(panel.title, "/*0.87"));
  }
  for (const PlotText& text : panel.texts) script += text_command(text);
  std::vector<std::string> layers;
  for (std::size_t i = 0; i < panel.layers.size(); ++i) {
    const Layer& layer = panel.layers[i];
    const auto is_drawn = [](const MapPoint& point) { return std::isfinite(point.x + point.y); };
    if (!any_of(layer.points, is_drawn)) continue;
    const std::string name = fmt::format("layer{}_{}", number, i);
    script += data_of(layer, name);
    layers.push_back(fmt::format("${} using 1:2 with {} notitle", name, style_of(layer)));
  }
  return script + plot_command(layers) + "unset label\n";
}

std::string legend_commands(const Page& page, PictureFormat format) {
  const auto entries = of_each(page.legend, [](const Layer* one) { return legend_entry(*one); });
  return fmt::format(
             "set lmargin at screen 0.02\nset rmargin at screen 0.98\nunset border\nunset tics\n"
             "unset grid\nunset xlabel\nunset logscale\n"
             "set key at screen 0.53, screen 0.004 bottom center horizontal Left reverse samplen 3 "
             "spacing 1.2 maxcols {} font ',{:.3g}'\n",
             page.legend_columns, 0.87 * font_size(format)) +
         plot_command(entries);
}

// ---- the program --------------------------------------------------------------------------------

[[noreturn]] void fail(const std::string& reason) { throw OutputError("gnuplot: " + reason); }

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }  // NOLINT: owned by unique_ptr
};
using File = std::unique_ptr<std::FILE, FileCloser>;

std::string system_message() { return std::generic_category().message(errno); }

/// Opens a nameless file in `folder`, so that nothing is left behind.
int open_nameless(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR, S_IRUSR | S_IWUSR);
  if (descriptor >= 0) return descriptor;
#endif
  std::string name = (folder / "gearlash-XXXXXX").string();
  const int named = mkstemp(name.data());
  if (named >= 0) unlink(name.c_str());
  return named;
}

File nameless_file() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) fail("no folder for temporary files, see TMPDIR: " + error.message());
  const int descriptor = open_nameless(folder);
  File file(descriptor < 0 ? nullptr : fdopen(descriptor, "w+"));
  if (!file) fail("no temporary file in " + shown(folder.string()) + ": " + system_message());
  return file;
}

void fill(std::FILE* file, const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fflush(file) != 0) {
    fail("its script cannot be written: " + system_message());
  }
  std::rewind(file);
}

std::string contents(std::FILE* file) {
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file)) {
    text.append(block.data(), count);
  }
  if (std::ferror(file) != 0) fail("its picture cannot be read: " + system_message());
  return text;
}

/// gnuplot in a shell whose words are ours alone, with an environment that the user's settings and
/// language have no part in.
std::string command(std::FILE* script, std::FILE* messages) {
  return fmt::format(
      "exec env -i PATH=\"$PATH\" HOME=\"$HOME\" LC_ALL=C.UTF-8 "
      "gnuplot -d - < /dev/fd/{} 2> /dev/fd/{}",
      fileno(script), fileno(messages));
}

// ---- the picture --------------------------------------------------------------------------------

/// Checks the picture's end, because gnuplot's exit status is 0 even if its output was lost.
bool is_whole(std::string_view picture) {
  while (picture.ends_with('\n')) picture.remove_suffix(1);
  if (picture.starts_with("<?xml")) return picture.ends_with("</svg>");
  if (picture.starts_with("%PDF-")) return picture.ends_with("%%EOF");
  return picture.starts_with("\x89PNG") && picture.ends_with("IEND\xAE\x42\x60\x82");
}

/// Overwrites the time of day, so that the same picture has the same bytes. Blanks keep the other
/// parts of a PDF at their offsets.
void blank_time_of_day(std::string& picture) {
  if (!picture.starts_with("%PDF-")) return;
  const std::size_t begin = picture.rfind("/CreationDate (D:");
  const std::size_t end = begin == std::string::npos ? begin : picture.find(')', begin);
  if (end != std::string::npos) picture.replace(begin, end + 1 - begin, end + 1 - begin, ' ');
}

std::string escaped_for_xml(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      safe += c;
    }
  }
  return safe;
}

void set_title(std::string& picture, const std::string& title) {
  constexpr std::string_view usual = "<title>Gnuplot</title>";
  const std::size_t place = picture.starts_with("<?xml") ? picture.find(usual) : std::string::npos;
  if (place == std::string::npos) return;
  picture.replace(place, usual.size(), "<title>" + escaped_for_xml(title) + "</title>");
}

}  // namespace

std::string run_gnuplot(const std::string& script, const std::string& title) {
  const File in = nameless_file();
  const File messages = nameless_file();
  fill(in.get(), script);
  std::FILE* const out = popen(command(in.get(), messages.get()).c_str(), "r");
  if (out == nullptr) fail("cannot be started: " + system_message());
  std::string picture = contents(out);
  const int status = pclose(out);
  constexpr int missing = 127;  // of a shell, and of env
  if (WIFEXITED(status) && WEXITSTATUS(status) == missing) {
    fail("not found; pictures need it: apt-get install gnuplot-nox");
  }
  const auto with_reason = [&](const std::string& fault) {
    std::rewind(messages.get());
    const std::string said = contents(messages.get());
    return said.empty() ? fault : fault + ": " + shown(said, 200);
  };
  if (status != 0 || picture.empty()) fail(with_reason("drew nothing"));
  if (!is_whole(picture)) fail(with_reason("drew part of the picture alone"));
  blank_time_of_day(picture);
  set_title(picture, title);
  return picture;
}

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

PictureFormat picture_format(const std::string& field, const std::filesystem::path& path) {
  const auto* const found =
      std::find(std::begin(picture_endings), std::end(picture_endings), ending_of(path));
  if (found != std::end(picture_endings)) {
    return static_cast<PictureFormat>(found - std::begin(picture_endings));
  }
  refuse(field, path.string(), "must end in .svg, .png or .pdf");
}

std::string gnuplot_script(const Plot& plot, PictureFormat format) {
  const Page page = page_of(plot);
  std::string script = terminal(format, page.height) +
                       "set encoding utf8\nset multiplot\nset tics nomirror out\n"
                       "set border linewidth 0.8\nset clip two\nunset key\n" +
                       heading(page);
  for (std::size_t i = 0; i < page.panels.size(); ++i) {
    script += panel_commands(page.panels[i], i, page.height);
  }
  if (!page.legend.empty()) script += legend_commands(page, format);
  return script + "unset multiplot\n";
}

std::string draw(const Plot& plot, PictureFormat format) {
  return run_gnuplot(gnuplot_script(plot, format), plot.title);
}

}  // namespace gearlash
