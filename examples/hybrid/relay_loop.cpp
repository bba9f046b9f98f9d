// A relay that drives 9/(s(s+1)(s+9)) by the sign of the error: the exact limit cycle beside what
// the describing function predicts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "hybrid/periodic_orbit.hpp"

using namespace gearlash::hybrid;

namespace {

enum RelayMode : std::size_t { forward, backward };

/// y‴ + 10y″ + 9y′ = 9u, u the sign of −y.
HybridSystem relay_loop() {
  const Matrix plant{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -9.0, -10.0}};
  const AffineForm output{.normal = Vector{{1.0, 0.0, 0.0}}};
  const AffineForm output_speed{.normal = Vector{{0.0, 1.0, 0.0}}};
  // The output's extremes come between switchings. A guard on its speed that changes nothing, of
  // either direction, makes events of them, as exact as any other.
  const auto turning_in = [&](RelayMode mode) {
    return Transition{.name = "output turns",
                      .guard = output_speed,
                      .direction = Direction::either,
                      .target = mode};
  };
  const AffineMode pushes_forward{
      .name = "forward",
      .flow = {plant, Vector{{0.0, 0.0, 9.0}}},
      .transitions = {
          {.name = "switch", .guard = output, .direction = Direction::rising, .target = backward},
          turning_in(forward)}};
  const AffineMode pushes_backward{
      .name = "backward",
      .flow = {plant, Vector{{0.0, 0.0, -9.0}}},
      .transitions = {
          {.name = "switch", .guard = output, .direction = Direction::falling, .target = forward},
          turning_in(backward)}};
  return {.state_names = {"output", "output speed", "output acceleration"},
          .modes = {pushes_forward, pushes_backward}};
}

double amplitude_of(const PeriodicOrbit& orbit) {
  double amplitude = 0.0;
  for (const Event& event : orbit.events) {
    amplitude = std::max(amplitude, std::abs(event.before[0]));
  }
  return amplitude;
}

}  // namespace

int main() {
  const HybridSystem system = relay_loop();
  const State start{backward, Vector{{0.5, 0.0, 0.0}}};
  const Trajectory motion = simulate(system, start, {.until = 20.0});
  const auto orbit = closing_orbit(system, motion);
  if (!orbit) {
    std::printf("no limit cycle found\n");
    return 1;
  }

  // The plant lags by half a turn where ω² = 9, and passes 9/|jω(jω+1)(jω+9)| = 1/10 there of the
  // relay's first harmonic, 4/π.
  constexpr double frequency = 3.0;
  constexpr double amplitude = 0.4 / std::numbers::pi;
  constexpr double turn = 2.0 * std::numbers::pi;
  std::printf("                  exact        describing function\n");
  std::printf("period, s         %.9f  %.9f\n", orbit->period, turn / frequency);
  std::printf("frequency, rad/s  %.9f  %.9f\n", turn / orbit->period, frequency);
  std::printf("amplitude         %.9f  %.9f\n", amplitude_of(*orbit), amplitude);
  std::printf("multiplier        %.9f  –\n", std::abs(orbit->multipliers.front()));
  std::printf("\nThe cycle is %s, and closes to %s.\n", orbit->is_stable() ? "stable" : "unstable",
              orbit->residual < 1e-13 ? "less than 1e-13" : "no better than 1e-13");
}
