#include "picture/grid_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "output/grid_table.hpp"

namespace gearlash {
namespace {

bool is_varied(const Grid& grid, std::string_view path) {
  return std::any_of(grid.axes.begin(), grid.axes.end(),
                     [&](const Axis& axis) { return axis.path == path; });
}

bool in_backlashes(const Grid& grid) {
  return grid.drive.servo && grid.drive.servo->backlash == 1.0 &&
         !is_varied(grid, "servo.backlash");
}

bool is_angle(Quantity quantity) { return info_of(quantity).unit == "rad"; }

/// The unit in a picture: backlashes, or with ω_n and K if these are 1.
std::string unit_of(Quantity quantity, const Grid& grid, const AngleUnit& angle) {
  std::string unit(info_of(quantity).unit);
  const bool is_free = in_backlashes(grid);
  if (is_angle(quantity)) return is_free ? "backlashes" : angle.name;
  if (!is_normalized(grid.drive)) return unit;
  if (unit == "s") return "1/ω_n";
  if (unit == "Hz") return "ω_n";
  if (unit == "rad/s") return is_free ? "backlashes × ω_n" : "rad ω_n";
  if (unit == "J") return is_free ? "K × backlash²" : "K rad²";
  return unit;
}

/// Empty for words and pure numbers.
std::string name_of_unit(const Axis& axis, const Drive& drive, const AngleUnit& angle) {
  std::string unit = unit_of(axis, drive);
  if (unit == "rad") return angle.name;
  return unit == "1" ? "" : unit;
}

/// Tics at 1, 2 and 5, or at all digits, if gnuplot's one for each power of ten would give fewer
/// than two.
std::vector<std::pair<std::string, double>> logarithmic_tics(double low, double high) {
  if (!(low > 0.0)) return {};
  constexpr double more = 1.0 + 1e-9;
  std::vector<std::pair<std::string, double>> tics;
  const auto add = [&](std::initializer_list<int> digits) {
    tics.clear();
    for (double power = std::floor(std::log10(low)); power <= std::log10(high); ++power) {
      for (const int digit : digits) {
        const double value = digit * std::pow(10.0, power);
        if (value * more < low || value > high * more) continue;
        tics.emplace_back(fmt::format("{:.7g}", value), value);
      }
    }
    return tics.size() >= 2;
  };
  if (add({1})) return {};
  if (add({1, 2, 5}) || add({1, 2, 3, 4, 5, 6, 7, 8, 9})) return tics;
  return {{fmt::format("{:.4g}", low), low}, {fmt::format("{:.4g}", high), high}};
}

}  // namespace

std::string subtitle_of(const Grid& grid) {
  if (Family(grid).engines().search) return certainty_of(grid);
  std::string text;
  for (const NormalFormNumber& number : normal_form_numbers) {
    const bool is_there =
        grid.drive.servo && parameter_of({.path = std::string(number.path)}, grid.drive) != nullptr;
    if (!is_there || is_varied(grid, number.path)) continue;
    text += fmt::format("{}{} {:.4g}", text.empty() ? "" : ", ", in_words(std::string(number.path)),
                        get(grid.drive, number.path));
  }
  return text;
}

std::string in_words(const std::string& path) {
  std::string text = normal_form_number(path) == nullptr ? path : column_name(path);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  return text;
}

std::string title_of(Quantity quantity) {
  std::string title(info_of(quantity).meaning);
  title = title.substr(0, title.find_first_of(":,"));
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

std::string unit_in_brackets(Quantity quantity, const Grid& grid, const AngleUnit& angle) {
  const std::string unit = unit_of(quantity, grid, angle);
  return unit == "1" ? "" : " (" + unit + ")";
}

std::string label_of(Quantity quantity, const Grid& grid, const AngleUnit& angle) {
  return in_words(std::string(name_of(quantity))) + unit_in_brackets(quantity, grid, angle);
}

double drawn_unit(Quantity quantity, const Grid& grid, const AngleUnit& angle) {
  return is_angle(quantity) && !in_backlashes(grid) ? angle.radians : 1.0;
}

bool has_words(const Axis& axis, const Drive& drive) { return unit_of(axis, drive).empty(); }

double drawn_unit(const Axis& axis, const Drive& drive, const AngleUnit& angle) {
  return unit_of(axis, drive) == "rad" ? angle.radians : 1.0;
}

std::string short_text(const Axis& axis, const Drive& drive, double value, const AngleUnit& angle) {
  return has_words(axis, drive) ? text_of(axis, drive, value)
                                : fmt::format("{:.4g}", value / drawn_unit(axis, drive, angle));
}

std::string text_with_unit(const Axis& axis, const Drive& drive, double value,
                           const AngleUnit& angle) {
  const std::string unit = name_of_unit(axis, drive, angle);
  return short_text(axis, drive, value, angle) + (unit.empty() ? "" : " " + unit);
}

ChartAxis chart_axis(const Axis& axis, const Drive& drive, const AngleUnit& angle) {
  const std::string unit = name_of_unit(axis, drive, angle);
  ChartAxis drawn{.label = in_words(axis.path) + (unit.empty() ? "" : " (" + unit + ")"),
                  .logarithmic = axis.logarithmic};
  if (has_words(axis, drive)) {
    constexpr double room = 0.5;
    const auto [low, high] = std::minmax_element(axis.values.begin(), axis.values.end());
    drawn.low = *low - room;
    drawn.high = *high + room;
    for (const double value : axis.values) {
      drawn.tics.emplace_back(text_of(axis, drive, value), value);
    }
    return drawn;
  }
  const double per = drawn_unit(axis, drive, angle);
  drawn.low = axis.values.front() / per;
  drawn.high = axis.values.back() / per;
  if (axis.logarithmic) drawn.tics = logarithmic_tics(*drawn.low, *drawn.high);
  if (axis.values.size() == 1) {
    const double value = axis.values.front() / per;
    const double room = value > 0.0 ? 0.1 * value : 0.1;
    drawn = {.label = drawn.label,
             .low = value - room,
             .high = value + room,
             .tics = {{fmt::format("{:.7g}", value), value}}};
  }
  return drawn;
}

}  // namespace gearlash
