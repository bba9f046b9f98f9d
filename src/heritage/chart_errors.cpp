#include "gearlash/heritage/chart_errors.hpp"

#include "gearlash/cycle/limit_cycle.hpp"

namespace gearlash::heritage {
namespace {

std::optional<double> exact_size(const NormalizedServo& servo) {
  for (const LimitCycle& cycle : analyse_limit_cycles(servo).cycles) {
    if (cycle.stable) return cycle.size;
  }
  return std::nullopt;
}

}  // namespace

std::vector<NormalizedServo> charted_servos() {
  constexpr double backlash = 0.3;
  constexpr int dampings = 6;
  std::vector<NormalizedServo> servos;
  for (const double friction_ratio : {0.04, 0.1, 0.2, 0.4, 0.6, 1.0}) {
    for (int tenth = 1; tenth <= dampings; ++tenth) {
      for (const double inertia_ratio : {1.0 / 9.0, 0.25, 1.0, 4.0, 9.0}) {
        const bool in_figure_2_or_3 = tenth == 1 || inertia_ratio == 1.0;
        if (friction_ratio == 0.04 && !in_figure_2_or_3) continue;
        servos.push_back({.damping = tenth / 10.0,
                          .inertia_ratio = inertia_ratio,
                          .friction_ratio = friction_ratio,
                          .backlash = backlash});
      }
    }
  }
  return servos;
}

std::vector<ChartError> chart_errors(
    const std::function<SettledCycle(const ProgramParameters&)>& size_of,
    const std::function<void(double share)>& done) {
  const std::vector<NormalizedServo> servos = charted_servos();
  std::vector<ChartError> errors;
  for (const NormalizedServo& servo : servos) {
    const SettledCycle cycle = size_of(program_parameters(servo));
    errors.push_back(
        {servo, cycle.hunts ? std::optional(cycle.size) : std::nullopt, exact_size(servo)});
    if (done) done(static_cast<double>(errors.size()) / static_cast<double>(servos.size()));
  }
  return errors;
}

}  // namespace gearlash::heritage
