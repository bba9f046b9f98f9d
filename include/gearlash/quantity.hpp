// What can be asked of an answer: one list of quantities, from which tables, targets, charts and
// columns are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gearlash {

enum class Quantity : std::uint8_t {
  verdict,
  growth_at_rest,
  amplitude,
  motor_amplitude,
  center,
  period,
  frequency,
  multiplier,
  impact_speed,
  mesh_torque,
  engaged_time,
  separated_time,
  motor_friction_loss,
  load_friction_loss,
  impact_loss,
  motor_dry_friction_loss,
  load_dry_friction_loss,
  contact_loss,
  energy_fed,
  residual,
  static_error,
  error,
  error_if_disturbed,
  time_to_rest,
  ceiling,
  motor_ceiling,
  effort_ceiling,
  bandwidth,
  phase_margin,
  gain_margin,
  lag,
  rise_time,
  overshoot,
  settling_time
};
inline constexpr std::size_t quantity_count = static_cast<std::size_t>(Quantity::settling_time) + 1;

enum class QuantityScope : std::uint8_t {
  answer,  ///< of the drive as a whole
  /// Of one motion: the largest cycle that is not unstable, else the largest irregular motion.
  motion,
  ceiling,  ///< of Answer::ceiling
  loop,     ///< of Answer::loop
  step      ///< of Answer::step
};

enum class QuantityKind : std::uint8_t { number, choice };

/// What is known of one quantity. Texts are of static storage.
struct QuantityInfo {
  Quantity quantity{};         ///< its number
  std::string_view name{};     ///< "motor_amplitude"
  std::string_view unit{};     ///< SI: "rad", "s", …; "1" of a bare number; empty of a choice
  std::string_view meaning{};  ///< "amplitude of the load, half peak-to-peak"
  QuantityScope scope = QuantityScope::motion;  ///< what it is of
  QuantityKind kind = QuantityKind::number;     ///< a number or a word
};

/// All of them, in the order of Quantity.
[[nodiscard]] std::span<const QuantityInfo> quantities() noexcept;
[[nodiscard]] const QuantityInfo& info_of(Quantity quantity) noexcept;
/// The enumerator's name: "amplitude", "growth_at_rest", …
[[nodiscard]] std::string_view name_of(Quantity quantity) noexcept;
/// The quantity of that name, with "-" for "_" too, or of an older one ("size"); nothing where
/// there is none.
[[nodiscard]] std::optional<Quantity> find_quantity(std::string_view name);

}  // namespace gearlash
