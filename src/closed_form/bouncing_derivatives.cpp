#include "closed_form/bouncing_derivatives.hpp"

#include <array>
#include <cmath>
#include <complex>

#include "base/special_numbers.hpp"
#include "closed_form/disturbances.hpp"
#include "closed_form/dual_numbers.hpp"
#include "closed_form/half_cycle_algebra.hpp"
#include "closed_form/phase.hpp"
#include "closed_form/return_orbits.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

/// Derivatives by damping, inertia ratio, friction ratio, restitution, and the arrival's y, P, u̇.
enum : int { by_restitution = servo_numbers, by_arrival, numbers = by_arrival + 3 };
using Dual = BasicDual<numbers>;
using Gradient = Dual::DerType;
using DualDynamics = BasicServoDynamics<Dual>;
using DualFlight = BasicGapFlight<Dual>;

DualDynamics dynamics_with_restitution(const NormalizedServo& servo) {
  DualDynamics dynamics = dual_dynamics<Dual>(servo);
  dynamics.restitution = Dual(servo.restitution, Gradient::Unit(by_restitution));
  return dynamics;
}

using DualSlope = BasicDisturbances<Dual>::Slope;

/// (y, P, u̇) before an impact on the forward face.
using DualArrival = std::array<Dual, 3>;

/// The shafts on the forward face, or in the gap.
using DualState = BasicGapState<Dual>;

Arrival values_of(const DualArrival& arrival) {
  return {arrival[0].value(), arrival[1].value(), arrival[2].value()};
}

/// The load's largest and smallest position so far.
struct DualRange {
  Dual largest = -infinity;
  Dual smallest = infinity;

  void include(const Dual& position) {
    if (position.value() > largest.value()) largest = position;
    if (position.value() < smallest.value()) smallest = position;
  }
};

// ---- the phases ---------------------------------------------------------------------------------

/// The time of a contact with its derivatives, given its value: u at the contact is constant.
Dual time_of_contact(const DualFlight& flight, double time) {
  const Dual fixed = time;
  const DualState at = state_after(flight, fixed, dual_decays(flight, fixed));
  return {time, -at.gap.derivatives() / at.gap_speed.value()};
}

/// Engaged motion from (y, P) until N falls through zero: its duration, the load's turning point,
/// and the final state on the line N = 0, with the amplitude √(Q/Q(line)) e^{−ζt}.
struct DualEngagement {
  Dual duration;
  std::optional<Dual> turning;
  Dual load_position, load_speed;
};

DualEngagement engagement(const DualDynamics& dynamics, const Dual& position, const Dual& speed) {
  const Dual& zeta = dynamics.damping;
  const Dual form = decaying_form(zeta, position, speed);
  DualEngagement engaged;
  engaged.duration = dual_first_zero<Dual>(zeta, mesh_torque(dynamics, position, speed),
                                           mesh_torque_rate(dynamics, position, speed));
  const EngagedFlow flow{zeta.value(), position.value(), speed.value()};
  const Dual slope = -2.0 * zeta * speed - position;
  const double turning_time = first_zero(zeta.value(), speed.value(), slope.value());
  if (turning_time < engaged.duration.value()) {
    const Dual time = dual_first_zero<Dual>(zeta, speed, slope);
    const Dual turning = sqrt(form) * exp(-zeta * time);
    engaged.turning = flow.at(turning_time).position > 0.0 ? turning : Dual(-turning);
  }
  const BasicTorqueFreeLine<Dual>& line = dynamics.torque_free_line;
  const Dual line_form = decaying_form(zeta, line.position, line.speed);
  Dual amplitude = sqrt(form / line_form) * exp(-zeta * engaged.duration);
  const EngagedFlow::State end = flow.at(engaged.duration.value());
  if (end.position * line.position.value() + end.speed * line.speed.value() < 0.0) {
    amplitude = -amplitude;
  }
  engaged.load_position = amplitude * line.position;
  engaged.load_speed = amplitude * line.speed;
  return engaged;
}

// ---- from arrival to arrival --------------------------------------------------------------------

enum class Course { arrived, left_for_good, not_followed };

/// Repeats a motion from an arrival, with the simulator's own events.
struct Rerun {
  const ServoDynamics& plain;
  const DualDynamics& dynamics;
  DualState state{};
  DualFlight flight{};
  Dual duration = 0.0;
  DualRange range{};
  BasicDisturbances<Dual> disturbances{dynamics};

  void add_impact() {
    range.include(state.load_position);
    const DualState before = state;
    state = after_impact(dynamics, before);
    state.gap = before.gap.value();  // the face does not move
    disturbances.meet(before, state);
    flight = flight_of_two_masses(dynamics, state);
  }

