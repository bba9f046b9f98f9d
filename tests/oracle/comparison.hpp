// One random case, simulated by the library and by the reference, compared event by event.
#pragma once

#include <cstddef>
#include <string>

#include "random_servo.hpp"

namespace gearlash::oracle {

enum class Method {
  odeint,      ///< Boost.odeint, Runge–Kutta–Fehlberg 7(8) in long double
  exponential  ///< matrix exponential from a hundred digits, for any stiffness
};

struct ComparisonOptions {
  double until = 18.849555921538759;       ///< three undamped periods
  std::size_t event_limit = 30;            ///< as the library counts them
  double tolerance = 1e-11;                ///< of the period 2π, and of each state's own scale
  double fastest_rate_for_odeint = 300.0;  ///< beyond it the explicit method is too slow
  double largest_condition = 1e6;          ///< where a comparison stops meaning anything
  int random_times = 5;
};

struct CaseReport {
  Method method = Method::exponential;
  std::string failure;     ///< empty: agreed
  std::size_t events = 0;  ///< compared one by one
  std::size_t settlings = 0;
  std::size_t states = 0;             ///< compared at times between events
  bool cut_short = false;             ///< stopped at a grazing or at the largest condition
  double condition = 1.0;             ///< worst of the events compared
  double time_error = 0.0;            ///< worst |Δt|/2π
  double state_error = 0.0;           ///< worst |Δx|/scale, events and times between
  double amplitude_error = 0.0;       ///< of half the peak-to-peak of the load, relative
  double scaled_error = 0.0;          ///< worst of all errors divided by max(1, condition)
  double reference_difference = 0.0;  ///< scaled likewise: odeint against exponential; 0 if not run
};

/// The condition number of an event is measured, not estimated: the reference is run again with
/// relative errors of 1e-12 in the initial state and in the state after every event; the deviation
/// of the event divided by 1e-12, the largest of four such runs, is its condition. A deviation of
/// the library's is accepted up to tolerance × max(1, condition). Where a perturbed run meets other
/// events the motion passes within 1e-12 of grazing and the comparison stops ("cut short").
CaseReport compare(const RandomCase& drawn, const ComparisonOptions& options);

}  // namespace gearlash::oracle
