#include "input/parameter_text.hpp"

#include "base/lists.hpp"
#include "gearlash/parameter.hpp"
#include "input/section_reader.hpp"
#include "input/toml_document.hpp"
#include "model/parameter_values.hpp"

namespace gearlash {
namespace {

toml::array list_of(std::string_view path, std::string_view text) {
  if (std::optional<toml::array> list = list_in(text)) return *std::move(list);
  refuse(path, text, "must be a list, such as [1, 2.5]");
}

std::vector<double> numbers_of(std::string_view path, const toml::array& array) {
  std::vector<double> numbers;
  for (const toml::node& node : array) {
    const auto number = node.value<double>();
    if (!number) refuse(path, "a list", "must be a list of numbers");
    numbers.push_back(*number);
  }
  return numbers;
}

Rows rows_of(std::string_view path, const toml::array& array) {
  Rows rows;
  for (const toml::node& node : array) {
    if (!node.is_array()) refuse(path, "a list", "must be a list of rows of numbers");
    rows.push_back(numbers_of(path, *node.as_array()));
  }
  return rows;
}

}  // namespace

std::vector<std::string_view> paths_of(const Parameter& parameter) {
  std::vector<std::string_view> paths = {parameter.path};
  add_all(paths, of_each(parameter.other_forms, &OtherForm::path));
  return paths;
}

std::string_view section_of(std::string_view path) { return path.substr(0, path.find('.')); }

const OtherForm* inverse_form(const Parameter& parameter) {
  return first_of(parameter.other_forms,
                  [](const OtherForm& form) { return form.dimension != nullptr; });
}

NumberText number_text(const Parameter& parameter) {
  if (parameter.permitted == Permitted::share) return read_share;
  return parameter.path == "servo.friction_ratio" ? read_part : read_number;
}

double number_of(const Parameter& parameter, const Drive& drive, std::string_view path,
                 std::string_view text) {
  const Dimension* dimension = parameter.dimension(drive);
  if (dimension == nullptr || path.find('[') != std::string_view::npos) {
    return number_text(parameter)(path, text);
  }
  const OtherForm* form = form_named(parameter, path);
  if (form != nullptr && form->dimension != nullptr) return to_si(path, text, *form->dimension);
  const OtherForm* inverse = inverse_form(parameter);
  try {
    return to_si(path, text, *dimension);
  } catch (const InvalidInput&) {  // "1 kHz" for a period
    if (inverse == nullptr || parameter.path != path) throw;
  }
  return inverse->inverse / to_si(path, text, *inverse->dimension);
}

std::size_t choice_of(const Parameter& parameter, std::string_view path, std::string_view text) {
  const std::optional<std::size_t> choice = choice_named(parameter, text);
  if (choice) return *choice;
  const std::string_view reason = reason_against(parameter, text);
  refuse(path, text, reason.empty() ? one_of(words_of(parameter), text) : std::string(reason));
}

void set(Drive& drive, std::string_view path, std::string_view text) {
  add_section_of(drive, path);
  const Parameter& parameter = parameter_of(drive, path);
  const bool has_index = path.find('[') != std::string_view::npos;
  if (may_be_rounded(parameter, drive) && has_long_decimal(text)) drive.is_rounded = true;
  const Slot slot = parameter.slot(drive);
  if (const auto* choice = std::get_if<Choice>(&slot)) {
    choice->choose(drive, choice_of(parameter, path, text));
  } else if (auto* const* word = std::get_if<std::string*>(&slot)) {
    **word = std::string(text);
  } else if (auto* const* list = std::get_if<std::vector<double>*>(&slot); list && !has_index) {
    **list = numbers_of(path, list_of(path, text));
  } else if (auto* const* rows = std::get_if<Rows*>(&slot); rows && !has_index) {
    **rows = rows_of(path, list_of(path, text));
  } else {
    set(drive, path, number_of(parameter, drive, path, text));
  }
}

}  // namespace gearlash