  void engage() {
    const Dual speed = state.load_speed + dynamics.motor_inertia * state.gap_speed;
    const DualEngagement engaged = engagement(dynamics, state.load_position, speed);
    duration += engaged.duration;
    if (engaged.turning) range.include(*engaged.turning);
    disturbances.part(state, {engaged.load_position, engaged.load_speed, state.gap, 0.0});
    flight = clean_parting<Dual>(dynamics, engaged.load_position, engaged.load_speed, state.gap);
  }

  void fly(double time) {
    const Dual flying = time_of_contact(flight, time);
    const BasicFlightDecays<Dual> decays = dual_decays(flight, flying);
    duration += flying;
    disturbances.fly(flying, decays);
    state = state_after(flight, flying, decays);
  }

  /// Runs to the next arrival at the other face, or to a flight that never returns to this one.
  Course run(const DualArrival& arrival) {
    const Arrival at = values_of(arrival);
    const PhaseStart start = begin_phase(
        plain, {at(0), at(1) - plain.motor_inertia * at(2), 0.5 * plain.backlash, at(2)});
    if (!start.impact_at_start) return Course::not_followed;
    state = {arrival[0], arrival[1] - dynamics.motor_inertia * arrival[2], 0.5 * plain.backlash,
             arrival[2]};
    add_impact();
    Phase phase = start.phase;
    for (std::size_t event = 0; event < traversal_event_limit; ++event) {
      const PhaseEnd end = end_of_phase(plain, phase, infinity);
      const bool apart = phase.mode == Mode::separated;
      if (!end.has_event) return apart ? Course::left_for_good : Course::not_followed;
      if (apart && end.kind != EventKind::impact) return Course::not_followed;
      if (apart) {
        if (end.face == Face::backward) return arrive(end.duration);
        fly(end.duration);
        add_impact();
      } else if (end.kind == EventKind::separation) {
        engage();  // the common motion since the last impact, a settling included
      }
      phase = end.next;
    }
    return Course::not_followed;
  }

  Course arrive(double time) {
    backward_flight = flight;
    fly(time);
    return Course::arrived;
  }

  DualFlight backward_flight{};  ///< the one that crosses the gap

  /// The next arrival, mirrored.
  DualArrival next() const {
    return {-state.load_position, -(state.load_speed + dynamics.motor_inertia * state.gap_speed),
            -state.gap_speed};
  }

  /// ∂next/∂arrival.
  DualSlope slope() const { return disturbances.arrive(state); }
};

// ---- the cycle as a fixed point -----------------------------------------------------------------

/// Successive traversals. A full period is twice an odd number of them, or an even number.
struct Iterated {
  Arrival end;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  double duration = 0.0;
};

std::optional<Iterated> iterated(const ServoDynamics& dynamics, const Arrival& arrival, int order) {
  Iterated all{.end = arrival};
  for (int i = 0; i < order; ++i) {
    const Traversal one = traverse(dynamics, all.end);
    if (!one.arrives()) return std::nullopt;
    all.end = one.next;
    all.slope = one.slope * all.slope;
    all.duration += one.duration;
  }
  return all;
}

int repeats_of(int order) { return order % 2 == 0 ? 1 : 2; }

/// The fixed point near an arrival, by a few steps of Newton's method.
std::optional<Arrival> fixed_point(const ServoDynamics& dynamics, Arrival arrival, int order) {
  constexpr int steps = 4;
  for (int i = 0; i < steps; ++i) {
    const auto map = iterated(dynamics, arrival, order);
    if (!map) return std::nullopt;
    arrival += solved_with_full_pivoting(Eigen::Matrix3d(map->slope - Eigen::Matrix3d::Identity()),
                                         Arrival(arrival - map->end));
  }
  const auto map = iterated(dynamics, arrival, order);
  constexpr double acceptable = 1e-10;
  if (!map || !((map->end - arrival).norm() <= acceptable * arrival.norm())) return std::nullopt;
  return arrival;
}

struct Orbit {
  Arrival arrival;
  int order;
};

/// The arrival before LimitCycle::start, and the number of traversals after which it recurs.
std::optional<Orbit> orbit_of(const ServoDynamics& dynamics, const LimitCycle& cycle) {
  const ServoState& start = cycle.start;
  const double gap_speed = start.motor_speed - start.load_speed;
  const Arrival arrival(start.load_position, start.load_speed + dynamics.motor_inertia * gap_speed,
                        -gap_speed / dynamics.restitution);
  constexpr double near = 1e-6;
  for (int order = 1; order <= longest_cycle_order; ++order) {
    const auto map = iterated(dynamics, arrival, order);
    if (!map) return std::nullopt;
    if (map->duration > (1.0 + near) * cycle.period) break;
    if (std::abs(repeats_of(order) * map->duration - cycle.period) > near * cycle.period ||
        (map->end - arrival).norm() > near * arrival.norm()) {
      continue;
    }
    const auto exact = fixed_point(dynamics, arrival, order);
    if (!exact) return std::nullopt;
    return Orbit{*exact, order};
  }
  return std::nullopt;
}

