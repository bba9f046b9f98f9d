// Carries small disturbances through a motion with impacts: the slope of the return map.
#pragma once

#include <Eigen/Core>
#include <array>

#include "closed_form/engaged_flow.hpp"
#include "closed_form/gap_flight.hpp"
#include "closed_form/servo_dynamics.hpp"

namespace gearlash {

/// Newton's law, momentum kept (J_M + J_L = 1). It is linear, so it serves states and disturbances.
inline GapState after_impact(const ServoDynamics& dynamics, const GapState& before) {
  GapState after = before;
  after.load_speed += dynamics.motor_inertia * (1.0 + dynamics.restitution) * before.gap_speed;
  after.gap_speed = -dynamics.restitution * before.gap_speed;
  return after;
}

/// One disturbance (δy, δv, δu, δu̇) at fixed time for each of the y, P, u̇ of an arrival
/// (return_map.hpp). Precondition: two masses.
class Disturbances {
 public:
  using State = GapState;

  /// Of the state before the arrival's impact.
  explicit Disturbances(const ServoDynamics& dynamics)
      : dynamics_(dynamics),
        disturbances_{State{1.0, 0.0, 0.0, 0.0}, State{0.0, 1.0, 0.0, 0.0},
                      State{0.0, -dynamics.motor_inertia, 0.0, 1.0}} {}

  /// The flight is linear and carries a disturbance as it carries a state.
  void fly(double time, const BasicFlightDecays<double>& decays) {
    for (State& disturbance : disturbances_) {
      disturbance = state_after(flight_of_two_masses(dynamics_, disturbance), time, decays);
    }
  }

  /// δ⁺ = R δ⁻ + (R ẋ⁻ − ẋ⁺) δt, δt = −δu/u̇.
  void meet(const State& before, const State& after) {
    const State rate_before = rate_of(before);
    const State rate_after = rate_of(after);
    for (State& disturbance : disturbances_) {
      const double delay = -disturbance.gap / before.gap_speed;
      const State on_face = after_impact(dynamics_, moved(disturbance, rate_before, delay));
      disturbance = moved(on_face, rate_after, -delay);
    }
  }

  /// From the state just after an impact, through any settling and the engaged motion, to the
  /// parting on the torque-free line. Its amplitude A, with A² Q(line) = Q(y, P) e^{−2ζt}, has
  ///   dA/A = ((y + 2ζP) dy + P dP)/Q(y, P).
  /// The bounces pass on y + J_M u. They also pass on P − (F_L J_M − F_M J_L) u, because Ṗ = −2ζP −
  /// y + (F_L J_M − F_M J_L) u̇ while the faces are apart.
  void part(const State& after_impact, const State& parting) {
    const double y = after_impact.load_position;
    const double momentum = momentum_of(after_impact);
    const double form = decaying_form(dynamics_.damping, y, momentum);
    for (State& disturbance : disturbances_) {
      const double of_position =
          disturbance.load_position + dynamics_.motor_inertia * disturbance.gap;
      const double of_momentum =
          momentum_of(disturbance) - dynamics_.torque_per_speed * disturbance.gap;
      const double growth =
          ((y + 2.0 * dynamics_.damping * momentum) * of_position + momentum * of_momentum) / form;
      disturbance = {growth * parting.load_position, growth * parting.load_speed, 0.0, 0.0};
    }
  }

  /// ∂(y, P, u̇)/∂(y, P, u̇) from arrival to arrival, mirrored, where the flight ends in the state
  /// `before` an impact on the backward face.
  Eigen::Matrix3d arrive(const State& before) const {
    const State rate = rate_of(before);
    Eigen::Matrix3d slope;
    for (std::size_t i = 0; i < disturbances_.size(); ++i) {
      const double delay = -disturbances_[i].gap / before.gap_speed;
      const State on_face = moved(disturbances_[i], rate, delay);
      const auto column = static_cast<Eigen::Index>(i);
      slope(0, column) = -on_face.load_position;
      slope(1, column) = -momentum_of(on_face);
      slope(2, column) = -on_face.gap_speed;
    }
    return slope;
  }

 private:
  /// ẋ in the gap.
  State rate_of(const State& state) const {
    const GapFlight flight = flight_of_two_masses(dynamics_, state);
    return {state.load_speed, -flight.load_deceleration, state.gap_speed, flight.gap_acceleration};
  }

  double momentum_of(const State& state) const {
    return state.load_speed + dynamics_.motor_inertia * state.gap_speed;
  }

  static State moved(const State& disturbance, const State& rate, double delay) {
    return {disturbance.load_position + rate.load_position * delay,
            disturbance.load_speed + rate.load_speed * delay, disturbance.gap + rate.gap * delay,
            disturbance.gap_speed + rate.gap_speed * delay};
  }

  const ServoDynamics& dynamics_;
  std::array<State, 3> disturbances_;
};

}  // namespace gearlash
