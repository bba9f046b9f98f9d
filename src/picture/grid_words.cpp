#include "picture/grid_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/lists.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "output/grid_table.hpp"

namespace gearlash {
namespace {

bool is_varied(const Grid& grid, std::string_view path) {
  return any_of(grid.axes, [&](const Axis& axis) { return axis.path == path; });
}

bool in_backlashes(const Grid& grid) {
  return grid.drive.servo && grid.drive.servo->backlash == 1.0 &&
         !is_varied(grid, "servo.backlash");
}

}  // namespace

DrawnUnit drawn_unit(Quantity quantity, const Grid& grid) {
  const std::string_view unit = info_of(quantity).unit;
  if (in_backlashes(grid)) {
    if (unit == "rad") return {"backlashes"};
    if (unit == "rad/s") return {"backlashes × ω_n"};
    if (unit == "J") return {"K × backlash²"};
  }
  return drawn_unit(quantity, grid.drive.angle_unit, is_normalized(grid.drive));
}

DrawnUnit drawn_unit(const Axis& axis, const Drive& drive) {
  const std::string unit = unit_of(axis, drive);
  if (unit == "rad") return {drive.angle_unit.name, drive.angle_unit.radians};
  return {unit == "1" ? "" : unit};
}

std::string subtitle_of(const Grid& grid) {
  if (Family(grid).engines().search) return certainty_of(grid);
  return listed(normal_form_numbers, [&](const NormalFormNumber& number) -> std::string {
    const std::string path(number.path);
    const bool is_there = grid.drive.servo && parameter_of({.path = path}, grid.drive) != nullptr;
    if (!is_there || is_varied(grid, path)) return "";
    return fmt::format("{} {:.4g}", in_words(path), get(grid.drive, path));
  });
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

PlotAxis plot_axis(Quantity quantity, const Grid& grid) {
  return {.name = in_words(std::string(name_of(quantity))),
          .unit = drawn_unit(quantity, grid).name};
}

bool has_words(const Axis& axis, const Drive& drive) { return unit_of(axis, drive).empty(); }

std::string short_text(const Axis& axis, const Drive& drive, double value) {
  return has_words(axis, drive) ? text_of(axis, drive, value)
                                : fmt::format("{:.4g}", value / drawn_unit(axis, drive).size);
}

std::string text_with_unit(const Axis& axis, const Drive& drive, double value) {
  const std::string unit = drawn_unit(axis, drive).name;
  return short_text(axis, drive, value) + (unit.empty() ? "" : " " + unit);
}

PlotAxis plot_axis(const Axis& axis, const Drive& drive) {
  const auto [unit, per] = drawn_unit(axis, drive);
  PlotAxis drawn{.name = in_words(axis.path),
                 .unit = unit,
                 .logarithmic = axis.logarithmic && axis.values.size() > 1};
  const auto [low, high] = std::minmax_element(axis.values.begin(), axis.values.end());
  drawn.low = *low / per;
  drawn.high = *high / per;
  const bool is_of_words = has_words(axis, drive);
  if (!is_of_words && axis.values.size() > 1) return drawn;
  const double room = is_of_words ? 0.5 : *low > 0.0 ? 0.1 * drawn.low : 0.1;
  for (const double value : axis.values) {
    drawn.tics.push_back({value / per, is_of_words ? text_of(axis, drive, value)
                                                   : fmt::format("{:.7g}", value / per)});
  }
  drawn.low -= room;
  drawn.high += room;
  return drawn;
}

}  // namespace gearlash
