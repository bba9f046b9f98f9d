#include "bouncing_sensitivity.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>

#include "dual_numbers.hpp"
#include "gearlash/cycle/half_cycle_algebra.hpp"
#include "gearlash/cycle/return_map.hpp"
#include "gearlash/motion/phase.hpp"

namespace gearlash {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

/// (y, P, u̇) before an impact on the forward face.
using DualArrival = std::array<Dual, 3>;

/// The shafts on the forward face, or in the gap.
struct DualState {
  Dual load_position, load_speed, gap, gap_speed;
};

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

/// See flight_from().
DualFlight flight_from(const DualDynamics& dynamics, const DualState& state) {
  return {.load_position = state.load_position,
          .load_speed = state.load_speed,
          .gap = state.gap,
          .gap_speed = state.gap_speed,
          .motor_acceleration = -dynamics.motor_rate * (state.load_speed + state.gap_speed) -
                                state.load_position / dynamics.motor_inertia,
          .load_deceleration = dynamics.load_rate * state.load_speed,
          .coupling = -state.load_speed / dynamics.motor_inertia,
          .load_rate = dynamics.load_rate,
          .motor_rate = dynamics.motor_rate};
}

DualState state_after(const DualFlight& flight, const Dual& time) {
  const BasicFlightDecays<Dual> decays = dual_decays(flight, time);
  const BasicFlightMotion<Dual> motion = motion_after(flight, time, decays);
  return {motion.load_position, motion.load_speed,
          flight.gap + displacement_after(flight, time, decays), motion.gap_speed};
}

/// When a flight meets the face that it meets after `time`: u(t) does not change.
Dual time_of_contact(const DualFlight& flight, double time) {
  const DualState at = state_after(flight, time);
  return {time, -at.gap.derivatives() / at.gap_speed.value()};
}

/// Newton's law, momentum kept (J_M + J_L = 1); the face does not move.
DualState after_impact(const DualDynamics& dynamics, const DualState& before) {
  DualState after = before;
  after.gap = before.gap.value();
  after.load_speed =
      before.load_speed + dynamics.motor_inertia * (1.0 + dynamics.restitution) * before.gap_speed;
  after.gap_speed = -dynamics.restitution * before.gap_speed;
  return after;
}

/// Faces together, from (y, P) until N falls through zero: how long, where the load turns, and the
/// state on the line N = 0, whose amplitude is √(Q/Q(line)) e^{−ζt}.
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

/// Runs a motion again from an arrival, with the simulator's own events.
struct Rerun {
  const ServoDynamics& plain;
  const DualDynamics& dynamics;
  DualState state{};
  DualFlight flight{};
  Dual duration = 0.0;
  DualRange range{};

  void add_impact() {
    range.include(state.load_position);
    state = after_impact(dynamics, state);
    flight = flight_from(dynamics, state);
  }

  void engage() {
    const Dual speed = state.load_speed + dynamics.motor_inertia * state.gap_speed;
    const DualEngagement engaged = engagement(dynamics, state.load_position, speed);
    duration += engaged.duration;
    if (engaged.turning) range.include(*engaged.turning);
    flight = clean_parting<Dual>(dynamics, engaged.load_position, engaged.load_speed, state.gap);
  }

  void fly(double time) {
    const Dual flying = time_of_contact(flight, time);
    duration += flying;
    state = state_after(flight, flying);
  }

  /// To the next arrival at the other face, or to the flight that never comes back to this one.
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

