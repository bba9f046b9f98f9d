#include "gearlash/answer.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash {

std::size_t SearchRecord::count(const std::string& end) const {
  return static_cast<std::size_t>(std::count_if(
      starts.begin(), starts.end(), [&](const StartOutcome& start) { return start.end == end; }));
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
  switch (verdict) {
    case Verdict::cannot_hunt:
      return "cannot hunt";
    case Verdict::comes_to_rest:
      return "comes to rest";
    case Verdict::hunts:
      return "hunts";
    case Verdict::hunts_if_disturbed:
      return "hunts if disturbed";
    case Verdict::hunts_irregularly:
      return "hunts irregularly";
    case Verdict::grows_without_bound:
      return "grows without bound";
    case Verdict::runs_away:
      return "runs away";
    case Verdict::runs_away_if_disturbed:
      return "runs away if disturbed";
    case Verdict::forced:
      return "forced";
    case Verdict::undamped:
      return "undamped";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

const char* name_of(Certainty certainty) {
  switch (certainty) {
    case Certainty::searched:
      return "searched";
    case Certainty::computed:
      return "computed";
    case Certainty::enclosed:
      return "enclosed";
    case Certainty::theorem:
      return "theorem";
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

const char* name_of(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::neutral:
      return "neutral";
    case Stability::unstable:
      return "unstable";
  }
  return "";
}

const char* name_of(RestKind kind) {
  switch (kind) {
    case RestKind::no_limit:
      return "no limit";
    case RestKind::dead_band:
      return "dead band";
    case RestKind::torque_limit:
      return "torque limit";
  }
  return "";
}

const char* name_of(Engine engine) { return engine == Engine::general ? "general" : "closed form"; }

}  // namespace gearlash
