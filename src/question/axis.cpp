#include "question/axis.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameter_values.hpp"

namespace gearlash {
namespace {

[[noreturn]] void refuse(std::string_view field, std::string value, std::string permitted) {
  throw InvalidInput({{std::string(field), std::move(value), std::move(permitted)}});
}

bool is_word(const Parameter& parameter) { return !parameter.choices.empty(); }

/// Whether the parameter has one value: a number, an element of a list, or a word.
bool is_single(const Axis& axis, const Parameter& parameter, const Drive& drive) {
  Drive copy = drive;
  add_section_of(copy, axis.path);
  const Slot slot = parameter.slot(copy);
  const bool is_list =
      std::holds_alternative<std::vector<double>*>(slot) || std::holds_alternative<Rows*>(slot);
  return !std::holds_alternative<std::string*>(slot) &&
         (!is_list || axis.path.find('[') != std::string::npos);
}

/// The rules for this one number, whatever the other parameters are.
std::vector<Fault> faults_of_value(const Axis& axis, const Parameter& parameter, double value) {
  RangeCheck check;
  if (is_word(parameter)) {
    const double last = static_cast<double>(parameter.choices.size()) - 1.0;
    return check.within(parameter.path, value, 0.0, last).faults();
  }
  const OtherForm* form = form_named(parameter, axis.path);
  if (form != nullptr) value = value_of_form(*form, value, Drive{});  // of the right sign
  if (const NormalFormNumber* number = normal_form_number(parameter.path)) {
    NormalizedServo servo{.damping = 0.5};
    servo.*number->member = value;
    return faults(servo);
  }
  check_number(check, parameter, value, "");
  return check.faults();
}

void check_order(RangeCheck& check, const Axis& axis, bool are_words, std::string_view field) {
  if (are_words) {
    const std::set<double> different(axis.values.begin(), axis.values.end());
    if (different.size() == axis.values.size()) return;
    check.refuse(field, axis.path, "must have each word once");
    return;
  }
  const auto fall = std::adjacent_find(axis.values.begin(), axis.values.end(),
                                       [](double one, double next) { return !(one < next); });
  if (fall == axis.values.end()) return;
  check.refuse(field, exact_text(*fall) + " before " + exact_text(*std::next(fall)),
               "must rise from value to value");
}

}  // namespace

double round_number_from(double number, std::span<const double> digits, double rounding) {
  const double power = std::pow(10.0, std::floor(std::log10(number) + rounding));
  const double* digit =
      first_of(digits, [&](double one) { return one * power >= number * (1.0 - rounding); });
  return digit != nullptr ? *digit * power : 10.0 * power;
}

const NormalFormNumber* normal_form_number(std::string_view path) {
  return first_of(normal_form_numbers,
                  [&](const NormalFormNumber& one) { return one.path == path; });
}

std::string_view path_of(const NormalFormNumber& number, bool is_normal_form) {
  return !is_normal_form && number.path == "servo.backlash" ? "gearbox.backlash" : number.path;
}

Axis spaced_axis(std::string_view field, std::string path, double from, double to,
                 std::size_t count, Spacing spacing) {
  const bool is_logarithmic = spacing == Spacing::logarithmic;
  const std::string ends = exact_text(from) + " to " + exact_text(to);
  if (!std::isfinite(from) || !std::isfinite(to)) refuse(field, ends, "must be finite");
  if (is_logarithmic && !(from > 0.0)) {
    refuse(field, exact_text(from), "must be positive on a logarithmic axis");
  }
  if (from > to) refuse(field, ends, "must rise: the smaller value first");
  if (count < 1 || count > most_values_on_an_axis) {
    refuse(field, std::to_string(count) + " values",
           "must be from 1 to " + std::to_string(most_values_on_an_axis));
  }
  if ((count == 1) != (from == to)) {
    refuse(field, std::to_string(count) + (count == 1 ? " value from " : " values from ") + ends,
           "must be two or more between different ends, or one where they are the same");
  }
  Axis axis{std::move(path), {}, is_logarithmic};
  axis.values.reserve(count);
  const double steps = std::max(1.0, static_cast<double>(count) - 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto step = static_cast<double>(i);
    // Powers of ten make whole powers exact.
    const double exponent = (std::log10(from) * (steps - step) + std::log10(to) * step) / steps;
    axis.values.push_back(is_logarithmic ? std::pow(10.0, exponent)
                                         : from + step / steps * (to - from));
  }
  axis.values.front() = from;
  axis.values.back() = to;
  return axis;
}

double position_on(const Axis& axis, double value) {
  const double low = axis.values.front();
  const double high = axis.values.back();
  return axis.logarithmic ? std::log(value / low) / std::log(high / low)
                          : (value - low) / (high - low);
}

double value_at(const Axis& axis, double position) {
  const double low = axis.values.front();
  const double high = axis.values.back();
  const double value = axis.logarithmic ? low * std::exp(position * std::log(high / low))
                                        : low + position * (high - low);
  return std::clamp(value, low, high);
}

std::size_t interval_of(const Axis& axis, double value) {
  const auto above = std::upper_bound(axis.values.begin() + 1, axis.values.end() - 1, value);
  return static_cast<std::size_t>(above - axis.values.begin()) - 1;
}

Axis linear(std::string_view path, double from, double to, std::size_t count) {
  return spaced_axis(path, std::string(path), from, to, count, Spacing::linear);
}

Axis logarithmic(std::string_view path, double from, double to, std::size_t count) {
  return spaced_axis(path, std::string(path), from, to, count, Spacing::logarithmic);
}

const Parameter* parameter_of(const Axis& axis, const Drive& drive) {
  Drive copy = drive;
  add_section_of(copy, axis.path);
  const std::string_view plain = std::string_view(axis.path).substr(0, axis.path.find('['));
  const Parameter* parameter = find_parameter(plain, copy);
  if (parameter == nullptr || !exists(*parameter, copy)) return nullptr;
  return is_single(axis, *parameter, drive) ? parameter : nullptr;
}

std::optional<double> present_value(const Axis& axis, const Drive& drive) {
  const Parameter& parameter = *parameter_of(axis, drive);
  Drive copy = drive;
  take_form_with(copy, axis.path);
  const Slot slot = parameter.slot(copy);
  if (const auto* choice = std::get_if<Choice>(&slot)) {
    return static_cast<double>(choice->chosen(copy));
  }
  try {
    return get(drive, axis.path);
  } catch (const InvalidInput&) {
    return std::nullopt;  // not given, without a default
  }
}

Axis usual_axis(std::string_view field, const Drive& drive, std::string_view parameter) {
  constexpr std::size_t count = 25;
  Axis axis{.path = path_named(parameter, drive)};
  const Parameter* const found = parameter_of(axis, drive);
  if (found == nullptr)
    refuse(field, std::string(parameter), "must be a number or a choice of this drive");
  if (is_word(*found)) {
    for (std::size_t i = 0; i < found->choices.size(); ++i) {
      axis.values.push_back(static_cast<double>(i));
    }
    return axis;
  }
  if (found->permitted == Permitted::share || found->path == "servo.friction_ratio") {
    return linear(axis.path, 0.0, 1.0, count);
  }
  const double present = present_value(axis, drive).value_or(0.0);
  constexpr double factor = 10.0;
  if (present > 0.0 && std::isfinite(present)) {
    axis = logarithmic(axis.path, present / factor, present * factor, count);
    cut_to_permitted(axis, drive);
    if (faults_of_value(axis, *found, 0.0).empty()) axis.values.insert(axis.values.begin(), 0.0);
    return axis;
  }
  const UsualRange& usual = found->usual;
  if (!(usual.low < usual.high)) {
    refuse(field, std::string(parameter),
           "must be above 0 at present, or have a range, as in " + axis.path + "=FROM:TO:COUNT");
  }
  const bool is_by_ratio = usual.is_logarithmic && usual.low > 0.0;
  return is_by_ratio ? logarithmic(axis.path, usual.low, usual.high, count)
                     : linear(axis.path, usual.low, usual.high, count);
}

void set_on(const Axis& axis, Drive& drive, double value) {
  add_section_of(drive, axis.path);
  const Parameter* parameter = find_parameter(axis.path, drive);
  if (parameter == nullptr || !is_word(*parameter)) return set(drive, axis.path, value);
  const Slot slot = parameter->slot(drive);
  if (const auto* choice = std::get_if<Choice>(&slot)) {
    choice->choose(drive, static_cast<std::size_t>(value));
  }
}

void set_on(const std::vector<Axis>& axes, Drive& drive, std::span<const double> values) {
  for (const bool are_of_form : {true, false}) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (axes[i].path.starts_with("servo.") == are_of_form) set_on(axes[i], drive, values[i]);
    }
  }
}

