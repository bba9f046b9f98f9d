// Columns of limit cycles with memory of their own, and what each of them is called.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "closed_form/lanes/cycle_batch.hpp"

namespace gearlash {

/// The columns of numbers; angles in rad at the load, times in units of 1/ω_n, speeds in rad ω_n,
/// energies in K rad².
enum class CycleQuantity {
  growth_at_rest,
  size,
  motor_size,
  period,
  multiplier,
  impact_speed,
  engaged_time,
  separated_time,
  motor_friction_loss,
  load_friction_loss,
  impact_loss,
  residual
};
inline constexpr std::size_t quantity_count = 12;
inline constexpr std::array<CycleQuantity, quantity_count> all_quantities = {
    CycleQuantity::growth_at_rest,      CycleQuantity::size,
    CycleQuantity::motor_size,          CycleQuantity::period,
    CycleQuantity::multiplier,          CycleQuantity::impact_speed,
    CycleQuantity::engaged_time,        CycleQuantity::separated_time,
    CycleQuantity::motor_friction_loss, CycleQuantity::load_friction_loss,
    CycleQuantity::impact_loss,         CycleQuantity::residual};

/// "growth_at_rest", "size", …
const char* name_of(CycleQuantity quantity);
std::optional<CycleQuantity> quantity_named(std::string_view name);
/// What it is, in words: "size of limit cycle (half peak-to-peak of the load)".
const char* description_of(CycleQuantity quantity);
/// "rad", "1", "1/omega_n", "rad omega_n", "K rad2".
const char* unit_of(CycleQuantity quantity);

/// What it tends to where hunting ends, with plastic contact: 0 for the load's size, the speed and
/// the losses, half the backlash for the motor's size, 1 for the multiplier, infinity for the
/// period and the time apart. Nothing where that is another number from place to place, or where
/// there is no such end.
std::optional<double> limit_where_hunting_ends(CycleQuantity quantity, double backlash);

/// The columns of numbers by CycleQuantity.
CycleColumns columns_of(std::span<Verdict> verdict,
                        const std::array<std::span<double>, quantity_count>& numbers);

struct CycleTable {
  explicit CycleTable(std::size_t rows = 0);

  CycleColumns columns();
  std::size_t rows() const { return verdict.size(); }
  const std::vector<double>& operator[](CycleQuantity quantity) const {
    return values[static_cast<std::size_t>(quantity)];
  }

  std::vector<Verdict> verdict;
  std::array<std::vector<double>, quantity_count> values;  ///< by CycleQuantity
};

}  // namespace gearlash
