#include "picture/gnuplot_script.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "output/columns.hpp"

namespace gearlash {
namespace {

constexpr double rounding = 1e-9;
constexpr int most_steps = 6;  // of an axis

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

/// The number of gnuplot's labels on a logarithmic axis: powers of ten.
int decades_between(double low, double high) {
  return static_cast<int>(std::floor(std::log10(high) + rounding)) -
         static_cast<int>(std::ceil(std::log10(low) - rounding)) + 1;
}

/// Whether gnuplot's numbers would have so many zeros that they overlap.
bool needs_powers(const ChartAxis& axis) {
  if (!axis.tics.empty() || !axis.low || !axis.high) return false;
  return axis.logarithmic ? *axis.low < 0.99e-4 || *axis.high > 1.01e6 : *axis.high < 0.99e-4;
}

std::string tics_command(char name, const std::vector<std::string>& tics) {
  return fmt::format("set {}tics ({})\n", name, fmt::join(tics, ", "));
}

/// Equal steps, numbered as multiples of the same power of ten. The right end of an x axis has no
/// number, because half of it would not fit.
std::string even_tics(char name, double low, double high) {
  const int power = static_cast<int>(std::floor(std::log10(high)));
  const double step = round_step(high - low, most_steps);
  const double last = name == 'x' ? high - 0.03 * (high - low) : high * (1.0 + rounding);
  std::vector<std::string> tics;
  for (double i = std::ceil(low / step - rounding); i * step <= last; ++i) {
    const std::string number = fmt::format("{:.6g}", i * step / std::pow(10.0, power));
    const std::string label = i == 0.0 ? "0" : fmt::format("{}·10^{{{}}}", number, power);
    tics.push_back(fmt::format("'{}' {:.7g}", label, i * step));
  }
  return tics_command(name, tics);
}

/// Powers of ten, as many numbered as there is room for, and short tics between them; less than two
/// decades also show 2 and 5.
std::string power_tics(char name, double low, double high) {
  constexpr int most_numbers = 9;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::floor(std::log10(high) + rounding));
  const int step = (last - first) / most_numbers + 1;
  const bool is_short = std::log10(high / low) < 2.0;
  std::size_t numbers = 0;
  std::vector<std::string> tics;
  const auto add = [&](int digit, int power) {
    const double value = digit * std::pow(10.0, power);
    if (value < low * (1.0 - rounding) || value > high * (1.0 + rounding)) return;
    const bool has_number = digit == 1 ? power % step == 0 : is_short && (digit == 2 || digit == 5);
    if (has_number) ++numbers;
    const std::string factor = digit == 1 ? "" : fmt::format("{}·", digit);
    tics.push_back(has_number ? fmt::format("'{}10^{{{}}}' {:.7g}", factor, power, value)
                              : fmt::format("'' {:.7g} 1", value));
  };
  for (int power = first; power <= last; ++power) {
    for (int digit = 1; digit <= (step == 1 ? 9 : 1); ++digit) add(digit, power);
  }
  return numbers < 2 ? even_tics(name, low, high) : tics_command(name, tics);
}

/// Tics of an axis too short for two powers of ten: 1, 2 and 5, else even steps.
std::string short_log_tics(char name, double low, double high) {
  std::vector<std::string> tics;
  const auto add = [&](double value) {
    if (value < low * (1.0 - rounding) || value > high * (1.0 + rounding)) return;
    tics.push_back(fmt::format("'{:.6g}' {:.7g}", value, value));
  };
  const int first = static_cast<int>(std::floor(std::log10(low)));
  for (int power = first; power <= first + 2; ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) add(digit * std::pow(10.0, power));
  }
  if (tics.size() >= 2) return tics_command(name, tics);
  tics.clear();
  const double step = round_step(high - low, most_steps);
  for (double i = std::ceil(low / step); i * step <= high * (1.0 + rounding); ++i) add(i * step);
  return tics_command(name, tics);
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  if (width_in_columns(text) <= width) return {text};
  std::size_t place = text.rfind("; ", text.size() * 4 / 5);
  if (place == std::string::npos || place < text.size() / 4) {
    place = text.rfind(", ", text.size() * 3 / 5);
  }
  if (place != std::string::npos) return {text.substr(0, place + 1), text.substr(place + 2)};
  place = text.rfind(' ', text.size() / 2);
  if (place == std::string::npos) return {text};
  return {text.substr(0, place), text.substr(place + 1)};
}

double round_step(double length, int most) {
  const double least = length / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least) return digit * power;
  }
  return 10.0 * power;
}

