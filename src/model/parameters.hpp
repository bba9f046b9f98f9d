// The one list of everything in a drive: its path, place and permitted values.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/range_check.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/parameter.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

using Rows = std::vector<std::vector<double>>;

/// A member of a drive that is one of several words.
struct Choice {
  std::size_t (*chosen)(const Drive& drive);
  void (*choose)(Drive& drive, std::size_t choice);
};

/// The place of a parameter in one drive; std::monostate if that drive does not have it.
using Slot = std::variant<std::monostate, double*, std::optional<double>*, std::vector<double>*,
                          Rows*, Choice, std::string*>;

/// The values that a number may have.
enum class Permitted : unsigned char {
  anything,      ///< finite
  positive,      ///< and finite
  not_negative,  ///< and finite
  share,         ///< 0 … 1
  /// As permitted_values() of model/normalized_servo.hpp states for the key.
  of_normal_form
};

/// How the number of another form gives a parameter.
enum class Relation : unsigned char {
  same,          ///< it is the parameter
  multiple,      ///< parameter = basis · number
  reciprocal,    ///< parameter = basis/number
  power_of_two,  ///< parameter = 2^number
};

/// Another form of a parameter.
struct OtherForm {
  std::string_view path;  ///< "controller.kp"
  Relation relation = Relation::same;
  /// Of the number, unless it is the parameter; nullptr if it has no unit.
  const Dimension* dimension = nullptr;
  double factor = 1.0;
  /// The basis is the factor, or that times the drive's number of this path: "controller.speed".
  std::string_view of{};
};

/// The parameter, from the number of another form of it.
double value_of_form(const OtherForm& form, double number, const Drive& drive);
/// The number of another form, from the parameter.
double number_of_form(const OtherForm& form, double value, const Drive& drive);

/// Another word for one of a parameter's choices.
struct OtherWord {
  std::string_view word;  ///< "brushed-dc"
  std::size_t choice = 0;
};

/// A word that is not taken, for a reason of its own.
struct RefusedWord {
  std::string_view word;
  std::string_view reason;  ///< "must be …"
};

/// The range for designs and sliders if nothing else is known.
struct UsualRange {
  double low = 0.0;
  double high = 0.0;
  bool is_logarithmic = true;
};

struct Parameter {
  std::string_view path;  ///< "motor.inertia"; sections and keys of a file
  Slot (*slot)(Drive& drive) = nullptr;
  /// For a number: nullptr if it has no unit. It may depend on the motor: gains are per volt or per
  /// newton metre.
  const Dimension* (*dimension)(const Drive& drive) = [](const Drive&) -> const Dimension* {
    return nullptr;
  };
  std::string_view meaning{};  ///< one sentence, without a full stop
  Permitted permitted = Permitted::anything;
  bool is_required = false;  ///< a file must give it if the drive has it; else it has its default
  /// The default, if it differs from that of a Drive{}: "motor.coulomb".
  std::string_view otherwise{};
  /// The text for a fault if a number without a unit is missing.
  std::string_view wanted{};
  std::vector<std::string_view> choices{};  ///< for a choice, in the order of Choice::chosen
  std::vector<OtherWord> other_words{};
  std::vector<RefusedWord> refused_words{};
  std::vector<OtherForm> other_forms{};
  UsualRange usual{};

  std::string_view section() const { return path.substr(0, path.find('.')); }
  std::string_view key() const { return path.substr(path.find('.') + 1); }
};

/// All parameters, section by section in the order of files. A choice stands before its dependents.
const std::vector<Parameter>& all_parameters_of_drives();

/// Whether the path is the parameter's own or that of one of its other forms.
bool has_name(const Parameter& parameter, std::string_view path);

/// The first parameter of that name; nullptr if there is none.
const Parameter* find_parameter(std::string_view path);

/// The parameter of that name, its own or another form's, which the drive has; nullptr if it has
/// none.
const Parameter* find_parameter(std::string_view path, const Drive& drive);

/// A section of a file.
struct Section {
  std::string_view name;
  std::string_view contents;  ///< for messages: "with inertia and friction"
  bool (*is_present)(const Drive& drive);
  void (*add)(Drive& drive);  ///< makes an optional section
};
const std::vector<Section>& all_sections();

/// Of the parameter, by its slot in the drive. Precondition: exists().
ParameterKind kind_of(const Parameter& parameter, const Drive& drive);

/// Where the slot's number lies; nullptr if it is not given, or holds something else.
double* given_number(const Slot& slot);

/// Whether the drive has this parameter.
bool exists(const Parameter& parameter, const Drive& drive);

/// All words for the parameter's choices, its own first.
std::vector<std::string> words_of(const Parameter& parameter);

/// The index of the choice that a word names; empty for any other word.
std::optional<std::size_t> choice_named(const Parameter& parameter, std::string_view word);

/// Why the parameter refuses this word, if it has a reason of its own; else empty.
std::string_view reason_against(const Parameter& parameter, std::string_view word);

/// Whether the parameter holds numbers of which Drive::is_rounded tells: those of a normal form,
/// and lists of a controller.
bool may_be_rounded(const Parameter& parameter, const Drive& drive);

/// Notes a value that the parameter must not have, in `unit`.
void check_number(RangeCheck& check, const Parameter& parameter, double value,
                  std::string_view unit);

/// The value of a number, or its default if it is not given; empty if that is "none". Precondition:
/// exists(), and its slot is that of a number.
std::optional<double> number_in(const Parameter& parameter, const Drive& drive);

}  // namespace gearlash
