// The linear form of every controller, and the timing of a sampled one.
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "base/interval.hpp"
#include "base/lists.hpp"
#include "gearlash/controller.hpp"
#include "gearlash/fault.hpp"

namespace gearlash::drive {

/// z′ = state_matrix z + input_matrix (r, y, v) + anti_windup (τ − τ_asked), with the requested
/// torque
///   τ_asked = output z + direct (r, y, v);
/// r is the reference, y and v are the sensed position and speed, and τ is the delivered torque:
/// τ_asked within the motor's limit.
template <class Number>
struct LinearControllerOf {
  std::vector<std::vector<Number>> state_matrix{};                   ///< n rows of n
  std::vector<std::vector<Number>> input_matrix{};                   ///< n rows of 3
  std::vector<Number> output{};                                      ///< n
  std::vector<Number> direct = std::vector<Number>(3, Number(0.0));  ///< 3
  std::vector<Number> anti_windup{};                                 ///< n, or none
  /// Whether z′ is the next z, from sample to sample; else the slope of z.
  bool is_of_samples = false;

  std::size_t order() const { return output.size(); }

  static constexpr auto members() {
    return std::make_tuple(&LinearControllerOf::state_matrix, &LinearControllerOf::input_matrix,
                           &LinearControllerOf::output, &LinearControllerOf::direct,
                           &LinearControllerOf::anti_windup, &LinearControllerOf::is_of_samples);
  }
};
using LinearController = LinearControllerOf<double>;

/// Whether the row, of (r, y, v), knows r and y by their difference alone.
template <class Number>
bool is_of_difference(const std::vector<Number>& row) {
  return row[0] == -row[1];
}
/// Of intervals made of one number, or of two that are the same double.
inline bool is_of_difference(const std::vector<Interval>& row) {
  return row[0].low == -row[1].high && row[0].high == -row[1].low;
}

/// Whether a controller does.
template <class Number>
bool knows_error_alone(const LinearControllerOf<Number>& controller) {
  return is_of_difference(controller.direct) &&
         all_of(controller.input_matrix,
                [](const std::vector<Number>& row) { return is_of_difference(row); });
}

/// Work and memory grow with its cube, and coefficients of a higher order lose their digits.
inline constexpr std::size_t highest_order = 64;

/// Every fault of a controller whose lists are of different shapes, too long or not finite. Gains
/// may have any sign; the user decides what they do.
std::vector<Fault> faults(const LinearController& controller);

/// A state advances by T ((1 − share) ẋ(t) + share ẋ(t + T)): ½, 1, 0.
double share_of_end(Discretization method);

/// A position controller runs at every one of at most so many ticks.
inline constexpr int most_position_ticks = 1000;

/// Periods from one tick of the position controller to the next. Precondition: a sound sampling.
int position_ticks(const Sampling& sampling);
/// s, from one of its ticks to the next.
inline double position_period(const Sampling& sampling) {
  return sampling.period * static_cast<double>(position_ticks(sampling));
}

/// Each period that a result waits for its output is a number of the state.
inline constexpr int most_periods_of_delay = 100;

/// A computational delay as whole periods, in which other samples are read, and a rest.
struct SplitDelay {
  int whole_periods = 0;
  double rest = 0.0;  ///< s, above 0 and at most the period; 0 if there is no delay
};

/// Precondition: a sound sampling. A delay within rounding of a multiple of the period counts as
/// that multiple.
SplitDelay split_delay(const Sampling& sampling);

/// The controller from sample to sample,
///   z⁺ = state_matrix z + input_matrix (r, y, v) + anti_windup (τ − τ_asked),
/// outputs as above; one that is so already, as it is. Precondition: both are sound.
LinearController sampled_controller(const LinearController& controller, const Sampling& sampling);
/// Contains that of every controller and period, s, within.
LinearControllerOf<Interval> sampled_controller(const LinearControllerOf<Interval>& controller,
                                                const Interval& period, Discretization method);

/// Of (r, y, v) ↦ x: what x receives of a reference and of a position at it. 0 where it knows their
/// difference alone.
template <class Number>
Number sum_of_both(const std::vector<Number>& row) {
  return is_of_difference(row) ? Number(0.0) : row[0] + row[1];
}

/// Whether a position that stands beside the reference leaves no state of the controller standing,
/// within the torque limit: 0 = state_matrix z + input_matrix (0, y, 0) has no solution for y ≠ 0.
/// Sampling by any method keeps that. Precondition: faults(controller) is empty.
bool integrates(const LinearController& controller);

/// The largest modulus of an eigenvalue of the state matrix; 0 without states.
double spectral_radius(const LinearController& controller);

}  // namespace gearlash::drive
