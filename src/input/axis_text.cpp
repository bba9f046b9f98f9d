#include <algorithm>
#include <charconv>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/tune.hpp"
#include "gearlash/units.hpp"
#include "input/foreign_words.hpp"
#include "input/parameter_text.hpp"
#include "input/section_reader.hpp"
#include "model/parameter_values.hpp"
#include "model/proportional_servo.hpp"
#include "question/axis.hpp"
#include "question/change/values.hpp"

namespace gearlash {
namespace {

constexpr char axis_forms[] = "must be PATH=FROM:TO:COUNT, PATH=FROM:TO:COUNT:log or PATH=A,B,C";

/// The drive's parameters and the short names.
std::string known_text(const Drive& drive, std::string_view name) {
  std::vector<std::string> known;
  for (const ParameterInfo& parameter : parameters_of(drive)) {
    known.emplace_back(parameter.path);
    add_all(known, parameter.aliases);
  }
  for (const NormalFormNumber& number : normal_form_numbers) known.emplace_back(number.name);
  return "must be a number or a choice of this drive" + guess_of_path(name, known) +
         "; gearlash show lists them";
}

double read_value(const AxisText& axis, const std::string& path, const Parameter& parameter,
                  const Drive& drive, std::string_view text) {
  if (!parameter.choices.empty()) {
    return static_cast<double>(choice_of(parameter, axis.field, text));
  }
  if (text.empty() || parameter.dimension(drive) == nullptr) {
    return number_text(parameter)(axis.field, text);
  }
  if (const auto number = bare_number(text)) return *number;  // in SI
  try {
    return number_of(parameter, drive, path, text);
  } catch (const InvalidInput& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) fault.path = axis.field;
    throw InvalidInput(std::move(faults));
  }
}

std::size_t read_count(std::string_view field, std::string_view text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size()) {
    refuse(field, text,
           "must be a count, a whole number from 1 to " + std::to_string(most_values_on_an_axis));
  }
  return count;
}

/// Whether the axis gives Drive::is_rounded to the drives on it.
bool is_rounded(const AxisText& axis, const Drive& drive) {
  const std::string path = path_named(axis.name, drive);
  const Parameter* parameter = find_parameter(path.substr(0, path.find('[')));
  if (parameter == nullptr || !may_be_rounded(*parameter, drive)) return false;
  return any_of(split(axis.values, ":"),
                [](std::string_view range) { return any_of(split(range, ","), has_long_decimal); });
}

/// An axis as typed, or that of a name alone.
Axis read_typed_axis(std::string_view field, std::string_view text, const Drive& drive,
                     std::string* left_out,
                     Axis (*axis_of)(std::string_view field, const Drive& drive,
                                     std::string_view name)) {
  if (text.find('=') != std::string_view::npos) {
    return read_axis(split_axis(field, text), drive, left_out);
  }
  const Axis named{.path = path_named(text, drive)};
  if (parameter_of(named, drive) == nullptr) refuse(field, text, known_text(drive, text));
  return axis_of(field, drive, text);
}

}  // namespace

AxisText split_axis(std::string_view field, std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) refuse(field, text, axis_forms);
  const std::string_view name = trimmed(text.substr(0, equals));
  const std::string_view values = trimmed(text.substr(equals + 1));
  if (name.empty() || values.empty()) refuse(field, text, axis_forms);
  return {std::string(field), std::string(name), std::string(values)};
}

Axis read_axis_or_name(std::string_view field, std::string_view text, const Drive& drive,
                       std::string* left_out) {
  return read_typed_axis(field, text, drive, left_out, usual_axis);
}

Axis read_axis_to_search(std::string_view field, std::string_view text, const Drive& drive,
                         std::string* left_out) {
  return read_typed_axis(field, text, drive, left_out, axis_to_search);
}

Axis read_axis_to_tune(std::string_view field, std::string_view text, const Drive& drive,
                       std::string* left_out) {
  const bool has_two_ends = std::count(text.begin(), text.end(), ':') == 1;
  // Between the ends are values that remain if an end is not permitted.
  const std::string with_count = std::string(text) + (has_two_ends ? ":101" : "");
  Axis axis = read_axis_or_name(field, with_count, drive, left_out);
  if (!parameter_of(axis, drive)->choices.empty()) {
    refuse(field, axis.path,
           "must be a number of this drive, not a choice of words; gearlash design compares these");
  }
  if (has_two_ends) axis.values = {axis.values.front(), axis.values.back()};
  if (text.find('=') == std::string_view::npos) return usual_axis_to_tune(drive, axis.path);
  axis.logarithmic = axis.values.front() > 0.0;
  return axis;
}

Drive drive_of_axes(const Drive& drive, const std::vector<AxisText>& axes) {
  const bool wants_normal_form = any_of(axes, [&](const AxisText& axis) {
    return path_named(axis.name, drive).starts_with("servo.");
  });
  Drive varied = drive.servo || !wants_normal_form ? drive : normal_form_of(drive).value_or(drive);
  varied.is_rounded |= any_of(axes, [&](const AxisText& axis) { return is_rounded(axis, varied); });
  return varied;
}

Axis read_axis(const AxisText& text, const Drive& drive, std::string* left_out) {
  Axis axis{.path = path_named(text.name, drive)};
  const Parameter* parameter = parameter_of(axis, drive);
  if (parameter == nullptr) refuse(text.field, text.name, known_text(drive, text.name));
  Drive with_part = drive;  // has the units of the axis's section
  add_section_of(with_part, axis.path);
  const auto value_of = [&](std::string_view value) {
    return read_value(text, axis.path, *parameter, with_part, value);
  };
  const std::vector<std::string_view> parts = split(text.values, ":");
  if (parts.size() == 1) {
    for (const std::string_view value : split(text.values, ",")) {
      axis.values.push_back(value_of(value));
    }
  } else {
    const bool is_logarithmic = parts.size() == 4 && parts[3] == "log";
    const bool is_word = !parameter->choices.empty();
    if (is_word || (parts.size() != 3 && !is_logarithmic)) {
      refuse(text.field, text.name + "=" + text.values, axis_forms);
    }
    // One after the other: compilers evaluate arguments in orders of their own.
    const double from = value_of(parts[0]);
    const double to = value_of(parts[1]);
    const std::size_t count = read_count(text.field, parts[2]);
    axis = spaced_axis(text.field, axis.path, from, to, count,
                       is_logarithmic ? Spacing::logarithmic : Spacing::linear);
  }
  const std::string cut = left_out != nullptr ? cut_to_permitted(axis, drive) : "";
  if (!cut.empty()) *left_out = text.field + " " + text.name + ": left out: " + cut;
  require_none(faults_of_axis(axis, drive, text.field));
  return axis;
}

}  // namespace gearlash
