#include "cycle_enclosure.hpp"

#include <cmath>
#include <limits>

#include "boxed_half_cycle.hpp"

namespace gearlash {
namespace {

using detail::BoxedEnd;
using detail::BoxedHalfCycle;
using detail::FlightTimes;

/// Whether no smaller motion ever grows past the cycle, R ≤ σ̄ on (0, σ̄], which is
///   ρ(t)/U(t) ≤ 1/U(t̄)  for all flight times t ≥ t̄:
/// then the cycle is stable and every motion ends in it, or at rest (docs/mathematics.md, One cycle
/// or none). Shown by steps: ρ rises with t, and so does U, so that it holds from t to t′ where
/// ρ(t′) ≤ U(t)/U(t̄), and for ever where that quotient reaches μ₀.
class Attraction {
 public:
  Attraction(const BoxedHalfCycle& half, const FlightTimes& times, const BoxedEnd& end,
             double growth_at_rest)
      : half_(half),
        first_(times.shortest),
        gap_(end.gap.high),
        log_growth_at_rest_(log(Interval(growth_at_rest)).high) {}

  bool is_proved() const {
    double time = end_of_first_step();
    if (!(time > first_)) return false;
    constexpr int most_steps = 60;
    for (int i = 0; i < most_steps; ++i) {
      const BoxedEnd here = half_.end(time);
      const double allowed = log(here.gap / gap_).low;
      if (allowed >= log_growth_at_rest_) return true;
      const double next = longer_flight(time, here.log_growth.high, allowed);
      if (!(next > time)) return false;
      time = next;
    }
    return false;
  }

 private:
  /// From t̄ on ρ/U falls for as long as Q exceeds J_M U (y + cP).
  double end_of_first_step() const {
    constexpr double longest = 0.2;
    constexpr double shortest = 1e-4;
    for (double share = longest; share > shortest; share *= 0.5) {
      const Interval time{first_, first_ * (1.0 + share)};
      const BoxedEnd end = half_.end(time);
      if (end.form.low > half_.thrust(time, end).high) return time.high;
    }
    return first_;
  }

  /// A flight after which ln ρ ≤ allowed; `time` where none is found.
  double longer_flight(double time, double log_growth, double allowed) const {
    constexpr double longest = 2.0;
    constexpr double shortest = 1e-6;
    for (double step = longest; step > shortest; step *= 0.5) {
      const double next = time * (1.0 + step);
      if (half_.end(next).log_growth.high <= allowed) return next;
    }
    static_cast<void>(log_growth);
    return time;
  }

  const BoxedHalfCycle& half_;
  double first_;
  double gap_;
  double log_growth_at_rest_;
};

}  // namespace

CycleEnclosure enclose_cycle(const ServoBox& box, double guessed_flight_time) {
  const BoxedHalfCycle half(box);
  CycleEnclosure enclosure;
  enclosure.bounds.growth_at_rest = half.growth_at_rest().bounds();
  const CycleBounds& bounds = enclosure.bounds;
  if (!bounds.all_hunt() || !(guessed_flight_time > 0.0)) return enclosure;
  if (!(half.form_at_parting().low > 0.0)) return enclosure;
  const FlightTimes times = detail::bounding_flight_times(half, guessed_flight_time, true);
  const Interval time{times.shortest, times.longest};
  if (!(time.low > 0.0) || std::isinf(time.high)) return enclosure;
  const BoxedEnd end = half.end(time);
  detail::set_bounds(enclosure.bounds, half, time, end);
  // On the cycle ρ = 1, so that R′ = 1 − J_M U (y + cP)/Q.
  enclosure.multiplier = square(1.0 - half.thrust(time, end) / end.form).bounds();
  if (Attraction(half, times, end, bounds.growth_at_rest.high).is_proved()) {
    enclosure.attraction = Certainty::enclosed;
  }
  return enclosure;
}

}  // namespace gearlash
