// A wheel of spokes without a rim, rolling down a slope: the speed that it settles to.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "hybrid/periodic_orbit.hpp"

using namespace gearlash::hybrid;

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double half_angle = 15.0 * degree;  // half of what is between two spokes: there are 12
constexpr double slope = 3.0 * degree;

/// The spoke on the ground is an inverted pendulum, for small angles θ″ = θ: θ from the vertical
/// downhill, time in √(length/gravity). As the next spoke meets the ground it takes over.
HybridSystem rimless_wheel() {
  // Momentum about the new foot is kept; the rest is lost in the impact.
  const double speed_kept = std::cos(2.0 * half_angle);
  const Matrix impact{{1.0, 0.0}, {0.0, speed_kept}};
  const AffineForm angle_past_next{Vector{{1.0, 0.0}}, -(slope + half_angle)};
  const AffineForm angle_past_previous{Vector{{1.0, 0.0}}, -(slope - half_angle)};
  const Transition rolls_on{.name = "next spoke lands",
                            .guard = angle_past_next,
                            .direction = Direction::rising,
                            .reset = {impact, Vector{{-2.0 * half_angle, 0.0}}}};
  const Transition rolls_back{.name = "previous spoke lands",
                              .guard = angle_past_previous,
                              .direction = Direction::falling,
                              .reset = {impact, Vector{{2.0 * half_angle, 0.0}}}};
  const AffineFlow pendulum{Matrix{{0.0, 1.0}, {1.0, 0.0}}, Vector::Zero(2)};
  return {
      .state_names = {"angle", "speed"},
      .modes = {{.name = "on one spoke", .flow = pendulum, .transitions = {rolls_on, rolls_back}}}};
}

}  // namespace

int main() {
  const HybridSystem system = rimless_wheel();
  const State start{0, Vector{{slope - half_angle, 0.6}}};
  const Trajectory motion = simulate(system, start, {.until = 40.0});
  const auto orbit = closing_orbit(system, motion);
  if (!orbit) {
    std::printf("the wheel does not roll on\n");
    return 1;
  }

  // v² − θ² is kept on a spoke, so that a step adds 4·slope·half_angle to v²; an impact leaves
  // cos²(2 half_angle) of v². Rolling steadily, both are in balance.
  const double kept = std::cos(2.0 * half_angle);
  const double before = std::sqrt(4.0 * slope * half_angle) / std::sin(2.0 * half_angle);
  const double after = kept * before;
  // θ + v grows as eᵗ.
  const double period = std::log((slope + half_angle + before) / (slope - half_angle + after));
  const Event& impact = orbit->events.front();
  std::printf("                      found        closed form\n");
  std::printf("time of a step        %.9f  %.9f\n", orbit->period, period);
  std::printf("speed before impact   %.9f  %.9f\n", impact.before[1], before);
  std::printf("speed after impact    %.9f  %.9f\n", impact.after[1], after);
  std::printf("multiplier of a step  %.9f  %.9f\n", orbit->multipliers[0].real(), kept * kept);

  // Pushed off too slowly it rocks between two spokes, ever faster, and comes to rest on both.
  const State slow{0, Vector{{slope - half_angle, 0.15}}};
  const Trajectory rocking = simulate(system, slow, {.until = 40.0});
  std::printf("\npushed off at 0.15 it rocks, and is at rest at %.6f\n", rocking.end_time());
}
