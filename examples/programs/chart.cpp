// A chart is built once, and many servos are looked up in it.
#include <cmath>
#include <cstdio>
#include <gearlash/chart.hpp>

int main() {
  using namespace gearlash;
  const DesignChart chart({.drive = normal_form(0.1, 1.0, 0.5, 0.3),
                           .axes = {logarithmic("servo.inertia_ratio", 1.0 / 9.0, 9.0, 100),
                                    linear("servo.friction_ratio", 0.05, 0.95, 100)}},
                          Quantity::amplitude, {.tolerance = 1e-3});

  const ChartAnswer answer = chart.look_up({0.25, 0.2});  // inertia ratio, friction ratio
  std::printf("%s: amplitude %.6f rad, relative error at most %.1e, %s\n", name_of(answer.verdict),
              answer.value.value(), answer.error.value(), name_of(answer.source));

  const ChartAccuracy& accuracy = chart.accuracy();
  std::printf("%zu points checked: error at most %.1e; %.1f %% of the cells left to be solved\n",
              accuracy.checked_points, accuracy.largest_error, 100.0 * accuracy.solved_share);
  constexpr double exact = 0.791450654824;
  return std::abs(*answer.value / exact - 1.0) <= *answer.error ? 0 : 1;
}
