// What another project does first with Gearlash: the limit cycle of one servo.
#include <cmath>
#include <cstdio>
#include <gearlash/version.hpp>

#include "closed_form/limit_cycle.hpp"

int main() {
  const gearlash::LimitCycleAnalysis analysis = gearlash::analyse_limit_cycles({
      .damping = 0.19,
      .inertia_ratio = 2.0,
      .friction_ratio = 0.1,
      .backlash = 0.3,
  });
  if (analysis.cycles.size() != 1) {
    std::printf("found %zu limit cycles instead of one\n", analysis.cycles.size());
    return 1;
  }
  const double size = analysis.cycles.front().size;
  std::printf("Gearlash %s: %s, size %.9f\n", gearlash::version,
              gearlash::name_of(analysis.verdict), size);
  // The exact size to the nine digits that are printed of it.
  return std::abs(size - 0.241611108) < 0.5e-9 ? 0 : 1;
}
