#include "input/axis_text.hpp"

#include <charconv>
#include <string>
#include <vector>

#include "input/units.hpp"

namespace gearlash {
namespace {

constexpr char forms[] = "must be NAME=FROM:TO:COUNT, NAME=FROM:TO:COUNT:log or NAME=A,B,C";

[[noreturn]] void refuse(std::string_view field, std::string_view text, std::string permitted) {
  throw InvalidInput({{std::string(field), shown(text), std::move(permitted), ""}});
}

std::string_view without_blanks(std::string_view text) {
  constexpr char blanks[] = " \t";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(without_blanks(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

Input read_input(std::string_view field, std::string_view name) {
  if (const auto input = input_named(name)) return *input;
  std::string permitted = "must name an input:";
  for (const Input input : all_inputs) {
    permitted += input == all_inputs.front() ? " " : input == all_inputs.back() ? " or " : ", ";
    permitted += name_of(input);
  }
  refuse(field, name, permitted);
}

double read_value(std::string_view field, Input input, std::string_view text) {
  return input == Input::backlash && !text.empty() ? read_angle(field, text).si
                                                   : read_number(field, text);
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

}  // namespace

Axis read_axis(std::string_view field, std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) refuse(field, text, forms);
  const Input input = read_input(field, without_blanks(text.substr(0, equals)));
  const std::string_view values = without_blanks(text.substr(equals + 1));
  if (values.empty()) refuse(field, text, forms);
  const std::vector<std::string_view> parts = split(values, ':');
  if (parts.size() == 1) {
    Axis axis{.input = input, .values = {}};
    for (const std::string_view value : split(values, ',')) {
      axis.values.push_back(read_value(field, input, value));
    }
    require_none(validate(axis, field));
    return axis;
  }
  const bool logarithmic = parts.size() == 4 && parts[3] == "log";
  if (parts.size() != 3 && !logarithmic) refuse(field, text, forms);
  Axis axis = spaced_axis(field, input, read_value(field, input, parts[0]),
                          read_value(field, input, parts[1]), read_count(field, parts[2]),
                          logarithmic ? Spacing::logarithmic : Spacing::linear);
  require_none(validate(axis, field));
  return axis;
}

}  // namespace gearlash
