// Prints every parameter and quantity as JSON, of which the schema of drive files and the reference
// pages are made.
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/quantity.hpp"
#include "listed.hpp"
#include "listed_records.hpp"
#include "model/normalized_servo.hpp"
#include "model/parameters.hpp"

namespace {

using namespace gearlash;
using namespace gearlash::listed;

bool is_choice(const Parameter& parameter, Drive& drive) {
  return std::holds_alternative<Choice>(parameter.slot(drive));
}

Drive with_choice(Drive drive, const Parameter& parameter, std::size_t choice) {
  std::get<Choice>(parameter.slot(drive)).choose(drive, choice);
  return drive;
}

Drive with_all_sections() {
  Drive drive;
  for (const Section& section : all_sections()) {
    if (section.name != "servo" && !section.is_present(drive)) section.add(drive);
  }
  return drive;
}

constexpr double present = 0.4375;  // no default of any number

/// Some keys stand only beside others, such as the form of a dead band and a limit of the current
/// of a motor whose torque constant is known. Here all are present.
Drive with_all_numbers(Drive drive) {
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const Slot slot = parameter.slot(drive);
    if (auto* const* number = std::get_if<double*>(&slot); number != nullptr && **number == 0.0) {
      **number = present;
    }
    if (auto* const* number = std::get_if<std::optional<double>*>(&slot)) **number = present;
  }
  return drive;
}

/// This drive, and those with one of its words changed, then two.
std::vector<Drive> kinds_of(const Drive& drive) {
  std::vector<Drive> drives = {drive};
  std::size_t begin = 0;
  for (int changes = 0; changes < 2; ++changes) {
    const std::size_t end = drives.size();
    for (std::size_t i = begin; i < end; ++i) {
      for (const Parameter& parameter : all_parameters_of_drives()) {
        if (!is_choice(parameter, drives[i])) continue;
        for (std::size_t choice = 0; choice < parameter.choices.size(); ++choice) {
          drives.push_back(with_choice(drives[i], parameter, choice));
        }
      }
    }
    begin = end;
  }
  return drives;
}

/// Drives that have, between them, every parameter. Those with all numbers are last, so that
/// defaults come from the others.
std::vector<Drive> drives_of_all_kinds() {
  std::vector<Drive> all = {normal_form(0.2, 1.0, 0.2)};
  for (const Drive& drive : {with_all_sections(), with_all_numbers(with_all_sections())}) {
    const std::vector<Drive> kinds = kinds_of(drive);
    all.insert(all.end(), kinds.begin(), kinds.end());
  }
  return all;
}

/// Whether the drive has the parameter as it is, with all its numbers, or with one of them more.
bool can_exist(const Parameter& parameter, const Drive& drive) {
  if (exists(parameter, drive) || exists(parameter, with_all_numbers(drive))) return true;
  for (const Parameter& other : all_parameters_of_drives()) {
    Drive more = drive;
    const Slot slot = other.slot(more);
    if (auto* const* number = std::get_if<std::optional<double>*>(&slot)) {
      **number = present;
      if (exists(parameter, more)) return true;
    }
  }
  return false;
}

std::string unit_in(const Parameter& parameter, const Drive& drive) {
  const Dimension* dimension = parameter.dimension(drive);
  return dimension == nullptr ? "" : std::string(dimension->unit);
}

std::string example_in(const Parameter& parameter, const Drive& drive) {
  const Dimension* dimension = parameter.dimension(drive);
  return dimension == nullptr ? "" : std::string(dimension->example);
}

/// The word of a choice; empty for a number.
std::string word_in(const Parameter& parameter, Drive drive) {
  const Slot slot = parameter.slot(drive);
  const auto* choice = std::get_if<Choice>(&slot);
  if (choice == nullptr) return "";
  const std::size_t chosen = choice->chosen(drive);
  return chosen < parameter.choices.size() ? std::string(parameter.choices[chosen]) : "";
}

template <class Value>
ByName<Value> by_name(const std::map<std::string, Value>& map) {
  return {map.begin(), map.end()};
}

