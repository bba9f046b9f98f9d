// Newton's method that cannot leave its bracket: the last step of every certified crossing.
#pragma once

#include <cmath>
#include <limits>

namespace gearlash {

struct ValueAndSlope {
  double value;
  double slope;
};

/// Root of a continuous function in [low, high], to the last bits of a double.
///
/// Precondition: f(high) has the sign `sign_at_high` (+1 or −1) or is zero, f(low) the opposite
/// sign or zero. The bracket shrinks at every evaluation; a Newton step that would leave it, or
/// that does not halve the one before, is replaced by bisection, so the loop ends after at most
/// about 2 × 64 bisections' worth of steps whatever f does. `guess` is clamped into the bracket.
template <class Function>
double bracketed_root(const Function& f, double low, double high, double guess,
                      double sign_at_high) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr int step_limit = 256;
  double x = guess > low && guess < high ? guess : 0.5 * (low + high);
  double previous_step = high - low;
  for (int step_count = 0; step_count < step_limit; ++step_count) {
    const auto [value, slope] = f(x);
    if (value == 0.0) return x;
    if (value * sign_at_high > 0.0) {
      high = x;
    } else {
      low = x;
    }
    double next = x - value / slope;
    const bool newton_is_good = next > low && next < high &&
                                std::abs(next - x) <= 0.5 * std::abs(previous_step);
    // A Newton step below the resolution has converged even when it points across the bracket's
    // end, which then is the root's other neighbour.
    if (std::abs(value) <= epsilon * std::abs(slope * x)) {
      return next >= low && next <= high ? next : x;
    }
    if (!newton_is_good) next = 0.5 * (low + high);
    previous_step = next - x;
    if (next == x || high - low <= epsilon * std::abs(high)) return next;
    x = next;
  }
  return x;
}

}  // namespace gearlash
