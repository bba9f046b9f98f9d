#include "closed_form/lanes/cycle_batch.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "base/names.hpp"
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
  const auto require = [&](Quantity quantity, std::size_t size) {
    if (size == 0 || size == rows) return;
    throw std::invalid_argument("column " + std::string(name_of(quantity)) + ": " +
                                std::to_string(size) + " rows; must be " + std::to_string(rows) +
                                ", as many as there are servos, or none");
  };
  require(Quantity::verdict, cycles.verdict.size());
  for (const Quantity quantity : solved_quantities) require(quantity, cycles[quantity].size());
}

/// Repeats the last servo in the lanes left over.
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
  if (!cycles.verdict.empty()) cycles.verdict[row] = verdict;
  const auto write = [&](Quantity quantity, double value) {
    if (!cycles[quantity].empty()) cycles[quantity][row] = value;
  };
  write(Quantity::growth_at_rest, growth_at_rest);
  for (const CycleQuantity& one : cycle_quantities) write(one.quantity, one.of(cycle));
}

static_assert(std::size(cycle_quantities) == CycleBlock::property_count);

/// Writes the rows of the block, including uncertain ones, which are solved again later.
void write_from_block(const CycleColumns& cycles, std::size_t begin, const CycleBlock& block,
                      std::size_t rows) {
  for (std::size_t row = 0; row < (cycles.verdict.empty() ? 0 : rows); ++row) {
    cycles.verdict[begin + row] =
        block.outcome[row] == CycleBlock::hunts ? Verdict::hunts : Verdict::cannot_hunt;
  }
  const auto copy = [&](const CycleBlock::Column& from, std::span<double> to) {
    if (to.empty()) return;
    std::copy_n(from, rows, to.begin() + static_cast<std::ptrdiff_t>(begin));
  };
  copy(block.growth_at_rest, cycles[Quantity::growth_at_rest]);
  for (std::size_t i = 0; i < CycleBlock::property_count; ++i) {
    copy(block.properties[i], cycles[cycle_quantities[i].quantity]);
  }
}

/// Names the row of a servo that is refused.
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
  LimitCycle seen = cycle != nullptr ? *cycle : LimitCycle{};
  if (cycle == nullptr) seen.amplitude = analysis.irregular_amplitude;
  write_row(cycles, row, analysis.verdict, analysis.growth_at_rest, seen);
}

bool for_kernel(const NormalizedServo& servo) { return servo.restitution == 0.0; }

}  // namespace

std::vector<VectorUnit> available_vector_units() {
  std::vector<VectorUnit> units = {VectorUnit::baseline};
#ifdef GEARLASH_X86_VECTOR_UNITS
  // xsimd asks the processor alone. This also asks whether the operating system saves the
  // registers.
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
  constexpr Names<VectorUnit::avx512> names("baseline", "avx2", "avx512");
  return names[unit];
}

namespace {

bool is_proved(const ServoBox& box, Verdict verdict) {
  const double nothing_known = std::numeric_limits<double>::quiet_NaN();
  const CycleBounds bounds = bound_cycles(box, nothing_known);
  if (verdict == Verdict::hunts) return bounds.all_hunt();
  return verdict == Verdict::undecided || bounds.none_hunt();
}

bool has_plastic_contact(const NormalizedServo& servo) {
  return servo.restitution == 0.0 || servo.inertia_ratio == 0.0 || std::isinf(servo.inertia_ratio);
}

}  // namespace

std::size_t keep_proved(std::span<const NormalizedServo> servos, const CycleColumns& cycles,
                        const std::function<ServoBox(std::size_t row)>& box_of_row) {
  std::size_t unproved = 0;
  for (std::size_t row = 0; row < servos.size(); ++row) {
    const NormalizedServo& servo = servos[row];
    if (!has_plastic_contact(servo) || servo.backlash == 0.0 || servo.damping == 0.0) continue;
    if (is_proved(box_of_row(row), cycles.verdict[row])) continue;
    const std::span<double> growth = cycles[Quantity::growth_at_rest];
    write_row(cycles, row, Verdict::undecided, growth.empty() ? 0.0 : growth[row], LimitCycle{});
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
