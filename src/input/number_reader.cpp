#include "input/number_reader.hpp"

#include "base/lists.hpp"
#include "input/parameter_text.hpp"

namespace gearlash {
namespace {

Measured read_in(SectionReader& section, const std::string& key, const Parameter& parameter,
                 const NumberForm& form, const std::string& wanted) {
  if (form.dimension) return section.quantity(key, *form.dimension, form.factor);
  return {.si = form.factor * section.number(key, wanted, number_text(parameter))};
}

/// "; or give Kv instead", of the section's other keys for it, each in one case.
std::string or_other_keys(const Parameter& parameter, std::string_view path) {
  std::vector<std::string> keys;
  for (const std::string_view other : paths_of(parameter)) {
    const std::string key(other.substr(other.find('.') + 1));
    const bool is_of_section = section_of(other) == section_of(path) && other != path;
    const bool is_new =
        !any_of(keys, [&](const std::string& given) { return is_same_word(given, key); });
    if (is_of_section && is_new) keys.push_back(key);
  }
  return keys.empty() ? "" : "; or give " + alternatives(keys) + " instead";
}

}  // namespace

Measured read_number_of(SectionReader& section, const std::string& key, const Parameter& parameter,
                        std::string_view path, const Drive& drive, const std::string& wanted) {
  const Measured placeholder{.si = 1.0};
  if (!section.has(key)) {
    const auto dimension = number_forms(parameter, drive, path).front().dimension;
    section.require(key, "must be " + (dimension ? described(*dimension) : wanted) +
                             or_other_keys(parameter, path));
    return placeholder;
  }
  const std::vector<NumberForm> forms = number_forms(parameter, drive, path);
  const NumberForm* form = first_of(forms, [&](const NumberForm& one) {
    return one.dimension && section.is_of(key, *one.dimension);
  });
  if (form == nullptr) form = &forms.front();
  if (!form->refusal.empty()) {
    section.refuse(key, form->refusal);
    return placeholder;
  }
  Measured read = read_in(section, key, parameter, *form, wanted);
  if (form->form == nullptr) return read;
  if (section.has_tolerance(key)) {
    section.refuse(
        key, "must have no tolerance in this form: give it as " + std::string(parameter.path));
    return placeholder;
  }
  try {
    read.si = value_of_form(*form->form, read.si, drive, key);
  } catch (const InvalidInput& problem) {
    section.refuse(key, problem.faults().front().permitted);
    return placeholder;
  }
  return read;
}

void refuse_other_units(SectionReader& section, const std::string& key, const Parameter& parameter,
                        std::string_view path, const std::vector<Drive>& drives) {
  section.know(key);
  std::vector<std::string> permitted;
  for (const Drive& drive : drives) {
    const std::vector<NumberForm> forms = number_forms(parameter, drive, path);
    for (const NumberForm& form : forms) {
      if (!form.dimension || section.is_of(key, *form.dimension)) return;
    }
    const std::string one = described(*forms.front().dimension);
    if (!contains(permitted, one)) permitted.push_back(one);
  }
  section.refuse(key,
                 "must be " + listed(
                                  permitted, [](const std::string& one) { return one; }, ", or "));
}

}  // namespace gearlash
