// A project that works many servos out through the installed component chart.
#include <cstdio>
#include <vector>

#include "analysis/grid/servo_grid.hpp"

int main() {
  const gearlash::ServoGrid grid{
      .servo = {.damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1},
      .axes = {gearlash::spaced_axis("backlash", gearlash::Input::backlash, 0.1, 0.3, 3,
                                     gearlash::Spacing::linear)}};
  std::vector<gearlash::Verdict> verdicts(grid.size());
  std::vector<std::vector<double>> columns(12, std::vector<double>(grid.size()));
  gearlash::evaluate(
      grid, 0, grid.size(),
      {verdicts, columns[0], columns[1], columns[2], columns[3], columns[4], columns[5], columns[6],
       columns[7], columns[8], columns[9], columns[10], columns[11]});
  const double size = columns[1].back();
  std::printf("%zu servos, the last of size %.9f\n", grid.size(), size);
  return size > 0.241611 && size < 0.241612 ? 0 : 1;
}
