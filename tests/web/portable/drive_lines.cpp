#include "drive_lines.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "answer_line.hpp"
#include "base/seeded_draws.hpp"
#include "gearlash/analyse.hpp"

namespace gearlash::portable {
namespace {

/// The same drive but for the last bit of some of its numbers.
Drive nudged(Drive drive, SeededDraws& draws) {
  for (double* number :
       {&drive.motor.inertia, &drive.motor.friction.viscous, &drive.gearbox.backlash,
        &drive.load.inertia, &drive.load.friction.viscous}) {
    *number *= 1.0 + ulp * draws.one_of({-1.0, 0.0, 1.0});
  }
  return drive;
}

/// How far the multiplier of each cycle moves when the last bits of the drive's numbers do. It is a
/// product of slopes from event to event that may be large and cancel: stiff faces between many
/// events lose three digits of it, and others none.
std::vector<double> spreads_of_multipliers(const Drive& drive, const std::vector<Cycle>& cycles) {
  constexpr int times = 2;
  std::vector<double> spreads(cycles.size(), 0.0);
  SeededDraws draws(34);
  for (int i = 0; i < times; ++i) {
    const Answer near = analyse(nudged(drive, draws), {.proofs = false, .borders = false});
    for (std::size_t k = 0; k < cycles.size() && k < near.cycles.size(); ++k) {
      const bool is_same = near.cycles[k].kind == cycles[k].kind &&
                           near.cycles[k].events_per_period == cycles[k].events_per_period;
      if (!is_same || cycles[k].stability == Stability::unstable) continue;
      spreads[k] = std::max(spreads[k], std::abs(near.cycles[k].multiplier - cycles[k].multiplier));
    }
  }
  return spreads;
}

/// Two builds differ in the order in which the terms of matrix products are summed, hence to
/// rounding. A cycle is known to its residual, a share of the state, times its condition. The
/// residual itself is known to some ulps: it may be 0 by chance. On an unstable cycle an error
/// grows with the multiplier within a period, and so does that of the product of slopes that the
/// multiplier is; that of a stable one is known to its spread besides.
void print_cycle(const std::string& name, const Cycle& cycle, double spread_of_multiplier) {
  constexpr double least_residual = 4.0 * ulp;
  const double known = std::max(cycle.residual, least_residual);
  const double condition = condition_of_cycle(cycle.multiplier);
  const double swing = std::max(cycle.amplitude, cycle.motor_amplitude);
  const double growth = std::max(1.0, cycle.multiplier);
  AnswerLine(cycle.stability == Stability::unstable ? "unstable-cycle" : "cycle", name)
      .word("kind", name_of(cycle.kind))
      .word("stability", name_of(cycle.stability))
      .word("events", std::to_string(cycle.events_per_period))
      .number("amplitude", cycle.amplitude, known * condition * swing)
      .number("motor_amplitude", cycle.motor_amplitude, known * condition * swing)
      .number("period", cycle.period, known * condition * cycle.period)
      .number("multiplier", cycle.multiplier,
              std::max(known * condition * growth * growth, spread_of_multiplier));
}

/// A mean of n swings is known to their deviation/√n; an extent of them all to their deviation.
void print_motion(const std::string& name, const IrregularMotion& motion) {
  AnswerLine line("irregular", name);
  line.word("motor_alone", motion.is_motor_alone ? "yes" : "no");
  const bool is_measured = motion.mean_amplitude && motion.amplitude_deviation &&
                           motion.mean_period && motion.period_deviation && motion.watched;
  line.word("measured", is_measured ? "yes" : "no");
  if (!is_measured) return;
  const double root = std::sqrt(std::max(1.0, *motion.watched / *motion.mean_period));
  line.number("amplitude", motion.amplitude, *motion.amplitude_deviation)
      .number("mean_amplitude", *motion.mean_amplitude, *motion.amplitude_deviation / root)
      .number("mean_period", *motion.mean_period, *motion.period_deviation / root);
}

}  // namespace

void print_drive(const std::string& name, const Drive& drive, Listed listed) {
  const bool is_all = listed == Listed::all;
  const Answer answer = analyse(drive, {.proofs = false, .borders = is_all});
  const std::vector<double> spreads = is_all ? spreads_of_multipliers(drive, answer.cycles)
                                             : std::vector<double>(answer.cycles.size(), 0.0);
  std::size_t cycles = 0;
  for (std::size_t i = 0; i < answer.cycles.size(); ++i) {
    if (!is_all && answer.cycles[i].stability == Stability::unstable) continue;
    print_cycle(name + "." + std::to_string(cycles++), answer.cycles[i], spreads[i]);
  }
  std::size_t motions = 0;
  for (const IrregularMotion& motion : answer.irregular) {
    print_motion(name + "." + std::to_string(motions++), motion);
  }
  AnswerLine("drive", name)
      .word("verdict", name_of(answer.verdict))
      .word("engine", name_of(answer.engine))
      .word("certainty", name_of(answer.certainty))
      .word("cycles", std::to_string(cycles))
      .word("irregular", std::to_string(motions));
}

}  // namespace gearlash::portable
