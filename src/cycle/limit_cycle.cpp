#include "gearlash/cycle/limit_cycle.hpp"

#include <algorithm>
#include <cmath>

#include "gearlash/cycle/bouncing_cycles.hpp"
#include "gearlash/cycle/growth_at_rest.hpp"
#include "gearlash/cycle/plastic_cycle.hpp"

namespace gearlash {
namespace {

bool rests_engaged(const ServoDynamics& dynamics) {
  const double zeta = dynamics.damping;
  if (zeta < 1.0) return false;
  const double slow_rate = 1.0 / (zeta + std::sqrt((zeta - 1.0) * (zeta + 1.0)));
  return mesh_torque(dynamics, -1.0, slow_rate) > 0.0;
}

/// Plastic contact: the theorem of docs/mathematics.md decides.
void analyse_plastic(const ServoDynamics& dynamics, LimitCycleAnalysis& analysis) {
  analysis.proved = true;
  if (analysis.growth_at_rest <= 1.0) {
    analysis.verdict = Verdict::cannot_hunt;
    return;
  }
  const auto half = balanced_half_cycle(dynamics, analysis.growth_at_rest);
  if (!half) {
    analysis.verdict = Verdict::undecided;
    analysis.proved = false;
    return;
  }
  const LimitCycle cycle = plastic_cycle(dynamics, *half);
  if (!cycle.stable) {  // growth at rest 1 + rounding: the theorem says that it is stable
    analysis.verdict = Verdict::undecided;
    analysis.proved = false;
    return;
  }
  analysis.verdict = Verdict::hunts;
  analysis.cycles.push_back(cycle);
}

Verdict bouncing_verdict(double growth, const BouncingCycles& found) {
  if (std::isnan(growth)) return Verdict::undecided;
  const bool any_stable = std::any_of(found.cycles.begin(), found.cycles.end(),
                                      [](const LimitCycle& cycle) { return cycle.stable; });
  if ((found.cut_short || found.any_neutral) && !any_stable) return Verdict::undecided;
  const bool any_lasting = any_stable || !std::isnan(found.irregular_size);
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
  analysis.irregular_size = found.irregular_size;
  analysis.verdict = bouncing_verdict(analysis.growth_at_rest, found);
}

}  // namespace

LimitCycleAnalysis analyse_limit_cycles(const NormalizedServo& servo) {
  require_none(validate(servo));
  const ServoDynamics dynamics = servo_dynamics(servo);
  LimitCycleAnalysis analysis;
  analysis.growth_at_rest = growth_at_rest(dynamics);
  analysis.rests_engaged = rests_engaged(dynamics);
  if (dynamics.backlash == 0.0) {
    analysis.verdict = dynamics.damping == 0.0 ? Verdict::undamped : Verdict::cannot_hunt;
    analysis.proved = true;
  } else if (dynamics.damping == 0.0) {
    analysis.verdict = Verdict::grows_without_bound;
    analysis.proved = dynamics.plastic_contact();
  } else if (dynamics.plastic_contact()) {
    analyse_plastic(dynamics, analysis);
  } else {
    analyse_bouncing(servo, dynamics, analysis);
  }
  return analysis;
}

const LimitCycle* largest_stable(const LimitCycleAnalysis& analysis) {
  const auto stable = std::find_if(analysis.cycles.begin(), analysis.cycles.end(),
                                   [](const LimitCycle& cycle) { return cycle.stable; });
  return stable == analysis.cycles.end() ? nullptr : &*stable;
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::cannot_hunt:
      return "cannot hunt";
    case Verdict::hunts:
      return "hunts";
    case Verdict::hunts_if_disturbed:
      return "hunts if disturbed";
    case Verdict::hunts_irregularly:
      return "hunts irregularly";
    case Verdict::grows_without_bound:
      return "grows without bound";
    case Verdict::undamped:
      return "undamped";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

const char* name_of(CycleKind kind) {
  switch (kind) {
    case CycleKind::symmetric:
      return "symmetric";
    case CycleKind::asymmetric:
      return "asymmetric";
    case CycleKind::subharmonic:
      return "subharmonic";
  }
  return "";
}

}  // namespace gearlash
