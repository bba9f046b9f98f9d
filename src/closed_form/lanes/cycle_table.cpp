#include "closed_form/lanes/cycle_table.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace gearlash {
namespace {

struct Naming {
  const char* name;
  const char* description;
  const char* unit;
};

/// By CycleQuantity.
constexpr std::array<Naming, quantity_count> namings = {
    {{"growth_at_rest", "growth at rest: the servo hunts when it exceeds 1", "1"},
     {"size", "size of limit cycle: half peak-to-peak of the load", "rad"},
     {"motor_size", "half peak-to-peak of the motor, at the load shaft", "rad"},
     {"period", "period of the limit cycle", "1/omega_n"},
     {"multiplier", "Floquet multiplier over a period", "1"},
     {"impact_speed", "relative speed before the hardest impact", "rad omega_n"},
     {"engaged_time", "time with the faces engaged, of a period", "1/omega_n"},
     {"separated_time", "time with the faces apart, of a period", "1/omega_n"},
     {"motor_friction_loss", "energy lost in the motor's friction over a period", "K rad2"},
     {"load_friction_loss", "energy lost in the load's friction over a period", "K rad2"},
     {"impact_loss", "energy lost at impacts over a period", "K rad2"},
     {"residual", "relative mismatch of the state after one cycle", "1"}}};

const Naming& naming_of(CycleQuantity quantity) {
  return namings[static_cast<std::size_t>(quantity)];
}

}  // namespace

const char* name_of(CycleQuantity quantity) { return naming_of(quantity).name; }
const char* description_of(CycleQuantity quantity) { return naming_of(quantity).description; }
const char* unit_of(CycleQuantity quantity) { return naming_of(quantity).unit; }

std::optional<CycleQuantity> quantity_named(std::string_view name) {
  std::string underscored(name);
  std::replace(underscored.begin(), underscored.end(), '-', '_');
  for (const CycleQuantity quantity : all_quantities) {
    if (underscored == name_of(quantity)) return quantity;
  }
  return std::nullopt;
}

std::optional<double> limit_where_hunting_ends(CycleQuantity quantity, double backlash) {
  switch (quantity) {
    case CycleQuantity::motor_size:
      return 0.5 * backlash;
    case CycleQuantity::size:
    case CycleQuantity::impact_speed:
    case CycleQuantity::motor_friction_loss:
    case CycleQuantity::load_friction_loss:
    case CycleQuantity::impact_loss:
      return 0.0;
    case CycleQuantity::multiplier:
      return 1.0;
    case CycleQuantity::period:
    case CycleQuantity::separated_time:
      return std::numeric_limits<double>::infinity();
    case CycleQuantity::growth_at_rest:
    case CycleQuantity::engaged_time:
    case CycleQuantity::residual:
      break;
  }
  return std::nullopt;
}

CycleTable::CycleTable(std::size_t rows) : verdict(rows, Verdict::undecided) {
  values.fill(std::vector<double>(rows, std::numeric_limits<double>::quiet_NaN()));
}

CycleColumns columns_of(std::span<Verdict> verdict,
                        const std::array<std::span<double>, quantity_count>& numbers) {
  const auto column = [&](CycleQuantity quantity) {
    return numbers[static_cast<std::size_t>(quantity)];
  };
  return {.verdict = verdict,
          .growth_at_rest = column(CycleQuantity::growth_at_rest),
          .size = column(CycleQuantity::size),
          .motor_size = column(CycleQuantity::motor_size),
          .period = column(CycleQuantity::period),
          .multiplier = column(CycleQuantity::multiplier),
          .impact_speed = column(CycleQuantity::impact_speed),
          .engaged_time = column(CycleQuantity::engaged_time),
          .separated_time = column(CycleQuantity::separated_time),
          .motor_friction_loss = column(CycleQuantity::motor_friction_loss),
          .load_friction_loss = column(CycleQuantity::load_friction_loss),
          .impact_loss = column(CycleQuantity::impact_loss),
          .residual = column(CycleQuantity::residual)};
}

CycleColumns CycleTable::columns() {
  std::array<std::span<double>, quantity_count> numbers;
  for (std::size_t i = 0; i < quantity_count; ++i) numbers[i] = values[i];
  return columns_of(verdict, numbers);
}

}  // namespace gearlash
