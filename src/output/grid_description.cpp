#include "output/grid_description.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "base/lists.hpp"
#include "model/reduced_drive.hpp"
#include "output/grid_table.hpp"
#include "output/json_writer.hpp"
#include "question/family/evaluation.hpp"

namespace gearlash {

std::string boundary_name(const Axis& axis) { return "hunting_boundary_" + column_name(axis.path); }

namespace {

constexpr std::array target_words = {PlaceKind::not_known, PlaceKind::missed, PlaceKind::met};

/// "cannot hunt" is "cannot_hunt", as the words of flags must be.
std::string one_word(std::string_view words) {
  std::string word(words);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

std::vector<std::string> verdict_words() {
  std::vector<std::string> words;
  for (int number = 0; number <= static_cast<int>(Verdict::undecided); ++number) {
    words.push_back(one_word(name_of(static_cast<Verdict>(number))));
  }
  return words;
}

/// The same for equal contents.
std::vector<NetcdfAttribute> attributes_of_file(const GridContents& contents) {
  const Grid& grid = contents.grid;
  std::vector<NetcdfAttribute> attributes = {
      {"Conventions", "CF-1.8"},
      {"title", "What geared drives with backlash end in"},
      {"source", "gearlash " + contents.provenance.version},
      {"history", contents.provenance.command},
      {"certainty", certainty_of(grid)},
      {"drive", json_of(fixed_parameters(grid))},
      {"comment", is_normalized(grid.drive)
                      ? "SI units, with an undamped natural frequency of 1 rad/s and a loop "
                        "stiffness of 1 N m/rad."
                      : "SI units."}};
  if (!contents.source_text.empty()) attributes.push_back({"sweep", contents.source_text});
  return attributes;
}

NetcdfVariable numbers(std::string name, std::vector<std::size_t> dimensions, std::string meaning,
                       std::string unit) {
  return {.name = std::move(name),
          .type = NetcdfType::numbers,
          .dimensions = std::move(dimensions),
          .attributes = {{"long_name", std::move(meaning)}, {"units", std::move(unit)}}};
}

/// Whole numbers from 0 on that stand for words (the CF conventions' "flags").
NetcdfVariable flags(std::string name, std::vector<std::size_t> dimensions, std::string meaning,
                     const std::vector<std::string>& words) {
  std::vector<signed char> values(words.size());
  std::iota(values.begin(), values.end(), static_cast<signed char>(0));
  return {.name = std::move(name),
          .type = NetcdfType::flags,
          .dimensions = std::move(dimensions),
          .attributes = {{"flag_values", std::move(values)},
                         {"flag_meanings", listed(words, std::identity(), " ")},
                         {"long_name", std::move(meaning)}}};
}

/// The parameter of an axis under its own name.
NetcdfVariable parameter(const Axis& axis, const Drive& drive,
                         std::vector<std::size_t> dimensions) {
  const std::string unit = unit_of(axis, drive);
  const Parameter& of = *parameter_of(axis, drive);
  NetcdfVariable variable = numbers(column_name(axis.path), std::move(dimensions),
                                    std::string(of.meaning), unit.empty() ? "1" : unit);
  variable.attributes.push_back({"path", axis.path});
  if (!of.choices.empty()) {
    variable.attributes.push_back({"words", listed(of.choices, std::identity(), " ")});
  }
  return variable;
}

/// Each axis is a dimension with a variable of its name.
void describe_axes(NetcdfDescription& description, const Grid& grid) {
  for (const Axis& axis : grid.axes) {
    NetcdfVariable variable = parameter(axis, grid.drive, {description.dimensions.size()});
    variable.attributes.push_back({"spacing", axis.logarithmic ? "logarithmic" : "linear"});
    variable.values = axis.values;
    description.dimensions.push_back({variable.name, axis.values.size()});
    description.variables.push_back(std::move(variable));
  }
}

/// The numbers of the drive that are on no axis. Returns their names, with blanks between.
std::string describe_fixed(NetcdfDescription& description, const Grid& grid) {
  std::string names;
  for (const auto& [path, value] : fixed_parameters(grid)) {
    const auto* number = std::get_if<double>(&value);
    if (number == nullptr) continue;
    description.variables.push_back(parameter(Axis{.path = std::string(path)}, grid.drive, {}));
    description.variables.back().values = {*number};
    names += (names.empty() ? "" : " ") + description.variables.back().name;
  }
  return names;
}

/// A list of points for each axis.
void describe_boundary(NetcdfDescription& description, const Grid& grid, std::size_t points) {
  const std::size_t dimension = description.dimensions.size();
  description.dimensions.push_back({"hunting_boundary_point", points});
  for (const Axis& axis : grid.axes) {
    description.variables.push_back(
        numbers(boundary_name(axis), {dimension},
                std::string(parameter_of(axis, grid.drive)->meaning) +
                    ", where hunting ends (growth at rest 1); NaN between curves",
                unit_of(axis, grid.drive)));
  }
}

}  // namespace

NetcdfDescription description_of(const GridContents& contents, const GridExtras& extras) {
  const Grid& grid = contents.grid;
  NetcdfDescription description;
  description.attributes = attributes_of_file(contents);
  describe_axes(description, grid);
  std::vector<std::size_t> all_axes(grid.axes.size());
  std::iota(all_axes.begin(), all_axes.end(), std::size_t{0});
  const std::string coordinates = describe_fixed(description, grid);
  const auto add_answer = [&](NetcdfVariable variable) {
    if (!coordinates.empty()) variable.attributes.push_back({"coordinates", coordinates});
    description.variables.push_back(std::move(variable));
  };
  add_answer(flags(verdict_name, all_axes, "verdict on the drive", verdict_words()));
  for (const Quantity quantity : contents.quantities) {
    const QuantityInfo& info = info_of(quantity);
    NetcdfVariable variable = numbers(std::string(info.name), all_axes, std::string(info.meaning),
                                      std::string(info.unit));
    variable.attributes.push_back({"missing_value", std::numeric_limits<double>::quiet_NaN()});
    add_answer(std::move(variable));
  }
  if (extras.has_target) {
    description.variables.push_back(
        flags(target_name, all_axes, "whether the drive meets the target",
              of_each(target_words, [](PlaceKind word) { return one_word(name_of(word)); })));
  }
  if (extras.boundary_points > 0) describe_boundary(description, grid, extras.boundary_points);
  return description;
}

std::vector<std::byte> target_flags(std::span<const PlaceKind> kinds) {
  return of_each(kinds, [](PlaceKind kind) {
    const auto* const word = std::find(target_words.begin(), target_words.end(), kind);
    return static_cast<std::byte>(word - target_words.begin());
  });
}

}  // namespace gearlash
