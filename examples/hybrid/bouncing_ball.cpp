// A ball that bounces to rest: infinitely many bounces in a finite time.
#include <cmath>
#include <cstdio>

#include "hybrid/hybrid_trajectory.hpp"

using namespace gearlash::hybrid;

namespace {

constexpr double gravity = 9.80665;     // m/s²
constexpr double restitution = 0.8;     // of the speed, at a bounce
constexpr double initial_height = 1.0;  // m

enum BallMode : std::size_t { flying, resting };

HybridSystem bouncing_ball() {
  const Transition bounce{
      .name = "bounce",
      .guard = {.normal = Vector{{1.0, 0.0}}},  // the height; fires as it falls below 0
      .direction = Direction::falling,
      .reset = {.matrix = Matrix{{1.0, 0.0}, {0.0, -restitution}}},
      .target = flying,
      // Without it the motion would end at the time that the bounces add up to.
      .settling = Settling{resting, {.matrix = Matrix::Zero(2, 2)}}};
  const AffineFlow fall{Matrix{{0.0, 1.0}, {0.0, 0.0}}, Vector{{0.0, -gravity}}};
  const AffineFlow stillness{Matrix::Zero(2, 2), Vector::Zero(2)};
  return {.state_names = {"height", "speed"},
          .modes = {{.name = "flying", .flow = fall, .transitions = {bounce}},
                    {.name = "resting", .flow = stillness}}};
}

}  // namespace

int main() {
  const HybridSystem system = bouncing_ball();
  const State start{flying, Vector{{initial_height, 0.0}}};
  const Trajectory motion = simulate(system, start, {.until = 10.0});

  std::printf("bounce  time, s       speed after it, m/s\n");
  for (std::size_t i = 0; i < 5; ++i) {
    const Event& bounce = motion.events()[i];
    std::printf("%6zu  %-12.9f  %.9f\n", i + 1, bounce.time, bounce.after[1]);
  }

  // Each flight takes `restitution` times as long as the one before: a geometric series.
  const double first = std::sqrt(2.0 * initial_height / gravity);
  const double sum = first * (1.0 + restitution) / (1.0 - restitution);
  const Event& last = motion.events().back();
  std::printf("\nall bounces are over at %.7f s (closed form %.7f s)\n", last.time, sum);
  std::printf("height at 2 s: %.9f m, at 10 s: %g m\n", motion.at(2.0).numbers[0],
              motion.end().numbers[0]);
}
