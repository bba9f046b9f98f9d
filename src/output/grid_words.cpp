#include "output/grid_words.hpp"

#include <fmt/format.h>

#include <cctype>

#include "base/range_check.hpp"

namespace gearlash {
namespace {

/// "backlash (rad)".
std::string label_of(Input input) {
  const std::string unit = unit_of(input);
  return description_of(input) + (unit == "1" ? "" : " (" + unit + ")");
}

bool in_backlashes(const ServoGrid& grid) {
  for (const Axis& axis : grid.axes) {
    if (axis.input == Input::backlash) return false;
  }
  return grid.servo.backlash == 1.0;
}

}  // namespace

std::string fixed_inputs(const ServoGrid& grid, const char* separator) {
  std::string text;
  for (const Input input : all_inputs) {
    bool varied = false;
    for (const Axis& axis : grid.axes) varied = varied || axis.input == input;
    if (varied) continue;
    text += (text.empty() ? "" : ", ") + std::string(name_of(input)) + separator +
            exact_text(grid.servo.*field_of(input));
  }
  return text;
}

std::string in_words(const char* name) {
  std::string text = name;
  for (char& c : text) c = c == '_' ? ' ' : c;
  return text;
}

std::string title_of(CycleQuantity quantity) {
  std::string title = description_of(quantity);
  title = title.substr(0, title.find(':'));
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

std::string unit_in_brackets(CycleQuantity quantity, const ServoGrid& grid) {
  std::string unit = unit_of(quantity);
  if (in_backlashes(grid)) {
    if (unit == "rad") unit = "backlashes";
    if (unit == "rad omega_n") unit = "backlashes × ω_n";
    if (unit == "K rad2") unit = "K × backlash²";
  }
  if (unit == "1/omega_n") unit = "1/ω_n";
  if (unit == "rad omega_n") unit = "rad ω_n";
  if (unit == "K rad2") unit = "K rad²";
  return unit == "1" ? "" : " (" + unit + ")";
}

std::string label_of(CycleQuantity quantity, const ServoGrid& grid) {
  return in_words(name_of(quantity)) + unit_in_brackets(quantity, grid);
}

std::string certainty_of(const ServoGrid& grid) {
  const std::string plastic = name_of(grid.proved ? Certainty::enclosed : Certainty::computed);
  if (!grid.may_bounce()) return plastic;
  return plastic + " for plastic contact, " + name_of(Certainty::searched) + " for restitution > 0";
}

ChartAxis chart_axis(const Axis& axis) {
  ChartAxis drawn{.label = label_of(axis.input), .logarithmic = axis.logarithmic};
  drawn.low = axis.values.front();
  drawn.high = axis.values.back();
  if (axis.values.size() == 1) {  // in the middle
    const double value = axis.values.front();
    const double room = value > 0.0 ? 0.1 * value : 0.1;
    drawn = {.label = drawn.label,
             .low = value - room,
             .high = value + room,
             .tics = {{fmt::format("{:.7g}", value), value}}};
  }
  return drawn;
}

}  // namespace gearlash
