#include "gearlash/answer.hpp"

#include <cmath>

#include "base/lists.hpp"
#include "base/names.hpp"

namespace gearlash {

std::size_t SearchRecord::count(const std::string& end) const {
  return count_of(starts, [&](const StartOutcome& start) { return start.end == end; });
}

const Cycle* Answer::largest_stable() const noexcept {
  const Cycle* largest = nullptr;
  for (const Cycle& cycle : cycles) {
    if (cycle.stability == Stability::unstable) continue;
    if (largest == nullptr || cycle.amplitude > largest->amplitude) largest = &cycle;
  }
  return largest;
}

/// The speed of the gap is the root w of w² (1 − e²) = 2 b (a + β w), or a/λ where it is braked; a
/// has a part that is proportional to b. So w/b falls as b grows. As b falls w falls, and w²/b too
/// unless it is braked.
std::optional<double> Ceiling::widest_backlash(double amplitude, double backlash) const {
  if (!load) return std::nullopt;
  double gap = 0.0;
  double gap_speed = 0.0;
  double others = 0.0;
  for (const CeilingTerm& term : terms) {
    (term.source == "gap" ? gap : term.source == "gap speed" ? gap_speed : others) += term.load;
  }
  constexpr double rounding = 1e-12;  // of the sums
  const double left = (1.0 - rounding) * amplitude - (1.0 + rounding) * others;
  if (gap == 0.0) return std::nullopt;
  double times = left / (gap + gap_speed);
  if (times < 1.0 && is_gap_speed_braked) times = (left - (1.0 + rounding) * gap_speed) / gap;
  if (times < 1.0 && !is_gap_speed_braked && left > 0.0) {  // gap x² + gap_speed x = left
    const double root = std::sqrt(gap_speed * gap_speed + 4.0 * gap * left);
    times = std::pow(2.0 * left / (gap_speed + root), 2) * (1.0 - rounding);
  }
  if (!(times > 0.0)) return std::nullopt;
  return (1.0 - rounding) * (times * backlash);
}

bool hunts(Verdict verdict) {
  switch (verdict) {
    case Verdict::cannot_hunt:
    case Verdict::comes_to_rest:
    case Verdict::forced:
    case Verdict::undecided:
      return false;
    default:
      return true;
  }
}

const char* name_of(Verdict verdict) {
  constexpr Names<Verdict::undecided> names(
      "cannot hunt", "comes to rest", "hunts", "hunts if disturbed", "hunts irregularly",
      "grows without bound", "runs away", "runs away if disturbed", "forced", "undamped",
      "undecided");
  return names[verdict];
}

const char* name_of(Certainty certainty) {
  constexpr Names<Certainty::theorem> names("searched", "computed", "enclosed", "theorem");
  return names[certainty];
}

const char* name_of(CycleKind kind) {
  constexpr Names<CycleKind::subharmonic> names("symmetric", "asymmetric", "subharmonic");
  return names[kind];
}

const char* name_of(Stability stability) {
  constexpr Names<Stability::unstable> names("stable", "neutral", "unstable");
  return names[stability];
}

const char* name_of(RestKind kind) {
  constexpr Names<RestKind::torque_limit> names("no limit", "dead band", "torque limit");
  return names[kind];
}

const char* name_of(Fulfilment fulfilment) {
  constexpr Names<Fulfilment::not_known> names("met", "not met", "not known");
  return names[fulfilment];
}

const char* name_of(Cause cause) {
  constexpr Names<Cause::load_torque> names("gap", "dry friction", "integral action", "delay",
                                            "encoder", "load torque");
  return names[cause];
}

const char* name_of(Engine engine) { return engine == Engine::general ? "general" : "closed form"; }

}  // namespace gearlash
