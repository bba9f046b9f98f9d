#include "picture/contour_map.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "output/columns.hpp"
#include "picture/contour_labels.hpp"
#include "picture/gnuplot.hpp"
#include "picture/gnuplot_script.hpp"
#include "picture/paper.hpp"

namespace gearlash {
namespace {

constexpr double unseen = 1.5e-3;  ///< on paper: a seventh of an SVG's pixel

constexpr double label_scale = 0.85;
constexpr double shortest_drawn = 0.35;  ///< shorter contours would be clutter

/// The size of the numbers on contours.
LetterSize letter_size(PictureFormat format) {
  const double letters_a_line = format == PictureFormat::svg   ? 54.0
                                : format == PictureFormat::png ? 75.0
                                                               : 46.0;
  return {label_scale * 0.55 * 9.0 / letters_a_line, label_scale * 9.0 / letters_a_line};
}

std::string line_style(double width, const std::string& colour) {
  return fmt::format("linewidth {} linecolor rgb '{}'", width, colour);
}
std::string boundary_style() { return line_style(3.0, "#d55e00"); }
std::string inner_boundary_style() { return line_style(1.5, "#606060") + " dashtype 2"; }
std::string mark_style() { return "pointtype 7 pointsize 1 linecolor rgb '#000000'"; }
std::string hatching_style() { return line_style(0.6, "#a8a8a8"); }

/// A colour from light to dark blue.
std::string colour_of(std::size_t number, std::size_t count) {
  const double share =
      count < 2 ? 1.0 : static_cast<double>(number) / (static_cast<double>(count) - 1.0);
  const auto mixed = [&](double light, double dark) {
    return static_cast<int>(std::lround(light + share * (dark - light)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(104, 8), mixed(172, 44), mixed(214, 107));
}

void add_line(DataBlock& block, const PaperLine& line, const Paper& paper) {
  if (!block.is_empty()) block.gap();
  for (const PaperPoint& point : line) {
    const MapPoint place = paper.point_on_map(point);
    block.row(place.x, place.y);
  }
}

DataBlock curves_block(const std::string& name, const std::vector<MapCurve>& curves,
                       const Paper& paper) {
  DataBlock block(name);
  for (const MapCurve& curve : curves) {
    add_line(block, thinned(paper.line_on_paper(curve), unseen), paper);
  }
  return block;
}

std::string label_command(const ContourLabel& label, const Paper& paper) {
  const MapPoint place = paper.point_on_map(label.centre);
  return fmt::format("set label {} at {:.7g}, {:.7g} center rotate by {:.1f} front\n",
                     quoted(label.text, "/*0.85"), place.x, place.y, label.slope);
}

/// The commands and layers of the picture, bottom to top.
struct Drawing {
  std::string commands = {};
  std::vector<std::string> layers = {};

  void add(const DataBlock& block, const std::string& name, const std::string& style) {
    if (block.is_empty()) return;
    commands += block.text();
    layers.push_back(fmt::format("${} using 1:2 with lines {} notitle", name, style));
  }
};

/// Adds the contours, with numbers in their longer parts.
void add_contours(const ContourMap& map, const Paper& paper, PictureFormat format,
                  Drawing& drawing) {
  std::vector<std::vector<PaperLine>> contours;
  std::vector<PaperLine> all;
  const auto keep = [&](const std::vector<MapCurve>& curves) {
    std::vector<PaperLine> lines;
    for (const MapCurve& curve : curves) {
      const PaperLine line = thinned(paper.line_on_paper(curve), unseen);
      if (length_of(line) > shortest_drawn) lines.push_back(line);
    }
    all.insert(all.end(), lines.begin(), lines.end());
    return lines;
  };
  keep(map.boundary);
  for (const Contour& contour : map.contours) contours.push_back(keep(contour.curves));
  LabelPlacer placer(all, letter_size(format));
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const std::string name = fmt::format("contour{}", i);
    DataBlock block(name);
    for (const PaperLine& line : contours[i]) {
      const auto labelled = placer.place(line, fmt::format("{:.4g}", map.contours[i].level));
      if (labelled.label) drawing.commands += label_command(*labelled.label, paper);
      for (const PaperLine& piece : labelled.pieces) add_line(block, piece, paper);
    }
    drawing.add(block, name, line_style(1.3, colour_of(i, contours.size())));
  }
}

/// A line in shares of the picture.
std::string screen_line(double from_right, double from_up, double to_right, double to_up,
                        const std::string& style) {
  return fmt::format("set arrow from screen {:.4f}, {:.4f} to screen {:.4f}, {:.4f} nohead {}\n",
                     from_right, from_up, to_right, to_up, style);
}

/// A sample of each kind of line with its meaning, side by side below the axis. gnuplot's own
/// legend has no hatching that looks the same in all formats.
std::string legend(const ContourMap& map, PictureFormat format) {
  constexpr double sample = 0.05;  // shares of the picture's width
  constexpr double space = 0.012;
  constexpr double between = 0.05;
  constexpr double middle = 0.04;  // shares of its height
  constexpr double half_height = 0.013;
  constexpr double slant = 2.0 * half_height * 7.0 / 9.0;
  const double letter = letter_size(format).width / label_scale / 9.0;
  const std::array shown = {!map.contours.empty(), !map.boundary.empty(), !map.hatching.empty(),
                            !map.inner_hatching.empty(), map.mark.has_value()};
  const std::array meanings = {map.contour_meaning, map.boundary_meaning, map.hatching_meaning,
                               map.inner_meaning, map.mark_meaning};
  double width = -between;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double text = letter * static_cast<double>(width_in_columns(meanings[i]));
    if (shown[i]) width += sample + space + text + between;
  }
  double right = 0.5 * (Paper::left_margin + Paper::right_margin - width);
  std::string commands = "unset key\n";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i]) continue;
    if (i < 2) {
      commands += screen_line(right, middle, right + sample, middle,
                              i == 0 ? line_style(1.3, "#2e6fa8") : boundary_style());
    }
    const bool is_hatched = i == 2 || i == 3;
    const double spacing = i == 2 ? 0.0085 : 0.00425;
    for (double place = 0.0; is_hatched && place + slant <= sample; place += spacing) {
      commands += screen_line(right + place, middle - half_height, right + place + slant,
                              middle + half_height, hatching_style());
    }
    if (i == 4) {
      commands += fmt::format("set label '' at screen {:.4f}, {:.4f} point {}\n",
                              right + 0.5 * sample, middle, mark_style());
    }
    commands += fmt::format("set label {} at screen {:.4f}, {:.4f} left\n", quoted(meanings[i]),
                            right + sample + space, middle);
    right += sample + space + between + letter * static_cast<double>(width_in_columns(meanings[i]));
  }
  return commands;
}

}  // namespace

