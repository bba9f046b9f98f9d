// The engine by itself: an oscillator whose stop throws it back, with no gear in sight.
#include <cmath>
#include <cstdio>

#include "hybrid/hybrid_trajectory.hpp"

using namespace gearlash::hybrid;

int main() {
  const HybridSystem system{
      .state_names = {"position", "speed"},
      .modes = {{.name = "free",
                 .flow = {Matrix{{0.0, 1.0}, {-1.0, 0.0}}, Vector::Zero(2)},
                 .transitions = {{.name = "stop",
                                  .guard = {.normal = Vector{{1.0, 0.0}}, .offset = -0.5},
                                  .direction = Direction::rising,
                                  .reset = {.matrix = Matrix{{1.0, 0.0}, {0.0, -1.0}}}}}}}};
  const Trajectory motion = simulate(system, {0, Vector{{0.0, 1.0}}}, {.until = 1.0});
  if (motion.events().size() != 1) {
    std::printf("found %zu events instead of one\n", motion.events().size());
    return 1;
  }
  const double time = motion.events().front().time;
  std::printf("meets the stop at %.9f\n", time);
  return std::abs(time - std::asin(0.5)) < 1e-15 ? 0 : 1;
}
