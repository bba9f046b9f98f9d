#include "problems.hpp"

namespace gearlash::benchmarks {

std::vector<Problem> thesis_problems(double restitution) {
  std::vector<Problem> problems;
  for (const double damping : {0.1, 0.2}) {
    for (const double inertia_ratio : {0.25, 1.0, 2.0, 4.0}) {
      for (const double friction_ratio : {0.1, 0.25}) {
        const NormalizedServo servo{.damping = damping,
                                    .inertia_ratio = inertia_ratio,
                                    .friction_ratio = friction_ratio,
                                    .backlash = 0.3,
                                    .restitution = restitution};
        const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
        if (analysis.cycles.size() != 1) continue;
        const LimitCycle& cycle = analysis.cycles.front();
        if (cycle.stable && cycle.kind == CycleKind::symmetric && cycle.settles) {
          problems.push_back({servo, cycle});
        }
      }
    }
  }
  return problems;
}

}  // namespace gearlash::benchmarks
