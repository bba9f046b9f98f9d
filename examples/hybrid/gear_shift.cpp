// A sleeve that is pushed into mesh with a gear: the gearbox of the ARCH competition.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "hybrid/hybrid_trajectory.hpp"

using namespace gearlash::hybrid;

namespace {

// Chen, Mitra & Tian, Motor-transmission drive system: a benchmark example for safety verification
// (ARCH 2015), with the numbers of the competition.
constexpr double restitution = 0.9;
constexpr double sleeve_mass = 3.2;     // kg
constexpr double gear_mass = 18.1;      // kg, what the second gear opposes to an impact
constexpr double gear_inertia = 0.7;    // kg m²
constexpr double radius = 0.08;         // m, of the sleeve
constexpr double shifting_force = 70;   // N
constexpr double resisting_torque = 1;  // N m
constexpr double meshed_from = -0.003;  // m, the axial position where the sleeve engages
constexpr double half_angle = 36.0 * std::numbers::pi / 180.0;  // of a tooth
constexpr double axial_acceleration = shifting_force / sleeve_mass;
constexpr double turning_acceleration = -radius * resisting_torque / gear_inertia;

enum GearboxMode : std::size_t { free_sleeve, meshed };
enum Number : Eigen::Index { axial, sideways, axial_speed, sideways_speed, impulse, count };

/// The sleeve hits a tooth: n = (sin, ±cos) is the face's normal. The speed along n is reversed
/// times the restitution, shared as the masses are; what is passed on adds to the impulse.
AffineReset impact(double side) {
  const double sine = std::sin(half_angle);
  const double cosine = side * std::cos(half_angle);
  const double masses = sleeve_mass * cosine * cosine + gear_mass * sine * sine;
  const double passed = (1.0 + restitution) * sleeve_mass * gear_mass / masses;
  Matrix matrix = Matrix::Identity(count, count);
  for (const Number along : {axial_speed, sideways_speed}) {
    const double share = along == axial_speed ? sine : cosine;
    matrix(axial_speed, along) -= passed * sine * share / sleeve_mass;
    matrix(sideways_speed, along) -= passed * cosine * share / gear_mass;
    matrix(impulse, along) += passed * share;
  }
  return {.matrix = matrix};
}

HybridSystem gearbox() {
  Matrix matrix = Matrix::Zero(count, count);
  matrix(axial, axial_speed) = matrix(sideways, sideways_speed) = 1.0;
  Vector offset = Vector::Zero(count);
  offset(axial_speed) = axial_acceleration;
  offset(sideways_speed) = turning_acceleration;
  const auto face = [&](const char* name, double side) {
    Vector room = Vector::Zero(count);  // to the face, as it falls to 0
    room(axial) = -std::tan(half_angle);
    room(sideways) = -side;
    return Transition{.name = name, .guard = {.normal = room}, .reset = impact(side)};
  };
  Vector depth = Vector::Zero(count);
  depth(axial) = 1.0;
  Matrix stopped = Matrix::Identity(count, count);
  stopped.block(axial_speed, axial_speed, 2, 2).setZero();
  stopped.block(impulse, axial_speed, 1, 2).setConstant(sleeve_mass);
  const Transition meshes{.name = "meshes",
                          .guard = {depth, -meshed_from},
                          .direction = Direction::rising,
                          .reset = {.matrix = stopped},
                          .target = meshed};
  const AffineFlow at_rest{Matrix::Zero(count, count), Vector::Zero(count)};
  return {.state_names = {"axial", "sideways", "axial speed", "sideways speed", "impulse"},
          .modes = {{.name = "free",
                     .flow = {matrix, offset},
                     .transitions = {face("upper tooth", 1.0), face("lower tooth", -1.0), meshes}},
                    {.name = "meshed", .flow = at_rest}}};
}

Trajectory shift(const PreparedSystem& system, double axial_start, double sideways_start) {
  Vector start = Vector::Zero(count);
  start(axial) = axial_start;
  start(sideways) = sideways_start;
  return simulate(system, State{free_sleeve, start}, {.until = 0.2});
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// What a grid of starts over a box does. It samples the box; it proves nothing of what is between.
void print_box(const PreparedSystem& system, const char* name, const Range& axial_start,
               const Range& sideways_start) {
  constexpr int points = 41;
  Range time;
  Range impulses;
  Range impacts;
  int late = 0;
  for (int i = 0; i < points; ++i) {
    for (int k = 0; k < points; ++k) {
      const auto within = [](const Range& range, int step) {
        return range.low + (range.high - range.low) * step / (points - 1);
      };
      const Trajectory motion = shift(system, within(axial_start, i), within(sideways_start, k));
      if (motion.end().mode != meshed) {
        ++late;
        continue;
      }
      time.include(motion.events().back().time);
      impulses.include(motion.end().numbers(impulse));
      impacts.include(static_cast<double>(motion.events().size() - 1));
    }
  }
  std::printf("%s  %6.1f to %.1f ms  %6.3f to %6.3f N s  %2.0f to %.0f  %d of %d\n", name,
              1e3 * time.low, 1e3 * time.high, impulses.low, impulses.high, impacts.low,
              impacts.high, late, points * points);
}

/// Time at which room + speed t + acceleration t²/2 falls to 0.
double time_to(double room, double speed, double acceleration) {
  const double root = std::sqrt(speed * speed - 2.0 * acceleration * room);
  return 2.0 * room / (-speed + root);
}

}  // namespace

int main() {
  const PreparedSystem system(gearbox());
  const Trajectory motion = shift(system, -0.0167, 0.003);
  std::printf("event        time, ms   axial, mm  sideways, mm  impulse, N s\n");
  for (const Event& event : motion.events()) {
    const auto& transition = system.system().modes[event.mode].transitions[event.transition];
    std::printf("%-11s  %9.6f  %9.6f  %12.6f  %12.6f\n", transition.name.c_str(), 1e3 * event.time,
                1e3 * event.after(axial), 1e3 * event.after(sideways), event.after(impulse));
  }

  // The first flight is a parabola.
  const double slope = std::tan(half_angle);
  const double upper =
      time_to(slope * 0.0167 - 0.003, 0.0, -slope * axial_acceleration - turning_acceleration);
  std::printf("first impact in closed form: %.6f ms\n\n", 1e3 * upper);

  std::printf("starts  meshed after       impulse              impacts  not within 0.2 s\n");
  print_box(system, "GRBX01", {-0.0168, -0.0166}, {0.0029, 0.0031});
  print_box(system, "GRBX02", {-0.01675, -0.01665}, {0.00285, 0.00315});
}
