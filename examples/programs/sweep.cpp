// A sweep: which inertia ratio hunts least, for each damping.
#include <cstdio>
#include <gearlash/grid.hpp>

int main() {
  using namespace gearlash;
  const Grid grid{.drive = normal_form(0.2, 1.0, 0.2),
                  .axes = {linear("servo.damping", 0.05, 0.5, 10),
                           logarithmic("servo.inertia_ratio", 0.1, 10.0, 400)}};
  const Table table = evaluate(grid, {Quantity::amplitude});  // 0 where it cannot hunt
  for (std::size_t i = 0; i < grid.axes[0].values.size(); ++i) {
    const std::size_t best = table.smallest(Quantity::amplitude, i);
    std::printf("damping %.2f: least at J_L/J_M %.4g, %.4g backlashes\n", grid.axes[0].values[i],
                grid.axes[1].values[best], table.line(Quantity::amplitude, i)[best]);
  }
}