/// How the parameter depends on the words of a drive that has it.
void describe_dependence(ListedParameter& listed, const Parameter& parameter, Drive drive) {
  for (const Parameter& other : all_parameters_of_drives()) {
    if (&other == &parameter || !is_choice(other, drive)) continue;
    Words words;
    std::map<std::string, Words> units;
    std::map<std::string, Words> defaults;
    for (std::size_t choice = 0; choice < other.choices.size(); ++choice) {
      const Drive varied = with_choice(drive, other, choice);
      if (!can_exist(parameter, varied)) continue;
      words.emplace_back(other.choices[choice]);
      units[unit_in(parameter, varied)].emplace_back(other.choices[choice]);
      defaults[word_in(parameter, varied)].emplace_back(other.choices[choice]);
    }
    if (words.size() < other.choices.size()) listed.exists_with.emplace_back(other.path, words);
    if (defaults.size() > 1) listed.defaults.emplace_back(other.path, by_name(defaults));
    if (units.size() > 1) listed.units.emplace_back(other.path, by_name(units));
  }
}

std::string permitted(const Parameter& parameter, Permitted values) {
  switch (values) {
    case Permitted::positive:
      return "> 0";
    case Permitted::not_negative:
      return "≥ 0";
    case Permitted::share:
      return "0 … 1";
    case Permitted::of_normal_form:
      return permitted_values(parameter.key());
    case Permitted::anything:
      break;
  }
  return "any finite number";
}

std::string kind_of(const Slot& slot) {
  if (std::holds_alternative<Choice>(slot)) return "choice";
  if (std::holds_alternative<std::vector<double>*>(slot)) return "list";
  if (std::holds_alternative<Rows*>(slot)) return "matrix";
  return std::holds_alternative<std::string*>(slot) ? "file" : "number";
}

ParameterValue default_of(const Parameter& parameter, Drive& drive, const std::string& kind) {
  if (parameter.is_required) return {};
  if (!parameter.otherwise.empty()) return std::string(parameter.otherwise);
  if (kind == "choice") return word_in(parameter, drive);
  if (kind == "number") {
    const std::optional<double> value = number_in(parameter, drive);
    const bool is_optional = std::holds_alternative<std::optional<double>*>(parameter.slot(drive));
    if (value && *value != present) return *value;
    if (value && !is_optional) return 0.0;
  }
  return {};
}

/// The values that the number of another form may have.
Permitted permitted(const OtherForm& form, Permitted parameter) {
  if (form.relation == Relation::power_of_two) return Permitted::positive;
  const bool has_reciprocal = form.relation == Relation::reciprocal;
  return has_reciprocal && parameter == Permitted::not_negative ? Permitted::positive : parameter;
}

ListedParameter described(const Parameter& parameter, Drive drive) {
  const std::string kind = kind_of(parameter.slot(drive));
  ListedParameter listed{.path = std::string(parameter.path),
                         .kind = kind,
                         .meaning = std::string(parameter.meaning),
                         .unit = unit_in(parameter, drive),
                         .example = example_in(parameter, drive),
                         .is_required = parameter.is_required,
                         .otherwise = default_of(parameter, drive, kind),
                         .usual_low = parameter.usual.low,
                         .usual_high = parameter.usual.high};
  describe_dependence(listed, parameter, drive);
  if (kind == "number") listed.permitted = permitted(parameter, parameter.permitted);
  if (kind == "choice") listed.words = words_of(parameter);
  for (const OtherWord& other : parameter.other_words) {
    listed.synonyms.emplace_back(other.word, parameter.choices[other.choice]);
  }
  for (const OtherForm& form : parameter.other_forms) {
    listed.aliases.push_back(
        {.path = std::string(form.path),
         .unit = form.dimension == nullptr ? "" : std::string(form.dimension->unit),
         .is_same = form.relation == Relation::same,
         .permitted = permitted(parameter, permitted(form, parameter.permitted))});
  }
  return listed;
}

}  // namespace

int main() {
  const std::vector<Drive> drives = drives_of_all_kinds();
  Lists lists;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    const auto first = std::find_if(drives.begin(), drives.end(),
                                    [&](const Drive& drive) { return exists(parameter, drive); });
    if (first == drives.end()) {
      std::cerr << "list_parameters: no drive has " << parameter.path << '\n';
      return 1;
    }
    lists.parameters.push_back(described(parameter, *first));
  }
  constexpr std::string_view scopes[] = {"answer", "motion", "ceiling", "loop", "step"};
  for (const QuantityInfo& one : quantities()) {
    lists.quantities.push_back(
        {one.name, one.unit, one.meaning, scopes[static_cast<std::size_t>(one.scope)]});
  }
  for (const Section& section : all_sections()) {
    lists.sections.emplace_back(section.name, section.contents);
  }
  std::cout << json_of(lists) << '\n';
}