/// The eigenvalue λ of M with the largest modulus (for a complex pair, that modulus), with its
/// derivatives. With B(λ) the adjugate of λI − M, of rank one (right times left eigenvector) if λ
/// is simple,
///   dλ = tr(B dM)/tr B,   tr B = (λ − λ₂)(λ − λ₃).
/// dλ is NaN if λ is double.
Dual largest_eigenvalue(const DualSlope& dual) {
  Eigen::Matrix3d slope;
  for (Eigen::Index i = 0; i < slope.size(); ++i) slope(i) = dual(i).value();
  const Eigen::Vector3cd values = eigenvalues(slope);
  Eigen::Index largest = 0;
  values.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> value = values(largest);

  const double trace = slope.trace();
  const Eigen::Matrix3d square = slope * slope;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d linear = slope - trace * identity;
  const Eigen::Matrix3d constant =
      square - trace * slope + 0.5 * (trace * trace - square.trace()) * identity;
  const Eigen::Matrix3cd adjugate = value * value * identity + value * linear + constant;
  const bool is_real = value.imag() == 0.0;
  const double modulus = std::abs(value);
  const std::complex<double> direction = is_real ? 1.0 : std::conj(value) / modulus;
  const Eigen::Matrix3d by_entry = (direction * adjugate.transpose() / adjugate.trace()).real();
  constexpr double told_apart = 1e-6;  // rounding splits a double one by 1e-8
  Gradient gradient = Gradient::Constant(not_a_number);
  if (std::abs(adjugate.trace()) > told_apart * modulus * modulus) {
    gradient.setZero();
    for (Eigen::Index i = 0; i < slope.size(); ++i) gradient += by_entry(i) * dual(i).derivatives();
  }
  return {is_real ? value.real() : modulus, gradient};
}

}  // namespace

std::optional<BouncingSlopes> bouncing_slopes(const NormalizedServo& servo,
                                              const LimitCycle& cycle) {
  const ServoDynamics plain = servo_dynamics(servo);
  const auto orbit = orbit_of(plain, cycle);
  if (!orbit) return std::nullopt;
  const DualDynamics dynamics = dynamics_with_restitution(servo);
  DualArrival arrival;
  for (int i = 0; i < 3; ++i) {
    arrival[static_cast<std::size_t>(i)] = Dual(orbit->arrival(i), Gradient::Unit(by_arrival + i));
  }
  Dual duration = 0.0;
  DualRange range;
  DualSlope slope = DualSlope::Identity();  // over the traversals after which the cycle repeats
  double side = 1.0;
  for (int i = 0; i < repeats_of(orbit->order) * orbit->order; ++i, side = -side) {
    Rerun rerun{.plain = plain, .dynamics = dynamics};
    if (rerun.run(arrival) != Course::arrived) return std::nullopt;
    arrival = rerun.next();
    if (i < orbit->order) slope = (rerun.slope() * slope).eval();
    duration += rerun.duration;
    range.include(side * rerun.range.largest);
    range.include(side * rerun.range.smallest);
  }
  Eigen::Matrix<double, 3, numbers> map;
  for (int i = 0; i < 3; ++i) map.row(i) = arrival[static_cast<std::size_t>(i)].derivatives();
  // Derivatives over a whole period, which for an odd order is two runs of the cycle.
  const FourColumns arrival_slopes =
      solved_with_full_pivoting(Eigen::Matrix3d(Eigen::Matrix3d::Identity() - map.rightCols<3>()),
                                FourColumns(map.leftCols<4>()));
  const auto total = [&](const Gradient& of) -> BouncingGradient {
    return of.head<4>() + arrival_slopes.transpose() * of.tail<3>();
  };
  const Dual amplitude = 0.5 * (range.largest - range.smallest);
  const Dual root = largest_eigenvalue(slope);
  const Dual multiplier = repeats_of(orbit->order) == 2 ? Dual(root * root) : root;
  return BouncingSlopes{.amplitude = total(amplitude.derivatives()),
                        .period = total(duration.derivatives()),
                        .multiplier = total(multiplier.derivatives())};
}

std::optional<BouncingGradient> bouncing_log_growth_gradient(const NormalizedServo& servo) {
  ServoDynamics wide = servo_dynamics(servo);
  wide.backlash = 1e6;  // too wide to cross; see growth_at_rest.cpp
  const DualDynamics dynamics = dynamics_with_restitution(servo);
  Rerun rerun{.plain = wide, .dynamics = dynamics};
  const Dual contact_speed = 1.0 / dynamics.motor_friction;
  const Course course =
      rerun.run({Dual(-1.0), dynamics.motor_inertia * contact_speed, contact_speed});
  if (course == Course::not_followed) return std::nullopt;
  const DualFlight& flight = course == Course::arrived ? rerun.backward_flight : rerun.flight;
  const Dual rest = flight.load_position + flight.load_speed / dynamics.load_rate;
  return BouncingGradient(rest.derivatives().head<4>() / rest.value());
}

}  // namespace gearlash
