#include "input/section_reader.hpp"

#include <algorithm>
#include <numeric>

#include "base/lists.hpp"
#include "question/series/distribution.hpp"

namespace gearlash {
namespace {

// These are in range for every key and cause no faults of their own.
constexpr double placeholder_quantity = 1.0;
constexpr double placeholder_number = 0.5;

constexpr char list_of_texts[] = "must be a list of texts: [\"…\", \"…\"]";

/// 'p' of 'P'.
char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Levenshtein distance in either case: the least number of insertions, deletions and replacements.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (small(from[i]) == small(to[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// A number without unit: a TOML number, or text (a fraction).
double exact_number(const std::string& field, const toml::node& value,
                    double (*read_text)(std::string_view, std::string_view) = read_number) {
  if (const auto* integer = value.as_integer()) return static_cast<double>(integer->get());
  if (const auto* floating = value.as_floating_point()) {
    return floating->get() + 0.0;  // no negative zero
  }
  if (const auto* text = value.as_string()) return read_text(field, text->get());
  refuse(field, "", "must be a number without unit, such as 0.25 or \"1/9\"");
}

}  // namespace

bool is_same_word(std::string_view one, std::string_view other) {
  return one.size() == other.size() && edit_distance(one, other) == 0;
}

std::optional<std::string> nearest(const std::vector<std::string>& known,
                                   std::string_view written) {
  constexpr std::size_t longest_worth_a_guess = 40;
  if (written.size() > longest_worth_a_guess) return std::nullopt;
  for (const std::string& candidate : known) {
    if (!written.empty() && candidate.starts_with(written)) return candidate;
  }
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(2, written.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(written, candidate);
    if (distance < best_distance && distance < candidate.size()) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string one_of(const std::vector<std::string>& known, std::string_view written) {
  return "must be one of " + listed(known) + guess_of(known, written);
}

std::string alternatives(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

std::string guess_of(const std::vector<std::string>& known, std::string_view written) {
  const auto guess = nearest(known, written);
  return guess ? " (did you mean " + *guess + "?)" : "";
}

void Findings::missing(Place place, const std::string& field, const std::string& permitted) {
  refuse(place, field, "", permitted);
}

void Findings::refuse(const std::string& field, const toml::node& value,
                      const std::string& permitted) {
  refuse(value.source().begin, field, document_.written(value), permitted);
}

void Findings::refuse(Place place, const std::string& field, const std::string& value,
                      const std::string& permitted) {
  if (!fields_.insert(field).second) return;
  found_.push_back({place, {field, value, permitted, document_.where(place)}});
}

void Findings::take(const std::vector<Fault>& faults, Place otherwise,
                    const std::function<std::string(const std::string&)>& field_of) {
  const bool complete = none();
  for (const Fault& fault : faults) {
    const std::string field = field_of(fault.path);
    const auto value = values_.find(field);
    if (value != values_.end()) {
      refuse(field, *value->second, fault.permitted);
    } else if (complete) {
      refuse(otherwise, field, fault.value, fault.permitted);
    }
  }
}

void Findings::require_none() {
  sort_by(found_, [](const Found& one) { return std::pair(one.place.line, one.place.column); });
  std::vector<Fault> faults;
  for (Found& found : found_) faults.push_back(std::move(found.fault));
  gearlash::require_none(std::move(faults));
}

SectionReader::SectionReader(const TomlDocument& document, Findings& findings, std::string name,
                             bool required, const std::string& contents)
    : document_(document), findings_(findings), name_(std::move(name)) {
  const toml::node* node = document.root().get(name_);
  if (node == nullptr) {
    if (required) findings_.missing({1, 1}, name_, "must be a section [" + name_ + "] " + contents);
    return;
  }
  table_ = node->as_table();
  if (table_ == nullptr) {
    findings_.refuse(name_, *node, "must be a section [" + name_ + "] " + contents);
  }
}

Measured SectionReader::quantity(const std::string& key, const Dimension& expected, double factor) {
  const toml::node* value = require(key, "must be " + described(expected));
  return value != nullptr ? read(key, *value, expected, factor)
                          : Measured{.si = placeholder_quantity};
}

double SectionReader::number(const std::string& key, const std::string& permitted,
                             NumberText read_text) {
  const toml::node* value = require(key, "must be " + permitted);
  return value != nullptr ? read(key, *value, read_text) : placeholder_number;
}

std::optional<std::string> SectionReader::choice(const std::string& key,
                                                 const std::vector<std::string>& choices,
                                                 bool required) {
  const toml::node* value = required ? require(key, one_of(choices, "")) : find(key);
  if (value == nullptr) return std::nullopt;
  std::optional<std::string> text = value->value_exact<std::string>();
  if (text && contains(choices, *text)) {
    findings_.remember(field(key), *value);
    return text;
  }
  findings_.refuse(field(key), *value, one_of(choices, text.value_or("")));
  return std::nullopt;
}

template <class Read>
auto SectionReader::read_list(const std::string& name, const toml::node& value,
                              const std::string& permitted, const Read& read) {
  std::vector<decltype(read(name, value))> list;
  findings_.remember(name, value);
  const toml::array* array = value.as_array();
  if (array == nullptr) findings_.refuse(name, value, permitted);
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const std::string element = name + "[" + std::to_string(i) + "]";
    findings_.remember(element, *array->get(i));
    list.push_back(read(element, *array->get(i)));
  }
  return list;
}

std::vector<std::string> SectionReader::texts(const std::string& key,
                                              const std::string& permitted) {
  const toml::node* value = permitted.empty() ? find(key) : require(key, "must be " + permitted);
  if (value == nullptr) return {};
  const toml::array* array = value->as_array();
  if (array != nullptr && array->empty()) {
    findings_.refuse(field(key), *value, list_of_texts);
    return {};
  }
  return read_list(field(key), *value, list_of_texts,
                   [&](const std::string& name, const toml::node& element) {
                     if (!element.is_string()) {
                       findings_.refuse(name, element, "must be a text: \"…\"");
                     }
                     return element.value_or(std::string());
                   });
}

std::string SectionReader::text(const std::string& key, const std::string& permitted) {
  const toml::node* value = permitted.empty() ? find(key) : require(key, "must be " + permitted);
  if (value == nullptr) return {};
  findings_.remember(field(key), *value);
  if (!value->is_string()) findings_.refuse(field(key), *value, "must be a text: \"…\"");
  return value->value_or(std::string());
}

std::vector<double> SectionReader::read_numbers(const std::string& name, const toml::node& value,
                                                const std::string& permitted) {
  return read_list(name, value, "must be " + permitted,
                   [&](const std::string& element, const toml::node& node) {
                     try {
                       return exact_number(element, node);
                     } catch (const InvalidInput& problem) {
                       findings_.refuse(element, node, problem.faults().front().permitted);
                       return placeholder_number;
                     }
                   });
}

std::vector<double> SectionReader::numbers(const std::string& key, const std::string& permitted) {
  const toml::node* value = require(key, "must be " + permitted);
  return value != nullptr ? read_numbers(field(key), *value, permitted) : std::vector<double>{};
}

std::vector<std::vector<double>> SectionReader::rows(const std::string& key,
                                                     const std::string& permitted) {
  const toml::node* value = require(key, "must be " + permitted);
  if (value == nullptr) return {};
  return read_list(field(key), *value, "must be " + permitted,
                   [&](const std::string& name, const toml::node& row) {
                     return read_numbers(name, row, permitted);
                   });
}

bool SectionReader::has_tolerance(const std::string& key) const {
  return tolerances_ != nullptr && any_of(*tolerances_, [&](const ParameterTolerance& one) {
           return one.path == field(key);
         });
}

void SectionReader::refuse(const std::string& key, const std::string& permitted) {
  if (const toml::node* value = find(key)) findings_.refuse(field(key), *value, permitted);
}

void SectionReader::refuse_word(const std::string& key, std::string_view word,
                                const std::string& permitted) {
  const toml::node* value = find(key);
  if (value != nullptr && value->value_exact<std::string>() == word) refuse(key, permitted);
}

bool SectionReader::is_of(const std::string& key, const Dimension& dimension) {
  const toml::node* value = table_ != nullptr ? table_->get(key) : nullptr;
  if (value == nullptr) return false;
  try {
    read_toleranced(key, *value, [&](const std::string& name, const toml::node& node) {
      return read_quantity(name, node.value_exact<std::string>().value_or(""), dimension);
    });
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

void SectionReader::refuse_other_keys() {
  refuse_other_keys([&](const std::string& key, const std::vector<std::string>& known) {
    return "is not a key of [" + name_ + "]: " + one_of(known, key);
  });
}

void SectionReader::refuse_other_keys(const Reason& reason) {
  if (table_ == nullptr) return;
  for (const auto& [key, value] : *table_) {
    if (contains(known_, key.str())) continue;
    findings_.refuse(key.source().begin, field(shown(key.str())), document_.written(value),
                     reason(std::string(key.str()), known_));
  }
}

Place SectionReader::place() const {
  return table_ != nullptr ? table_->source().begin : Place{1, 1};
}

void SectionReader::know(const std::string& key) {
  if (!contains(known_, key)) known_.push_back(key);
}

const toml::node* SectionReader::find(const std::string& key) {
  know(key);
  return table_ != nullptr ? table_->get(key) : nullptr;
}

const toml::node* SectionReader::require(const std::string& key, const std::string& permitted) {
  const toml::node* value = find(key);
  if (value == nullptr && table_ != nullptr) findings_.missing(place(), field(key), permitted);
  return value;
}

Measured SectionReader::read(const std::string& key, const toml::node& value,
                             const Dimension& expected, double factor) {
  const auto read_plain = [&](const std::string& name, const toml::node& node) -> Measured {
    const bool is_zero = node.is_number() && exact_number(name, node) == 0.0;  // in every unit
    if (is_zero || (bare_numbers_ && node.is_number())) {
      return {.si = exact_number(name, node), .unit = std::string(expected.unit)};
    }
    const std::optional<std::string> text = node.value_exact<std::string>();
    const std::optional<double> number = text ? bare_number(*text) : std::nullopt;
    if (bare_numbers_ && number) return {.si = *number, .unit = std::string(expected.unit)};
    if (text) return read_quantity(name, *text, expected);
    gearlash::refuse(
        name, "",
        "must be " + with_unit(expected) + " as text: \"" + std::string(expected.example) + "\"");
  };
  const auto read_exact = [&](const std::string& name, const toml::node& node) {
    Measured measured = read_plain(name, node);
    measured.si *= factor;
    return measured;
  };
  return read(key, value, read_exact, placeholder_quantity);
}

double SectionReader::read(const std::string& key, const toml::node& value, NumberText read_text) {
  const auto read_exact = [&](const std::string& name, const toml::node& node) -> Measured {
    if (node.is_floating_point() && document_.is_long(node)) {
      return {.si = read_text(name, document_.number_text(node))};
    }
    return {.si = exact_number(name, node, read_text)};
  };
  return read(key, value, read_exact, placeholder_number).si;
}

Measured SectionReader::read(const std::string& key, const toml::node& value,
                             const ExactReader& read_exact, double placeholder) {
  try {
    const std::string name = field(key);
    const TolerancedValue read = tolerances_ != nullptr
                                     ? read_toleranced(name, value, read_exact)
                                     : TolerancedValue{read_exact(name, value), std::nullopt};
    if (read.distribution) {
      require_none(faults(*read.distribution, name));
      tolerances_->push_back({name, *read.distribution});
    }
    findings_.remember(name, value);
    return read.nominal;
  } catch (const InvalidInput& problem) {
    findings_.refuse(field(key), value, problem.faults().front().permitted);
    return {.si = placeholder};
  }
}

}  // namespace gearlash
