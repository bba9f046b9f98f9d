#include "output/grid_description.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/lists.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "output/grid_table.hpp"
#include "output/json_writer.hpp"
#include "question/family/evaluation.hpp"

namespace gearlash {
NamedParameter named_parameter(const Axis& axis, const Drive& drive) {
  const Parameter& parameter = *parameter_of(axis, drive);
  const std::string unit = unit_of(axis, drive);
  return {.name = column_name(axis.path),
          .path = axis.path,
          .meaning = std::string(parameter.meaning),
          .unit = unit.empty() ? "1" : unit,
          .words = fmt::format("{}", fmt::join(parameter.choices, " "))};
}

std::string spacing_of(const Axis& axis) { return axis.logarithmic ? "logarithmic" : "linear"; }

std::vector<FixedNumber> fixed_numbers(const Grid& grid) {
  std::vector<FixedNumber> fixed;
  for (const auto& [path, value] : fixed_parameters(grid)) {
    if (!std::holds_alternative<double>(value)) continue;
    fixed.push_back({named_parameter(Axis{.path = path}, grid.drive), get(grid.drive, path)});
  }
  return fixed;
}

std::vector<std::pair<std::string, std::string>> attributes_of_file(const GridContents& contents) {
  const Grid& grid = contents.grid;
  std::vector<std::pair<std::string, std::string>> attributes = {
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
  if (!contents.source_text.empty()) attributes.emplace_back("sweep", contents.source_text);
  return attributes;
}

std::vector<NetcdfDimension> describe_axes(NetcdfFile& file, const Grid& grid) {
  std::vector<NetcdfDimension> dimensions = of_each(grid.axes, [&](const Axis& axis) {
    return file.add_dimension(column_name(axis.path), axis.values.size());
  });
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    const NamedParameter parameter = named_parameter(grid.axes[i], grid.drive);
    const NetcdfVariable variable =
        file.add_numbers(parameter.name, {dimensions[i]}, parameter.meaning, parameter.unit);
    file.set_attribute(variable, "path", parameter.path);
    file.set_attribute(variable, "spacing", spacing_of(grid.axes[i]));
    if (!parameter.words.empty()) file.set_attribute(variable, "words", parameter.words);
  }
  return dimensions;
}

std::string describe_fixed_numbers(NetcdfFile& file, const Grid& grid) {
  std::string names;
  for (const FixedNumber& number : fixed_numbers(grid)) {
    const NamedParameter& parameter = number.parameter;
    file.add_numbers(parameter.name, {}, parameter.meaning, parameter.unit);
    names += (names.empty() ? "" : " ") + parameter.name;
  }
  return names;
}

void write_parameters(NetcdfFile& file, const Grid& grid) {
  for (const Axis& axis : grid.axes) {
    file.write(file.variable(column_name(axis.path)), {{0}, {axis.values.size()}}, axis.values);
  }
  for (const FixedNumber& number : fixed_numbers(grid)) {
    file.write(file.variable(number.parameter.name), NetcdfBox{}, std::span(&number.value, 1));
  }
}

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

}  // namespace gearlash
