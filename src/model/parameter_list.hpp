// The parts of the list of parameters (model/parameters.hpp), and the words that their rows are
// made of.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/member_path.hpp"
#include "gearlash/units.hpp"
#include "model/parameters.hpp"

namespace gearlash::parameter_rows {

using namespace dimensions;
using enum Permitted;

std::vector<Parameter> mechanical_parameters();  ///< servo, motor, gearbox, load, contact
std::vector<Parameter> control_parameters();     ///< sensor, controller, sampling
std::vector<Parameter> firmware_parameters();    ///< the controller's registers
std::vector<Parameter> nonlinear_parameters();   ///< of the controller, among the former
std::vector<Parameter> signal_parameters();      ///< reference, load_torque,
                                                 ///< specification

/// Gives the drive the firmware with that index of all_firmwares(), all registers at their
/// defaults, and its sampling where the manual states it and the drive has none.
void take_firmware(Drive& drive, std::size_t index);

/// Gives a variant the alternative of that index, with its defaults if it has another one.
template <class... Alternatives>
void become(std::variant<Alternatives...>& variant, std::size_t index) {
  if (variant.index() == index) return;
  const std::variant<Alternatives...> all[] = {Alternatives{}...};
  variant = all[index];
}

/// The lists one after the other.
std::vector<Parameter> joined(std::initializer_list<std::vector<Parameter> (*)()> lists);

// A row of the list is entry(path, place, meaning, rules…):
//
//   entry("gearbox.backlash", in_gearbox<&Gearbox::backlash>,
//         "backlash at the load's shaft, from face to face",
//         unit<angle>, not_negative, required, UsualRange{1e-5, 0.1})
//
// A rule is of one of the types that set_rule() takes. What no rule states has the default of
// struct Parameter.

// ---- places: where a parameter is in a drive ----------------------------------------------------

using Place = Slot (*)(Drive& drive);
using Condition = bool (*)(const Drive& drive);

inline bool is_plant(const Drive& drive) { return !drive.servo; }
/// Whether the controller is a law with keys of its own, and no firmware.
inline bool has_law(const Drive& drive) { return !drive.servo && !drive.controller.firmware; }

/// The member to which the member pointers lead; see follow(). A member of an enumeration is a
/// choice in its order, a bool one of false and true.
template <auto... members>
Slot at(Drive& drive) {
  auto* member = follow<members...>(&drive);
  using Member = std::remove_pointer_t<decltype(member)>;
  if (member == nullptr) return {};
  if constexpr (std::is_enum_v<Member> || std::is_same_v<Member, bool>) {
    return Choice{[](const Drive& d) { return static_cast<std::size_t>(*follow<members...>(&d)); },
                  [](Drive& d, std::size_t choice) {
                    *follow<members...>(&d) = static_cast<Member>(choice);
                  }};
  } else {
    return member;
  }
}

/// The variant to which the member pointers lead, as a choice of its alternatives: their indices in
/// the order of the words.
template <std::array indices, auto... members>
Slot alternative_at(Drive& drive) {
  if (content_of(follow<members...>(&drive)) == nullptr) return {};
  return Choice{[](const Drive& d) {
                  const std::size_t index = content_of(follow<members...>(&d))->index();
                  const auto* found = std::find(indices.begin(), indices.end(), index);
                  return static_cast<std::size_t>(found - indices.begin());
                },
                [](Drive& d, std::size_t choice) {
                  become(*content_of(follow<members...>(&d)), indices[choice]);
                }};
}

/// A choice that functions of its own read and write.
template <std::size_t (*chosen)(const Drive&), void (*choose)(Drive&, std::size_t)>
Slot choice_by(Drive&) {
  return Choice{chosen, choose};
}

/// A place that only drives have which meet the condition.
template <Condition condition, Place place>
Slot only_if(Drive& drive) {
  return condition(drive) ? place(drive) : Slot{};
}

/// The first of these places that the drive has.
template <Place... places>
Slot first_of(Drive& drive) {
  Slot slot;
  [[maybe_unused]] const bool is_found =
      (!std::holds_alternative<std::monostate>(slot = places(drive)) || ...);
  return slot;
}

template <Condition condition, auto... members>
constexpr Place in_controller_if = only_if<condition, at<&Drive::controller, members...>>;
template <auto... members>
constexpr Place in_law = in_controller_if<has_law, &Controller::law, members...>;

// ---- rules --------------------------------------------------------------------------------------

struct Required {};
/// A file must give it if the drive has it.
inline constexpr Required required{};

/// Without a value it has that of another parameter.
struct DefaultOf {
  std::string_view path;
};

/// Parameter::wanted.
struct Wanted {
  std::string_view text;
};

/// The words of a choice.
using Words = std::vector<std::string_view>;

using DimensionRule = const Dimension* (*)(const Drive& drive);

template <const Dimension& dimension>
constexpr DimensionRule unit = [](const Drive&) { return &dimension; };

/// For the controller's output: torque or voltage.
template <const Dimension& with_torque, const Dimension& with_voltage>
constexpr DimensionRule unit_by_motor = [](const Drive& drive) {
  return std::holds_alternative<TorqueControl>(drive.motor.kind) ? &with_torque : &with_voltage;
};

inline void set_rule(Parameter& row, DimensionRule rule) { row.dimension = rule; }
inline void set_rule(Parameter& row, Permitted rule) { row.permitted = rule; }
inline void set_rule(Parameter& row, Required) { row.is_required = true; }
inline void set_rule(Parameter& row, DefaultOf rule) { row.otherwise = rule.path; }
inline void set_rule(Parameter& row, Wanted rule) { row.wanted = rule.text; }
inline void set_rule(Parameter& row, UsualRange rule) { row.usual = rule; }
inline void set_rule(Parameter& row, OtherForm rule) { row.other_forms.push_back(rule); }
inline void set_rule(Parameter& row, OtherWord rule) { row.other_words.push_back(rule); }
inline void set_rule(Parameter& row, RefusedWord rule) { row.refused_words.push_back(rule); }
inline void set_rule(Parameter& row, Words rule) { row.choices = std::move(rule); }

// ---- rows ---------------------------------------------------------------------------------------

template <class... Rules>
Parameter entry(std::string_view path, Place place, std::string_view meaning, Rules... rules) {
  Parameter row{.path = path, .slot = place, .meaning = meaning};
  (set_rule(row, std::move(rules)), ...);
  return row;
}

}  // namespace gearlash::parameter_rows
