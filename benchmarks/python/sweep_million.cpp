// The call of C++ beside which gearlash.sweep is measured: a million servos, seconds by the clock,
// one line for each of the repetitions.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "gearlash/grid.hpp"

int main(int count, char** arguments) {
  using namespace gearlash;
  using Clock = std::chrono::steady_clock;
  const Grid grid{.drive = normal_form(0.19, 2.0, 0.1, 0.3),
                  .axes = {linear("servo.damping", 0.02, 0.9, 100),
                           logarithmic("servo.inertia_ratio", 0.05, 20.0, 100),
                           linear("servo.friction_ratio", 0.0, 1.0, 100)}};
  const int repetitions = count > 1 ? std::atoi(arguments[1]) : 1;
  for (int i = 0; i < repetitions; ++i) {
    const Clock::time_point begin = Clock::now();
    const Table table = evaluate(grid, {Quantity::amplitude, Quantity::frequency});
    const std::chrono::duration<double> taken = Clock::now() - begin;
    if (table.rows() != grid.size()) return 1;
    std::printf("%.9g\n", taken.count());
  }
  return 0;
}