std::string quoted(const std::string& text, const std::string& style) {
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

std::string terminal(PictureFormat format, double height) {
  switch (format) {
    case PictureFormat::svg:
      return fmt::format(
          "set terminal svg enhanced size 900,{:.0f} font 'sans-serif,15' background rgb 'white' "
          "linewidth 1.2\nset bmargin screen 0.25\n",
          height);
    case PictureFormat::png:
      return fmt::format(
          "set terminal pngcairo enhanced size 1800,{:.0f} font 'sans-serif,22' linewidth 2.4 "
          "dashlength 1.4 pointscale 2\nset bmargin screen 0.21\n",
          2.0 * height);
    case PictureFormat::pdf:
      return fmt::format(
          "set terminal pdfcairo enhanced size 18cm,{:.4g}cm font 'sans-serif,11' linewidth 1.2\n"
          "set bmargin screen 0.21\n",
          height / 50.0);
  }
  return "";
}

std::string heading(const std::string& title, const std::string& subtitle) {
  const std::vector<std::string> titles = wrapped(title, page_in_bold);
  const std::vector<std::string> lines = wrapped(subtitle, page_in_small);
  // Lines come at these heights, the last one nearest to the axes.
  constexpr double lowest = 0.893;
  constexpr double line_height = 0.027;
  std::string labels;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double height = lines.size() == 1 ? 0.905 : i == 0 ? 0.92 : lowest;
    labels += fmt::format("set label {} {} at graph 0.5, screen {} center\n", i == 0 ? 1 : 1001,
                          quoted(lines[i], "/*0.87"), height);
  }
  std::string top;
  if (titles.size() == 1) {
    top = "set title " + quoted(title, "/:Bold") +
          fmt::format(" offset 0,{}\n", lines.size() == 1 ? "1.1" : "1.6");
  }
  for (std::size_t i = 0; i < titles.size() && titles.size() > 1; ++i) {
    const double above = lines.size() == 1 ? 0.905 : 0.92;
    top += fmt::format("set label {} {} at graph 0.5, screen {:.4g} center\n", 1002 + i,
                       quoted(titles[i], "/:Bold"),
                       above + line_height * 1.15 * static_cast<double>(titles.size() - i));
  }
  return "set encoding utf8\n" + top + labels +
         "set tmargin screen 0.88\nset rmargin screen 0.97\n"
         "set tics nomirror out\nset border linewidth 0.8\n";
}

/// Widths are in letters as gnuplot lays them out, heights in shares of the picture's height. More
/// columns than gnuplot has room for would give more rows.
Legend legend_below(const std::vector<std::string>& names, PictureFormat format, double scale) {
  struct Page {
    double width;
    double axis;
    double row;
    double font;
  };
  const Page page = format == PictureFormat::svg   ? Page{77.0, 0.155, 0.039, 15.0}
                    : format == PictureFormat::png ? Page{86.0, 0.125, 0.029, 22.0}
                                                   : Page{98.0, 0.14, 0.037, 11.0};
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, width_in_columns(name));
  constexpr double sample = 5.5;
  const double entry = sample + scale * static_cast<double>(longest);
  const int columns = std::clamp(static_cast<int>(page.width / entry), 1, 4);
  const int rows = (static_cast<int>(names.size()) + columns - 1) / columns;
  const std::string font =
      scale == 1.0 ? "" : fmt::format("\nset key font ',{:.3g}'", scale * page.font);
  const double bottom = page.axis + page.row * scale * rows;
  return {fmt::format("set bmargin screen {:.3f}\nset key at screen 0.54, 0.02 bottom center "
                      "horizontal maxcols {} Left reverse samplen 3 spacing 1.25{}\n",
                      bottom, columns, font),
          bottom};
}

std::string axis_commands(char name, const ChartAxis& axis) {
  const auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.7g}", *value) : "*";
  };
  std::string text = fmt::format("set {}label {}\n", name, quoted(axis.label));
  text += fmt::format("set {}range [{}:{}]\n", name, end(axis.low), end(axis.high));
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  if (needs_powers(axis)) {
    return text + (axis.logarithmic ? power_tics : even_tics)(name, *axis.low, *axis.high);
  }
  if (axis.logarithmic && axis.tics.empty() && axis.low && axis.high && *axis.low > 0.0 &&
      decades_between(*axis.low, *axis.high) < 2) {
    return text + short_log_tics(name, *axis.low, *axis.high);
  }
  if (axis.tics.empty()) return text;
  std::vector<std::string> tics;
  for (const auto& [label, value] : axis.tics) {
    tics.push_back(fmt::format("{} {:.7g}", quoted(label), value));
  }
  return text + tics_command(name, tics);
}

std::string plot_command(const std::vector<std::string>& layers) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < layers.size(); ++i) {
    command += (i == 0 ? "" : ", \\\n     ") + layers[i];
  }
  return command + "\n";
}

}  // namespace gearlash
