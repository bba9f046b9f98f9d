// An optimiser: the largest gain that leaves 5 % to hunting, for each of several gear ratios.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gearlash/gearlash.hpp>

using namespace gearlash;

/// By Newton's method in the logarithms, with exact derivatives.
double largest_gain(Drive& drive) {
  for (int step = 0; step < 60; ++step) {
    const Jacobian at = derivatives(drive, {Quantity::growth_at_rest}, {"controller.proportional"});
    const double missing = std::log(0.95 / at.values[0].value()) / at.elasticity(0, 0).value();
    const double gain = get(drive, "controller.proportional");
    if (std::abs(missing) < 1e-10) return gain;
    set(drive, "controller.proportional", gain * std::exp(std::clamp(missing, -1.0, 1.0)));
  }
  return std::nan("");
}

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return std::puts("usage: optimise DRIVE.toml"), 2;
  Drive drive = read_drive(arguments[1]);
  for (const double ratio : {5.0, 10.0, 20.0, 40.0}) {
    set(drive, "gearbox.ratio", ratio);
    std::printf("ratio %4.1f: gain %.6g\n", ratio, largest_gain(drive));
  }
}
