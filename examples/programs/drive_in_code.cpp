// A drive built in code: what it ends in, and its motion sampled at 1 kHz.
#include <cstdio>
#include <gearlash/gearlash.hpp>
#include <iostream>
#include <numbers>

int main() {
  using namespace gearlash;
  const Drive drive{.motor = {.inertia = 2e-4, .friction = {.viscous = 1e-4}},
                    .gearbox = {.ratio = 50.0, .backlash = 0.2 * std::numbers::pi / 180.0},
                    .load = {.inertia = 0.02, .friction = {.viscous = 0.01}},
                    .controller = {.law = PID{.terms = PIDTerms::PD,
                                              .proportional = 25.0,
                                              .derivative = 1.0,
                                              .filter = 5e-3},
                                   .shaft = GainShaft::load},
                    .reference = StepSignal{.after = 0.1}};
  const Motion motion = simulate(drive, {.until = 3.0});
  const Samples samples = motion.sampled(1e-3);
  std::printf("%zu samples, %zu events; final motor %.4f, load %.4f rad\n", samples.time.size(),
              motion.events().size(), samples.motor_position.back(), samples.load_position.back());
  std::cout << analyse(drive) << '\n';
}
