#include "closed_form/limit_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/lists.hpp"
#include "closed_form/bouncing_cycles.hpp"
#include "closed_form/cycle_of_orbit.hpp"
#include "closed_form/energy_balance.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/plastic_cycle.hpp"

namespace gearlash {
namespace {

/// Plastic contact: the theorem of docs/explanation/servo.md decides.
void analyse_plastic(const ServoDynamics& dynamics, LimitCycleAnalysis& analysis) {
  analysis.certainty =
      std::isinf(analysis.growth_at_rest) ? Certainty::theorem : Certainty::computed;
  if (analysis.growth_at_rest <= 1.0) {
    analysis.verdict = Verdict::cannot_hunt;
    return;
  }
  const auto half = balanced_half_cycle(dynamics, analysis.growth_at_rest);
  if (half) analysis.cycles.push_back(plastic_cycle(dynamics, *half));
  // The theorem proves a stable cycle. If none is found, growth at rest is 1 + rounding.
  if (half && analysis.cycles.front().stable) {
    analysis.verdict = Verdict::hunts;
    return;
  }
  analysis.verdict = Verdict::undecided;
  analysis.certainty = Certainty::computed;
  analysis.cycles.clear();
}

Verdict bouncing_verdict(double growth, const BouncingCycles& found) {
  if (std::isnan(growth)) return Verdict::undecided;
  const bool any_stable =
      any_of(found.cycles, [](const LimitCycle& cycle) { return cycle.stable; });
  if ((found.cut_short || found.any_neutral) && !any_stable) return Verdict::undecided;
  const bool any_lasting = any_stable || !std::isnan(found.irregular_amplitude);
  if (growth > 1.0 && !any_lasting) return Verdict::undecided;
  if (growth > 1.0) return any_stable ? Verdict::hunts : Verdict::hunts_irregularly;
  if (any_stable || !found.all_starts_settled) return Verdict::hunts_if_disturbed;
  return Verdict::cannot_hunt;
}

void analyse_bouncing(const NormalizedServo& servo, const ServoDynamics& dynamics,
                      LimitCycleAnalysis& analysis) {
  const BouncingCycles found = find_bouncing_cycles(servo, dynamics);
  analysis.cycles = found.cycles;
  analysis.neutral_swings = found.any_neutral;
  analysis.irregular_amplitude = found.irregular_amplitude;
  analysis.verdict = bouncing_verdict(analysis.growth_at_rest, found);
}

/// Verdicts that need no growth at rest, by exact comparisons.
std::optional<Verdict> verdict_by_theorem(const ServoDynamics& dynamics, bool is_dissipative) {
  if (dynamics.backlash == 0.0) {
    return dynamics.damping == 0.0 ? Verdict::undamped : Verdict::cannot_hunt;
  }
  if (dynamics.damping == 0.0 && dynamics.plastic_contact()) return Verdict::grows_without_bound;
  if (is_dissipative) return Verdict::cannot_hunt;
  return std::nullopt;
}

/// Everything that needs no search, with the verdict if a theorem gives it.
LimitCycleAnalysis begun(const ServoDynamics& dynamics, bool is_dissipative) {
  LimitCycleAnalysis analysis;
  analysis.growth_at_rest = growth_at_rest(dynamics);
  analysis.is_dissipative = is_dissipative;
  analysis.rests_engaged = dynamics.damping >= 1.0;
  if (const auto verdict = verdict_by_theorem(dynamics, is_dissipative)) {
    analysis.verdict = *verdict;
    analysis.certainty = Certainty::theorem;
  } else if (dynamics.damping == 0.0) {
    analysis.verdict = Verdict::grows_without_bound;
  } else {
    analysis.verdict = Verdict::undecided;
  }
  return analysis;
}

LimitCycleAnalysis analyse(const NormalizedServo& servo, bool is_dissipative) {
  const ServoDynamics dynamics = servo_dynamics(servo);
  LimitCycleAnalysis analysis = begun(dynamics, is_dissipative);
  if (analysis.verdict != Verdict::undecided) return analysis;
  if (dynamics.plastic_contact()) {
    analyse_plastic(dynamics, analysis);
  } else {
    analyse_bouncing(servo, dynamics, analysis);
  }
  return analysis;
}

/// Adds the cycle that is proved to exist, if doubles can find it. Next to the boundary it may be
/// missing, or its multiplier may be 1 by rounding.
void add_proved_cycle(const ServoDynamics& dynamics, LimitCycleAnalysis& analysis) {
  const double least = 1.0 + std::numeric_limits<double>::epsilon();
  const auto half = balanced_half_cycle(dynamics, std::max(analysis.growth_at_rest, least));
  if (!half) return;
  analysis.cycles.push_back(plastic_cycle(dynamics, *half));
  analysis.cycles.front().stable = true;
}

/// For plastic contact and damping: what holds for all servos of the box.
LimitCycleAnalysis enclose_plastic(const ServoDynamics& dynamics, const ServoBox& box,
                                   bool is_dissipative) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  LimitCycleAnalysis analysis = begun(dynamics, is_dissipative);
  const CycleBounds bounds = bound_cycles(box, unknown);
  analysis.growth_at_rest =
      std::clamp(analysis.growth_at_rest, bounds.growth_at_rest.low, bounds.growth_at_rest.high);
  const bool is_theorem =
      analysis.verdict != Verdict::undecided || std::isinf(bounds.growth_at_rest.low);
  if (bounds.all_hunt()) analysis.verdict = Verdict::hunts;
  if (bounds.none_hunt()) analysis.verdict = Verdict::cannot_hunt;
  analysis.certainty = is_theorem                               ? Certainty::theorem
                       : analysis.verdict != Verdict::undecided ? Certainty::enclosed
                                                                : Certainty::computed;
  if (analysis.verdict == Verdict::hunts) add_proved_cycle(dynamics, analysis);
  const double flight_time =
      analysis.cycles.empty() ? unknown : 0.5 * analysis.cycles.front().separated_time;
  analysis.bounds = bound_cycles(box, flight_time, MultiplierBounds::wanted);
  return analysis;
}

LimitCycleAnalysis enclosed(const NormalizedServo& servo, const ServoBox& box,
                            bool is_dissipative) {
  const ServoDynamics dynamics = servo_dynamics(servo);
  const bool may_hunt = dynamics.backlash > 0.0 && dynamics.damping > 0.0;
  return may_hunt && dynamics.plastic_contact() ? enclose_plastic(dynamics, box, is_dissipative)
                                                : analyse(servo, is_dissipative);
}

}  // namespace

