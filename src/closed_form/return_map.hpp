// The map from one arrival to the next; its fixed points are bouncing limit cycles.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "closed_form/phase.hpp"

namespace gearlash {

/// The instant before an impact on the forward face, after crossing the gap from the other one: (y,
/// P, u̇) with P = J_M v_M + J_L v_L, the speed of the common momentum, and u̇ > 0. Arrivals at the
/// backward face are mirrored (all signs reversed) into this form.
using Arrival = Eigen::Vector3d;

struct Traversal {
  enum class Outcome {
    arrived,       ///< `next` is the next arrival, mirrored
    came_to_rest,  ///< the faces never cross the gap again
    event_limit    ///< more bounces than could be followed
  };
  Outcome outcome = Outcome::came_to_rest;
  Arrival next = Arrival::Zero();
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();  ///< ∂next/∂arrival
  double duration = 0.0;
  double engaged_time = 0.0;       ///< of it, with the faces engaged (settling included)
  double hardest_impact = 0.0;     ///< largest |u̇| before an impact
  std::size_t impacts = 0;         ///< counted one by one
  std::size_t events = 0;          ///< all events that were followed
  bool settled = false;            ///< the bounces settled (the map then has rank one)
  double parting_amplitude = 0.0;  ///< (y, ẏ) along the torque-free line when engaged faces part

  bool arrives() const { return outcome == Outcome::arrived; }
};

/// Follows the motion from one arrival through its bounces, engagement and parting to the arrival
/// at the other face, with its derivative. Each flow is linear, so it carries a disturbance as it
/// carries a state. An impact at a disturbed time carries it by the saltation matrix
///   δ⁺ = R δ⁻ + (R ẋ⁻ − ẋ⁺) δt,  δt = −δu/u̇,
/// a separation by the identity (u̇ = ü = 0 there), and a settling by centre of mass and momentum,
/// less what friction takes of it until the gap is closed. Source: Müller, Chaos, Solitons &
/// Fractals 5 (1995) 1671; Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical
/// Systems (2004), ch. 7. Precondition: two masses (0 < J_M < 1) and b > 0. `slope` is computed
/// only on request.
enum class Derivative { wanted, not_wanted };
inline constexpr std::size_t traversal_event_limit = 200'000;
Traversal traverse(const ServoDynamics& dynamics, const Arrival& arrival,
                   Derivative derivative = Derivative::wanted,
                   std::size_t event_limit = traversal_event_limit);

/// The first arrival of a motion in which the faces part forward at (y, ẏ) = ±amplitude × the
/// torque-free line, with the sign at which they can part so. `outcome` and `next` are those of the
/// arrival.
Traversal first_arrival(const ServoDynamics& dynamics, double amplitude);

/// The state just after the impact that an arrival ends in, about reference 0.
GapState after_arrival(const ServoDynamics& dynamics, const Arrival& arrival);

}  // namespace gearlash
