// A project that works out a sweep through the installed package.
#include <cstdio>
#include <gearlash/grid.hpp>

int main() {
  using namespace gearlash;
  const Grid grid{.drive = normal_form(0.19, 2.0, 0.1),
                  .axes = {linear("servo.backlash", 0.1, 0.3, 3)}};
  const Table table = evaluate(grid, {Quantity::amplitude});
  const double amplitude = table[Quantity::amplitude].back();
  std::printf("%zu servos, the last of amplitude %.9f\n", table.rows(), amplitude);
  return amplitude > 0.241611 && amplitude < 0.241612 ? 0 : 1;
}