namespace {

/// Leaves out the values that `why` gives a text for, if others remain: "0 and 2 more (why not 0)".
template <class Why>
std::string cut(Axis& axis, const Why& why) {
  std::vector<double> left_out;
  std::vector<double> kept;
  for (const double value : axis.values) (why(value).empty() ? kept : left_out).push_back(value);
  if (left_out.empty() || kept.empty()) return "";
  axis.values = std::move(kept);
  const std::string others =
      left_out.size() > 1 ? " and " + std::to_string(left_out.size() - 1) + " more" : "";
  return exact_text(left_out.front()) + others + " (" + why(left_out.front()) + ")";
}

}  // namespace

std::string cut_to_permitted(Axis& axis, const Drive& drive) {
  const Parameter& parameter = *parameter_of(axis, drive);
  return cut(axis, [&](double value) {
    const std::vector<Fault> found = faults_of_value(axis, parameter, value);
    return found.empty() ? "" : axis.path + " " + found.front().permitted;
  });
}

std::string cut_to_sound(Axis& axis, const Drive& drive) {
  return cut(axis, [&](double value) {
    Drive other = drive;
    set_on(axis, other, value);
    const std::vector<Fault> found = faults(other);
    return found.empty() ? "" : to_string(found.front());
  });
}

bool is_at_open_end(const Axis& axis, const Drive& drive, double value) {
  constexpr double near = 1e-3;  // of the range
  const double low = axis.values.front();
  const double high = axis.values.back();
  const double position = position_on(axis, value);
  const double step = near * (axis.logarithmic ? value : high - low);
  const auto is_permitted = [&](double beyond) {
    return faults_of_axis({axis.path, {beyond}}, drive, axis.path).empty();
  };
  return (position < near && is_permitted(low - step)) ||
         (position > 1.0 - near && is_permitted(high + step));
}

