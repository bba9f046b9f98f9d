// Boost.odeint: Dormand–Prince 5(4) with dense output; events are signs at the end of a step,
// located in the step's interpolant.
#pragma once

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint.hpp>

#include "rival.hpp"

namespace gearlash::benchmarks {

class OdeintRival {
 public:
  explicit OdeintRival(const NormalizedServo& servo) : servo_(servo) {}

  double follow_engagement(double& time, EngagedState& state, double face) {
    const auto derivative = [this](const EngagedState& z, EngagedState& rate, double) {
      rate[0] = z[1];
      rate[1] = -servo_.friction() * z[1] - z[0];
    };
    const auto torque = [&](const EngagedState& z) { return face * servo_.torque(z[0], z[1]); };
    const auto speed = [](const EngagedState& z) { return z[1]; };
    double turning = 0.0;
    engaged_stepper_.initialize(state, time, first_step);
    while (true) {
      const double before = engaged_stepper_.current_state()[1];
      engaged_stepper_.do_step(derivative);
      const EngagedState& now = engaged_stepper_.current_state();
      const bool parted = torque(now) < 0.0;
      double end = engaged_stepper_.current_time();
      if (parted) end = locate(engaged_stepper_, torque, state);
      const double after = parted ? state[1] : now[1];
      if (before * after < 0.0) {
        EngagedState peak;
        locate_within(engaged_stepper_, speed, engaged_stepper_.previous_time(), end, peak);
        turning = std::max(turning, std::abs(peak[0]));
      }
      if (!parted) continue;
      time = end;
      return turning;
    }
  }

  double follow_gap(double& time, GapState4& state, double face) {
    constexpr double longest = 1e3;
    const auto derivative = [this](const GapState4& z, GapState4& rate, double) {
      rate[0] = z[1];
      rate[3] = servo_.load_acceleration(z[3]);
      rate[1] = servo_.motor_acceleration(z[2], z[3] + z[1]) - rate[3];
      rate[2] = z[3];
    };
    const double start = time;
    const double margin = near_face_margin(state);
    const auto to_far = [&](const GapState4& z) { return servo_.backlash + face * z[0]; };
    const auto to_near = [&](const GapState4& z) { return margin - face * z[0]; };
    const auto opening = [&](const GapState4& z) { return -face * z[1]; };
    gap_stepper_.initialize(state, time, first_step);
    while (gap_stepper_.current_time() - start < longest) {
      gap_stepper_.do_step(derivative);
      const GapState4& now = gap_stepper_.current_state();
      if (to_far(now) < 0.0) {
        time = locate(gap_stepper_, to_far, state);
        return -face;
      }
      if (to_near(now) < 0.0) {
        // A bounce may begin and end in one step: its top lies before its end.
        const double top = locate(gap_stepper_, opening, state);
        time = locate_within(gap_stepper_, to_near, top, gap_stepper_.current_time(), state);
        return face;
      }
    }
    return 0.0;
  }

 private:
  template <class State>
  using Stepper = boost::numeric::odeint::dense_output_runge_kutta<
      boost::numeric::odeint::controlled_runge_kutta<
          boost::numeric::odeint::runge_kutta_dopri5<State>>>;
  static constexpr double first_step = 0.05;

  template <class State>
  static Stepper<State> make_stepper() {
    return boost::numeric::odeint::make_dense_output(
        rival_tolerance, rival_tolerance, boost::numeric::odeint::runge_kutta_dopri5<State>());
  }

  /// Zero of `f` in the step just made; the state there in `state`.
  template <class StepperType, class Function, class State>
  static double locate(StepperType& stepper, const Function& f, State& state) {
    return locate_within(stepper, f, stepper.previous_time(), stepper.current_time(), state);
  }

  template <class StepperType, class Function, class State>
  static double locate_within(StepperType& stepper, const Function& f, double low, double high,
                              State& state) {
    const auto at = [&](double t) {
      stepper.calc_state(t, state);
      return f(state);
    };
    const auto close = [](double a, double b) { return b - a <= 1e-13 * (1.0 + std::abs(b)); };
    const double at_low = at(low);
    const double at_high = at(high);
    double time = high;
    if (at_low * at_high < 0.0) {
      std::uintmax_t iterations = 60;
      const auto bracket =
          boost::math::tools::toms748_solve(at, low, high, at_low, at_high, close, iterations);
      time = bracket.second;
    } else if (at_low <= 0.0) {
      time = low;
    }
    stepper.calc_state(time, state);
    return time;
  }

  Coefficients servo_;
  Stepper<EngagedState> engaged_stepper_ = make_stepper<EngagedState>();
  Stepper<GapState4> gap_stepper_ = make_stepper<GapState4>();
};

}  // namespace gearlash::benchmarks