  /// Mirrored.
  DualArrival next() const {
    return {-state.load_position, -(state.load_speed + dynamics.motor_inertia * state.gap_speed),
            -state.gap_speed};
  }
};

// ---- the cycle as a fixed point -----------------------------------------------------------------

/// k traversals and what they did. A full period is twice an odd number of them, or an even one.
struct Iterated {
  Arrival end;
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  double duration = 0.0;
};

std::optional<Iterated> iterated(const ServoDynamics& dynamics, const Arrival& arrival, int order) {
  Iterated all{.end = arrival};
  for (int i = 0; i < order; ++i) {
    const Traversal one = traverse(dynamics, all.end);
    if (one.outcome != Traversal::Outcome::arrived) return std::nullopt;
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
    arrival += (map->slope - Eigen::Matrix3d::Identity()).fullPivLu().solve(arrival - map->end);
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

/// The arrival before LimitCycle::start, and after how many traversals it comes again.
std::optional<Orbit> orbit_of(const ServoDynamics& dynamics, const LimitCycle& cycle) {
  const ServoState& start = cycle.start;
  const double gap_speed = start.motor_speed - start.load_speed;
  const Arrival arrival(start.load_position, start.load_speed + dynamics.motor_inertia * gap_speed,
                        -gap_speed / dynamics.restitution);
  constexpr double near = 1e-6;
  for (const int order : {1, 2, 3, 4, 6, 8}) {
    const auto map = iterated(dynamics, arrival, order);
    if (!map) return std::nullopt;
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

/// As LimitCycle has it: the real one of largest modulus, or the modulus of a pair.
double multiplier_of(const Eigen::Matrix3d& slope, int order) {
  const Eigen::Vector3cd eigenvalues =
      Eigen::EigenSolver<Eigen::Matrix3d>(slope, false).eigenvalues();
  Eigen::Index largest = 0;
  eigenvalues.cwiseAbs().maxCoeff(&largest);
  const auto value = eigenvalues(largest);
  const double multiplier = value.imag() == 0.0 ? value.real() : std::abs(value);
  return repeats_of(order) == 2 ? multiplier * multiplier : multiplier;
}

NormalizedServo shifted(NormalizedServo servo, Eigen::Index number, double step) {
  double* const fields[] = {&servo.damping, &servo.inertia_ratio, &servo.friction_ratio,
                            &servo.restitution};
  *fields[number] += step;
  return servo;
}

/// Central differences, extrapolated once. The map of a settling cycle steps by some 1e-8 where one
/// bounce more is followed before the rest are summed up: a step across such a place shows in that
/// two differences disagree, and a shorter one is taken. NaN where none will do, or where a
/// neighbour has no such cycle.
double multiplier_slope(const NormalizedServo& servo, const Orbit& orbit, Eigen::Index number,
                        const Arrival& arrival_slope) {
  const double present = std::array{servo.damping, servo.inertia_ratio, servo.friction_ratio,
                                    servo.restitution}[static_cast<std::size_t>(number)];
  const double room = number >= by_friction_ratio ? std::min(present, 1.0 - present) : present;
  const auto at = [&](double step) {
    const NormalizedServo here = shifted(servo, number, step);
    const ServoDynamics dynamics = servo_dynamics(here);
    const auto arrival = fixed_point(dynamics, orbit.arrival + step * arrival_slope, orbit.order);
    if (!arrival) return nan;
    return multiplier_of(iterated(dynamics, *arrival, orbit.order)->slope, orbit.order);
  };
  const auto difference = [&](double step) { return (at(step) - at(-step)) / (2.0 * step); };
  if (!(room > 0.0)) return nan;
  for (const double share : {1e-4, 1e-5, 1e-6}) {
    const double whole = difference(share * room);
    const double half = difference(0.5 * share * room);
    constexpr double agreement = 1e-6;
    if (std::abs(half - whole) <= agreement * (std::abs(half) + 1.0 / present)) {
      return (4.0 * half - whole) / 3.0;
    }
  }
  return nan;
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
  double side = 1.0;
  for (int i = 0; i < repeats_of(orbit->order) * orbit->order; ++i, side = -side) {
    Rerun rerun{.plain = plain, .dynamics = dynamics};
    if (rerun.run(arrival) != Course::arrived) return std::nullopt;
    arrival = rerun.next();
    duration += rerun.duration;
    range.include(side * rerun.range.largest);
    range.include(side * rerun.range.smallest);
  }
  Eigen::Matrix<double, 3, numbers> map;
  for (int i = 0; i < 3; ++i) map.row(i) = arrival[static_cast<std::size_t>(i)].derivatives();
  // Over a whole period, which for an odd order is two runs of the cycle.
  const Eigen::Matrix<double, 3, 4> arrival_slopes =
      (Eigen::Matrix3d::Identity() - map.rightCols<3>()).fullPivLu().solve(map.leftCols<4>());
  const auto total = [&](const Dual& of) -> BouncingGradient {
    return of.derivatives().head<4>() + arrival_slopes.transpose() * of.derivatives().tail<3>();
  };
  BouncingSlopes slopes{.size = total(0.5 * (range.largest - range.smallest)),
                        .period = total(duration),
                        .multiplier = {}};
  for (Eigen::Index number = 0; number < 4; ++number) {
    slopes.multiplier(number) = multiplier_slope(servo, *orbit, number, arrival_slopes.col(number));
  }
  return slopes;
}

std::optional<BouncingGradient> bouncing_log_growth_gradient(const NormalizedServo& servo) {
  ServoDynamics wide = servo_dynamics(servo);
  wide.backlash = 1e6;  // which motion of order one cannot cross: see growth_at_rest.cpp
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
