#include "model/parameter_values.hpp"

#include <charconv>
#include <cmath>

#include "base/lists.hpp"
#include "base/overloaded.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

[[noreturn]] void refuse(std::string_view path, const char* permitted) {
  throw InvalidInput({{std::string(path), "", permitted}});
}

/// "controller.A" and 1, 2 of "controller.A[1][2]".
struct IndexedPath {
  std::string_view path;
  std::vector<std::size_t> indices;
};

IndexedPath without_indices(std::string_view path) {
  IndexedPath result{path.substr(0, path.find('[')), {}};
  std::string_view rest = path.substr(result.path.size());
  while (!rest.empty()) {
    const std::size_t close = rest.find(']');
    std::size_t index = 0;
    const char* begin = rest.data() + 1;
    const char* end = rest.data() + (close == std::string_view::npos ? rest.size() : close);
    if (rest[0] != '[' || close == std::string_view::npos || begin == end ||
        std::from_chars(begin, end, index).ptr != end) {
      refuse(path, "must be a path, with indices such as [1] or [1][2] at its end");
    }
    result.indices.push_back(index);
    rest.remove_prefix(close + 1);
  }
  return result;
}

template <class List>
auto& element(List& list, std::size_t index, std::string_view path) {
  if (index >= list.size()) refuse(path, "must have indices within the list");
  return list[index];
}

/// The place of a number, or of an element of a list.
double* number_place(const Slot& slot, const IndexedPath& indexed, std::string_view path) {
  const std::vector<std::size_t>& indices = indexed.indices;
  if (auto* const* number = std::get_if<double*>(&slot)) return indices.empty() ? *number : nullptr;
  if (auto* const* list = std::get_if<std::vector<double>*>(&slot)) {
    return indices.size() == 1 ? &element(**list, indices[0], path) : nullptr;
  }
  if (auto* const* rows = std::get_if<Rows*>(&slot)) {
    if (indices.size() != 2) return nullptr;
    return &element(element(**rows, indices[0], path), indices[1], path);
  }
  return nullptr;
}

}  // namespace

ParameterKind kind_of(const Parameter& parameter, const Drive& drive) {
  const Slot slot = parameter.slot(const_cast<Drive&>(drive));
  return std::visit(Overloaded{[](const Choice&) { return ParameterKind::choice; },
                               [](std::vector<double>*) { return ParameterKind::list; },
                               [](Rows*) { return ParameterKind::matrix; },
                               [](std::string*) { return ParameterKind::file; },
                               [](const auto&) { return ParameterKind::number; }},
                    slot);
}

const OtherForm* form_named(const Parameter& parameter, std::string_view path) {
  return first_of(parameter.other_forms, [&](const OtherForm& form) { return form.path == path; });
}

void take_form_with(Drive& drive, std::string_view path) {
  if (!drive.servo) return;
  // Of a rounded ratio near 1 hardly anything is known of 1 − φ, to which proofs would give the
  // error of a datum.
  constexpr double near_1 = 127.0 / 128.0;
  if (drive.is_rounded && drive.servo->friction_ratio > near_1) return;
  const std::string_view plain = path.substr(0, path.find('['));
  const bool may_have_it =
      find_parameter(plain) != nullptr && find_parameter(plain, drive) == nullptr;
  if (!may_have_it) return;
  Drive physical = physical_form(drive);
  if (find_parameter(plain, physical) != nullptr) drive = std::move(physical);
}

void add_section_of(Drive& drive, std::string_view path) {
  take_form_with(drive, path);
  const std::string_view name = path.substr(0, path.find('.'));
  for (const Section& section : all_sections()) {
    if (section.name == name && !section.is_present(drive) && name != "servo") section.add(drive);
  }
}

const Parameter& parameter_of(const Drive& drive, std::string_view path) {
  const std::string_view plain = path.substr(0, path.find('['));
  const Parameter* parameter = find_parameter(plain, drive);
  if (parameter == nullptr) {
    const bool is_known = find_parameter(plain) != nullptr;
    refuse(path,
           is_known ? "must be a parameter that this drive has" : "must be a parameter of drives");
  }
  return *parameter;
}

std::vector<ParameterInfo> parameters_of(const Drive& drive) {
  std::vector<ParameterInfo> list;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!exists(parameter, drive)) continue;
    const Dimension* dimension = parameter.dimension(drive);
    ParameterInfo info{.path = parameter.path,
                       .kind = kind_of(parameter, drive),
                       .unit = dimension == nullptr ? std::string_view() : dimension->unit,
                       .meaning = parameter.meaning,
                       .choices = parameter.choices,
                       .is_required = parameter.is_required,
                       .usual_low = parameter.usual.low,
                       .usual_high = parameter.usual.high,
                       .is_logarithmic = parameter.usual.is_logarithmic};
    info.aliases = of_each(parameter.other_forms, &OtherForm::path);
    list.push_back(std::move(info));
  }
  return list;
}

double get(const Drive& of, std::string_view path) {
  Drive drive = of;
  take_form_with(drive, path);
  const Parameter& parameter = parameter_of(drive, path);
  const IndexedPath indexed = without_indices(path);
  const Slot slot = parameter.slot(drive);
  std::optional<double> value = number_in(parameter, drive);
  if (const double* place = number_place(slot, indexed, path)) value = *place;
  if (!value) refuse(path, "must be a number that this drive has");
  const OtherForm* form = form_named(parameter, indexed.path);
  return form != nullptr ? number_of_form(*form, *value, drive) : *value;
}

void set(Drive& drive, std::string_view path, double value) {
  add_section_of(drive, path);
  const Parameter& parameter = parameter_of(drive, path);
  const IndexedPath indexed = without_indices(path);
  const OtherForm* form = form_named(parameter, indexed.path);
  if (form != nullptr) value = value_of_form(*form, value, drive);
  const Slot slot = parameter.slot(drive);
  if (double* place = number_place(slot, indexed, path)) {
    *place = value;
  } else if (auto* const* optional = std::get_if<std::optional<double>*>(&slot)) {
    **optional = value;
  } else {
    refuse(path, "must be a number, or an element of a list");
  }
}

}  // namespace gearlash
