#include "input/parameter_text.hpp"

#include <cmath>

#include "base/lists.hpp"
#include "gearlash/parameter.hpp"
#include "input/section_reader.hpp"
#include "input/toml_document.hpp"
#include "model/parameter_values.hpp"
#include "model/reduced_drive.hpp"

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

bool is_of(std::string_view text, const Dimension& dimension) {
  try {
    read_quantity("", text, dimension);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

/// Whether it is the controller's and a torque, per whatever it is.
bool takes_currents(const Parameter& parameter, const Dimension& dimension) {
  return parameter.section() == "controller" && dimension.kilogram == 1 && dimension.ampere == 0;
}

/// The dimension of what gives it, times a torque constant: "A s/rad" for "N m s/rad".
NumberForm in_currents(Dimension dimension, const Drive& drive) {
  const std::string own = described(dimension);
  const Dimension& constant = dimensions::torque_per_current;
  dimension.metre -= constant.metre;
  dimension.kilogram -= constant.kilogram;
  dimension.second -= constant.second;
  dimension.ampere -= constant.ampere;
  const std::optional<double> factor = torque_constant_of(drive.motor);
  NumberForm form{.dimension = dimension, .factor = factor.value_or(1.0)};
  if (!factor) {
    form.refusal =
        "must stand beside motor.torque_constant, which turns a current into a torque; or be " +
        own;
  } else if (drive.controller.shaft == GainShaft::load) {
    form.refusal =
        "must stand beside shaft = \"motor\" or \"mixed\", because a current is the motor's; or "
        "be " +
        own;
  }
  return form;
}

}  // namespace

std::vector<std::string_view> paths_of(const Parameter& parameter) {
  std::vector<std::string_view> paths = {parameter.path};
  add_all(paths, of_each(parameter.other_forms, &OtherForm::path));
  return paths;
}

std::string_view section_of(std::string_view path) { return path.substr(0, path.find('.')); }

std::vector<NumberForm> number_forms(const Parameter& parameter, const Drive& drive,
                                     std::string_view path) {
  const OtherForm* named = form_named(parameter, path);
  if (named != nullptr && named->relation != Relation::same) {
    const auto dimension =
        named->dimension == nullptr ? std::nullopt : std::optional(*named->dimension);
    if (named->relation != Relation::multiple) return {{.dimension = dimension, .form = named}};
    return {{.dimension = dimension, .factor = value_of_form(*named, 1.0, drive)}};
  }
  const Dimension* own = parameter.dimension(drive);
  if (own == nullptr) return {NumberForm{}};
  std::vector<NumberForm> forms = {{.dimension = *own}};
  if (takes_currents(parameter, *own)) forms.push_back(in_currents(*own, drive));
  for (const OtherForm& form : parameter.other_forms) {
    const bool is_reciprocal = form.relation == Relation::reciprocal && form.of.empty();
    if (is_reciprocal) forms.push_back({.dimension = *form.dimension, .form = &form});
  }
  return forms;
}

double value_of_form(const OtherForm& form, double number, const Drive& drive,
                     std::string_view path) {
  constexpr double most_bits = 64.0;
  if (form.relation == Relation::reciprocal && number == 0.0) {
    refuse(path, "0",
           form.of.empty() ? "must not be 0: it is taken as a reciprocal"
                           : "must not be 0: leave it out for a controller without an integral");
  }
  const bool is_whole = number >= 1.0 && number <= most_bits && number == std::floor(number);
  if (form.relation == Relation::power_of_two && !is_whole) {
    refuse(path, exact_text(number), "must be a whole number of bits, from 1 to 64");
  }
  return value_of_form(form, number, drive);
}

NumberText number_text(const Parameter& parameter) {
  if (parameter.permitted == Permitted::share) return read_share;
  return parameter.path == "servo.friction_ratio" ? read_part : read_number;
}

double number_of(const Parameter& parameter, const Drive& drive, std::string_view path,
                 std::string_view text) {
  const auto plain = [&] { return number_text(parameter)(path, text); };
  if (path.find('[') != std::string_view::npos) return plain();
  const OtherForm* named = form_named(parameter, path);
  if (named != nullptr && named->relation != Relation::same) {
    return named->dimension == nullptr ? plain() : to_si(path, text, *named->dimension);
  }
  const std::vector<NumberForm> forms = number_forms(parameter, drive, path);
  const NumberForm* form = first_of(
      forms, [&](const NumberForm& one) { return one.dimension && is_of(text, *one.dimension); });
  if (form == nullptr) form = &forms.front();
  if (!form->refusal.empty()) refuse(path, text, form->refusal);
  if (!form->dimension) return plain();
  const double number = form->factor * to_si(path, text, *form->dimension);
  return form->form == nullptr ? number : value_of_form(*form->form, number, drive, path);
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