std::vector<Fault> faults_of_axis(const Axis& axis, const Drive& drive, std::string_view field) {
  RangeCheck check;
  const Parameter* parameter = parameter_of(axis, drive);
  if (parameter == nullptr) {
    return check.refuse(field, axis.path, "must be a number or a word of the drive").faults();
  }
  if (axis.values.empty()) check.refuse(field, "no value", "must be at least one");
  const auto refused = [&](double value) {
    return !faults_of_value(axis, *parameter, value).empty();
  };
  if (const double* first = first_of(axis.values, refused)) {
    const std::size_t others = count_of(axis.values, refused) - 1;
    check.refuse(
        field, exact_text(*first) + (others > 0 ? " and " + std::to_string(others) + " more" : ""),
        axis.path + " " + faults_of_value(axis, *parameter, *first).front().permitted);
  }
  check_order(check, axis, is_word(*parameter), field);
  return check.faults();
}

std::string column_name(std::string_view path) {
  if (const NormalFormNumber* number = normal_form_number(path)) return number->name;
  std::string name(path);
  std::erase(name, ']');
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == '['; }, '_');
  return name;
}

std::string path_named(std::string_view name, const Drive& drive) {
  std::string underscored(name);
  std::replace(underscored.begin(), underscored.end(), '-', '_');
  for (const NormalFormNumber& number : normal_form_numbers) {
    if (underscored == number.name) return std::string(path_of(number, drive.servo.has_value()));
  }
  return std::string(name);
}

std::string unit_of(const Axis& axis, const Drive& drive) {
  const Parameter* parameter = parameter_of(axis, drive);
  if (parameter == nullptr || is_word(*parameter)) return "";
  const OtherForm* form = form_named(*parameter, axis.path);
  const bool is_other = form != nullptr && form->relation != Relation::same;
  const Dimension* dimension = is_other ? form->dimension : parameter->dimension(drive);
  const bool is_bare = dimension == nullptr || axis.path.find('[') != std::string::npos;
  return is_bare ? "1" : std::string(dimension->unit);
}

std::string text_of(const Axis& axis, const Drive& drive, double value) {
  const Parameter* parameter = parameter_of(axis, drive);
  if (parameter == nullptr || !is_word(*parameter)) return exact_text(value);
  return std::string(parameter->choices.at(static_cast<std::size_t>(value)));
}

}  // namespace gearlash