LimitCycleAnalysis analyse_limit_cycles(const NormalizedServo& servo) {
  require_none(faults(servo));
  return analyse(servo, is_dissipative(servo));
}

LimitCycleAnalysis enclose_limit_cycles(const NormalizedServo& servo, const ServoBox& box) {
  require_none(faults(servo));
  LimitCycleAnalysis analysis = enclosed(servo, box, is_dissipative(box));
  analysis.rests_engaged = box.damping.high >= 1.0;
  return analysis;
}

LimitCycleAnalysis enclose_limit_cycles(const NormalizedServo& servo, Reading reading) {
  if (reading == Reading::converted) return enclose_limit_cycles(servo, box_of(servo, reading));
  require_none(faults(servo));
  return enclosed(servo, box_of(servo, reading), is_dissipative(servo, reading));
}

LimitCycleAnalysis analyse_beside(const NormalizedServo& servo, const LimitCycle* near,
                                  const NormalizedServo& servo_near) {
  const ServoDynamics dynamics = servo_dynamics(servo);
  LimitCycleAnalysis analysis = begun(dynamics, false);
  if (near == nullptr || analysis.verdict != Verdict::undecided) return analysis;
  if (dynamics.plastic_contact()) {
    analyse_plastic(dynamics, analysis);
  } else if (auto cycle = bouncing_cycle_beside(servo, *near, servo_near)) {
    cycle->stable = true;  // as the one near it; it may just have ceased to be
    analysis.cycles.push_back(*cycle);
  }
  return analysis;
}

const LimitCycle* largest_stable(const LimitCycleAnalysis& analysis) {
  return first_of(analysis.cycles, [](const LimitCycle& cycle) { return cycle.stable; });
}

}  // namespace gearlash