std::string draw_contour_map(const ContourMap& map, PictureFormat format) {
  const Paper paper(map.x, map.y);
  Drawing drawing;
  drawing.commands = terminal(format) + heading(map.title, map.subtitle);
  drawing.commands +=
      fmt::format("set lmargin screen {}\nset rmargin screen {}\nset bmargin screen {}\n",
                  Paper::left_margin, Paper::right_margin, Paper::bottom_margin);
  drawing.commands += axis_commands('x', map.x) + axis_commands('y', map.y) + legend(map, format);
  drawing.add(curves_block("hatching", map.hatching, paper), "hatching", hatching_style());
  drawing.add(curves_block("inner_hatching", map.inner_hatching, paper), "inner_hatching",
              hatching_style());
  drawing.add(curves_block("inner_boundary", map.inner_boundary, paper), "inner_boundary",
              inner_boundary_style());
  add_contours(map, paper, format, drawing);
  drawing.add(curves_block("boundary", map.boundary, paper), "boundary", boundary_style());
  if (map.mark) {
    DataBlock block("mark");
    block.row(map.mark->x, map.mark->y);
    drawing.commands += block.text();
    drawing.layers.push_back("$mark using 1:2 with points " + mark_style() + " notitle");
  }
  if (drawing.layers.empty()) drawing.layers.emplace_back("1/0 notitle");  // keeps the axes
  return run_gnuplot(drawing.commands + plot_command(drawing.layers), map.title);
}

}  // namespace gearlash
