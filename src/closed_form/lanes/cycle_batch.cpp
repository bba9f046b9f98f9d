#include "closed_form/lanes/cycle_batch.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <string>

#include "closed_form/cycle_bounds.hpp"
#include "closed_form/lanes/cycle_kernel.hpp"

namespace gearlash {
namespace {

using detail::CycleBlock;

detail::CycleKernel kernel_for(VectorUnit unit) {
  if (unit > widest_vector_unit()) {
    throw std::invalid_argument(std::string("vector unit ") + name_of(unit) +
                                " is not of this machine");
  }
#ifdef GEARLASH_X86_VECTOR_UNITS
  if (unit == VectorUnit::avx512) return detail::solve_block_avx512;
  if (unit == VectorUnit::avx2) return detail::solve_block_avx2;
#endif
  return detail::solve_block_baseline;
}

void require_rows(const CycleColumns& cycles, std::size_t rows) {
  const auto require = [&](const char* name, std::size_t size) {
    if (size == rows) return;
    throw std::invalid_argument(std::string("column ") + name + ": " + std::to_string(size) +
                                " rows; must be " + std::to_string(rows) +
                                ", as many as there are servos");
  };
  require("verdict", cycles.verdict.size());
  require("growth_at_rest", cycles.growth_at_rest.size());
  require("size", cycles.size.size());
  require("motor_size", cycles.motor_size.size());
  require("period", cycles.period.size());
  require("multiplier", cycles.multiplier.size());
  require("impact_speed", cycles.impact_speed.size());
  require("engaged_time", cycles.engaged_time.size());
  require("separated_time", cycles.separated_time.size());
  require("motor_friction_loss", cycles.motor_friction_loss.size());
  require("load_friction_loss", cycles.load_friction_loss.size());
  require("impact_loss", cycles.impact_loss.size());
  require("residual", cycles.residual.size());
}

/// The last servo fills up the last lanes.
void load(CycleBlock& block, std::span<const NormalizedServo> servos) {
  constexpr std::size_t lanes = CycleBlock::most_lanes;
  const std::size_t rows = (servos.size() + lanes - 1) / lanes * lanes;
  for (std::size_t row = 0; row < rows; ++row) {
    const NormalizedServo& servo = servos[std::min(row, servos.size() - 1)];
    block.damping[row] = servo.damping;
    block.inertia_ratio[row] = servo.inertia_ratio;
    block.friction_ratio[row] = servo.friction_ratio;
    block.backlash[row] = servo.backlash;
  }
}

void write_row(const CycleColumns& cycles, std::size_t row, Verdict verdict, double growth_at_rest,
               const LimitCycle& cycle) {
  cycles.verdict[row] = verdict;
  cycles.growth_at_rest[row] = growth_at_rest;
  cycles.size[row] = cycle.size;
  cycles.motor_size[row] = cycle.motor_size;
  cycles.period[row] = cycle.period;
  cycles.multiplier[row] = cycle.multiplier;
  cycles.impact_speed[row] = cycle.impact_speed;
  cycles.engaged_time[row] = cycle.engaged_time;
  cycles.separated_time[row] = cycle.separated_time;
  cycles.motor_friction_loss[row] = cycle.energy.motor_friction;
  cycles.load_friction_loss[row] = cycle.energy.load_friction;
  cycles.impact_loss[row] = cycle.energy.impacts;
  cycles.residual[row] = cycle.residual;
}

/// The rows of the block, those that are not certain included.
void write_from_block(const CycleColumns& cycles, std::size_t begin, const CycleBlock& block,
                      std::size_t rows) {
  for (std::size_t row = 0; row < rows; ++row) {
    cycles.verdict[begin + row] =
        block.outcome[row] == CycleBlock::hunts ? Verdict::hunts : Verdict::cannot_hunt;
  }
  const auto copy = [&](const CycleBlock::Column& from, std::span<double> to) {
    std::copy_n(from, rows, to.begin() + static_cast<std::ptrdiff_t>(begin));
  };
  copy(block.growth_at_rest, cycles.growth_at_rest);
  const std::span<double> properties[] = {cycles.size,
                                          cycles.motor_size,
                                          cycles.period,
                                          cycles.multiplier,
                                          cycles.impact_speed,
                                          cycles.engaged_time,
                                          cycles.separated_time,
                                          cycles.motor_friction_loss,
                                          cycles.load_friction_loss,
                                          cycles.impact_loss,
                                          cycles.residual};
  static_assert(std::size(properties) == CycleBlock::property_count);
  for (std::size_t i = 0; i < CycleBlock::property_count; ++i) {
    copy(block.properties[i], properties[i]);
  }
}

/// A servo that is refused is named by its row.
LimitCycleAnalysis analyse_row(const NormalizedServo& servo, std::size_t row) {
  try {
    return analyse_limit_cycles(servo);
  } catch (const InvalidInput& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) fault.where = "servo " + std::to_string(row);
    throw InvalidInput(std::move(faults));
  }
}

void solve_alone(const NormalizedServo& servo, const CycleColumns& cycles, std::size_t row) {
  const LimitCycleAnalysis analysis = analyse_row(servo, row);
  const LimitCycle* cycle = largest_stable(analysis);
  write_row(cycles, row, analysis.verdict, analysis.growth_at_rest,
            cycle != nullptr ? *cycle : LimitCycle{});
}

bool for_kernel(const NormalizedServo& servo) {
  return servo.restitution == 0.0 && servo.sensor == ShaftName::load;
}

}  // namespace

