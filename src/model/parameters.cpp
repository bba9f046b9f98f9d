#include "model/parameters.hpp"

#include <cmath>
#include <iterator>
#include <unordered_map>

#include "base/lists.hpp"
#include "model/parameter_list.hpp"

namespace gearlash {

std::vector<Parameter> parameter_rows::joined(
    std::initializer_list<std::vector<Parameter> (*)()> lists) {
  std::vector<Parameter> all;
  for (auto* list : lists) {
    std::vector<Parameter> part = list();
    std::move(part.begin(), part.end(), std::back_inserter(all));
  }
  return all;
}

const std::vector<Parameter>& all_parameters_of_drives() {
  using namespace parameter_rows;
  static const std::vector<Parameter> all =
      joined({&mechanical_parameters, &control_parameters, &signal_parameters});
  return all;
}

const Parameter* find_parameter(std::string_view path) {
  // Of parameters of one name the first: a map keeps what it has.
  static const auto by_name = [] {
    std::unordered_map<std::string_view, const Parameter*> map;
    for (const Parameter& parameter : all_parameters_of_drives()) {
      map.emplace(parameter.path, &parameter);
      for (const OtherForm& form : parameter.other_forms) map.emplace(form.path, &parameter);
    }
    return map;
  }();
  const auto found = by_name.find(path);
  return found == by_name.end() ? nullptr : found->second;
}

bool has_name(const Parameter& parameter, std::string_view path) {
  return parameter.path == path ||
         any_of(parameter.other_forms, [&](const OtherForm& form) { return form.path == path; });
}

const Parameter* find_parameter(std::string_view path, const Drive& drive) {
  const Parameter* first = find_parameter(path);
  if (first == nullptr || exists(*first, drive)) return first;
  return first_of(all_parameters_of_drives(), [&](const Parameter& parameter) {
    return (has_name(parameter, path) || parameter.path == first->path) && exists(parameter, drive);
  });
}

namespace {

double basis_of(const OtherForm& form, const Drive& drive) {
  if (form.of.empty()) return form.factor;
  const Parameter* other = find_parameter(form.of, drive);
  return form.factor * (other == nullptr ? 1.0 : number_in(*other, drive).value_or(1.0));
}

}  // namespace

double value_of_form(const OtherForm& form, double number, const Drive& drive) {
  switch (form.relation) {
    case Relation::multiple:
      return basis_of(form, drive) * number;
    case Relation::reciprocal:
      return basis_of(form, drive) / number;
    case Relation::power_of_two:
      return std::exp2(number);
    case Relation::same:
      break;
  }
  return number;
}

double number_of_form(const OtherForm& form, double value, const Drive& drive) {
  switch (form.relation) {
    case Relation::multiple:
      return value / basis_of(form, drive);
    case Relation::reciprocal:
      return basis_of(form, drive) / value;
    case Relation::power_of_two:
      return std::log2(value);
    case Relation::same:
      break;
  }
  return value;
}

const std::vector<Section>& all_sections() {
  static const auto has_plant = [](const Drive& drive) { return !drive.servo; };
  static const auto always = [](const Drive&) { return true; };
  static const auto nothing = [](Drive&) {};
  static const std::vector<Section> all = {
      {"servo", "with damping, inertia_ratio, friction_ratio and backlash",
       [](const Drive& drive) { return drive.servo.has_value(); },
       [](Drive& drive) { drive.servo.emplace(); }},
      {"motor", "with a kind and its constants", has_plant, nothing},
      {"gearbox", "with ratio and backlash", has_plant, nothing},
      {"load", "with inertia and friction", has_plant, nothing},
      {"contact", "with restitution, or stiffness and damping", always, nothing},
      {"sensor", "with the shafts that are measured", always, nothing},
      {"controller", "with a kind and its gains", has_plant, nothing},
      {"sampling", "with its period", [](const Drive& drive) { return drive.sampling.has_value(); },
       [](Drive& drive) { drive.sampling.emplace(); }},
      {"reference", "with a kind", [](const Drive& drive) { return drive.reference.has_value(); },
       [](Drive& drive) { drive.reference.emplace(0.0); }},
      {"load_torque", "with a kind",
       [](const Drive& drive) { return drive.load_torque.has_value(); },
       [](Drive& drive) { drive.load_torque.emplace(0.0); }},
      {"specification", "with error, step or band", always, nothing}};
  return all;
}

bool exists(const Parameter& parameter, const Drive& drive) {
  // slot() takes a mutable drive but does not change it.
  return !std::holds_alternative<std::monostate>(parameter.slot(const_cast<Drive&>(drive)));
}

bool may_be_rounded(const Parameter& parameter, const Drive& drive) {
  if (parameter.section() == "servo") return true;
  const Slot slot = parameter.slot(const_cast<Drive&>(drive));
  return parameter.section() == "controller" &&
         (std::holds_alternative<std::vector<double>*>(slot) ||
          std::holds_alternative<Rows*>(slot));
}

std::vector<std::string> words_of(const Parameter& parameter) {
  std::vector<std::string> words(parameter.choices.begin(), parameter.choices.end());
  add_all(words, of_each<std::string>(parameter.other_words, &OtherWord::word));
  return words;
}

std::optional<std::size_t> choice_named(const Parameter& parameter, std::string_view word) {
  for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
    if (parameter.choices[i] == word) return i;
  }
  for (const OtherWord& other : parameter.other_words) {
    if (other.word == word) return other.choice;
  }
  return std::nullopt;
}

std::string_view reason_against(const Parameter& parameter, std::string_view word) {
  for (const RefusedWord& refused : parameter.refused_words) {
    if (refused.word == word) return refused.reason;
  }
  return {};
}

double* given_number(const Slot& slot) {
  if (auto* const* number = std::get_if<double*>(&slot)) return *number;
  auto* const* given = std::get_if<std::optional<double>*>(&slot);
  return given != nullptr && **given ? &***given : nullptr;
}

std::optional<double> number_in(const Parameter& parameter, const Drive& drive) {
  const Slot slot = parameter.slot(const_cast<Drive&>(drive));
  if (const double* number = given_number(slot)) return *number;
  if (!std::holds_alternative<std::optional<double>*>(slot) || parameter.otherwise.empty()) {
    return std::nullopt;
  }
  const Parameter* other = find_parameter(parameter.otherwise);
  return other == nullptr ? std::nullopt : number_in(*other, drive);
}

}  // namespace gearlash