std::vector<VectorUnit> available_vector_units() {
  std::vector<VectorUnit> units = {VectorUnit::baseline};
#ifdef GEARLASH_X86_VECTOR_UNITS
  // Not xsimd's own question: it asks the processor alone, not whether the operating system saves
  // the registers.
  if (__builtin_cpu_supports("avx2")) {
    units.push_back(VectorUnit::avx2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
      units.push_back(VectorUnit::avx512);
    }
  }
#endif
  return units;
}

VectorUnit widest_vector_unit() {
  static const VectorUnit widest = available_vector_units().back();
  return widest;
}

const char* name_of(VectorUnit unit) {
  switch (unit) {
    case VectorUnit::baseline:
      return "baseline";
    case VectorUnit::avx2:
      return "avx2";
    case VectorUnit::avx512:
      return "avx512";
  }
  return "";
}

namespace {

bool is_proved(const NormalizedServo& servo, Verdict verdict) {
  if (servo.backlash == 0.0 || servo.damping == 0.0) return true;
  const double nothing_known = std::numeric_limits<double>::quiet_NaN();
  const CycleBounds bounds = bound_cycles(box_of(servo, Reading::exact), nothing_known);
  if (verdict == Verdict::hunts) return bounds.all_hunt();
  return verdict == Verdict::undecided || bounds.none_hunt();
}

bool has_plastic_contact(const NormalizedServo& servo) {
  return servo.restitution == 0.0 || servo.inertia_ratio == 0.0 || std::isinf(servo.inertia_ratio);
}

}  // namespace

std::size_t keep_proved(std::span<const NormalizedServo> servos, const CycleColumns& cycles) {
  std::size_t unproved = 0;
  for (std::size_t row = 0; row < servos.size(); ++row) {
    const NormalizedServo& servo = servos[row];
    if (!has_plastic_contact(servo) || is_proved(servo, cycles.verdict[row])) continue;
    write_row(cycles, row, Verdict::undecided, cycles.growth_at_rest[row], LimitCycle{});
    ++unproved;
  }
  return unproved;
}

BatchCount find_limit_cycles(std::span<const NormalizedServo> servos, const CycleColumns& cycles,
                             VectorUnit unit) {
  require_rows(cycles, servos.size());
  const detail::CycleKernel solve = kernel_for(unit);
  BatchCount count;
  CycleBlock block;
  for (std::size_t begin = 0; begin < servos.size(); begin += CycleBlock::rows) {
    const std::size_t rows = std::min(CycleBlock::rows, servos.size() - begin);
    load(block, servos.subspan(begin, rows));
    solve(block, rows);
    write_from_block(cycles, begin, block, rows);
    std::size_t alone = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      const NormalizedServo& servo = servos[begin + row];
      if (for_kernel(servo) && block.outcome[row] != CycleBlock::uncertain) continue;
      solve_alone(servo, cycles, begin + row);
      ++alone;
    }
    count.side_by_side += rows - alone;
    count.one_by_one += alone;
  }
  return count;
}

}  // namespace gearlash
