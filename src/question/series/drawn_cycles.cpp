#include "question/series/drawn_cycles.hpp"

#include <cmath>

#include "gearlash/parameter.hpp"

namespace gearlash::detail {
namespace {

double known_amplitude(Verdict verdict, double amplitude) {
  if (verdict == Verdict::cannot_hunt) return 0.0;
  return verdict == Verdict::grows_without_bound ? infinity : amplitude;
}

double highest_restitution(const TolerancedDrive& drive) {
  for (const ParameterTolerance& varied : drive.varied) {
    if (varied.path == "contact.restitution") return drawn_range_of(varied.distribution).high;
  }
  return get(drive.nominal, "contact.restitution");
}

}  // namespace

void DrawnCycle::fill(Answer& answer) const {
  answer.verdict = verdict;
  answer.growth_at_rest = known(growth_at_rest);
  answer.cycles.clear();
  answer.irregular.clear();
  const double amplitude = amplitude_per_backlash * backlash;
  if (!std::isfinite(amplitude) || verdict == Verdict::cannot_hunt) return;
  if (std::isnan(frequency)) {
    answer.irregular.push_back({.amplitude = amplitude});
  } else {
    answer.cycles.push_back({.amplitude = amplitude, .period = 1.0 / frequency});
  }
}

std::vector<DrawnCycle> solve(const TolerancedDrive& drive, std::size_t rows,
                              std::span<const double> values, VectorUnit unit) {
  std::vector<DrawnCycle> cycles(rows);
  // A stand-in where the values give no valid drive.
  std::vector<NormalizedServo> servos(rows, NormalizedServo{.damping = 1.0});
  std::vector<double> natural_frequency(rows, 1.0);
  const std::size_t width = drive.varied.size();
  DrawnDrive drawn_drive(drive);
  for (std::size_t row = 0; row < rows; ++row) {
    const auto drawn = drawn_drive.per_backlash(values.subspan(row * width, width));
    cycles[row].refused = !drawn;
    if (!drawn) continue;
    servos[row] = drawn->drive.servo;
    natural_frequency[row] = drawn->drive.natural_frequency;
    cycles[row].backlash = drawn->backlash;
  }
  std::vector<Verdict> verdict(rows);
  std::vector<double> growth_at_rest(rows);
  std::vector<double> amplitude(rows);
  std::vector<double> period(rows);
  CycleColumns columns{.verdict = verdict};
  columns[Quantity::growth_at_rest] = growth_at_rest;
  columns[Quantity::amplitude] = amplitude;
  columns[Quantity::period] = period;
  find_limit_cycles(servos, columns, unit);
  for (std::size_t row = 0; row < rows; ++row) {
    DrawnCycle& cycle = cycles[row];
    if (cycle.refused) continue;
    cycle.verdict = verdict[row];
    cycle.amplitude_per_backlash = known_amplitude(verdict[row], amplitude[row]);
    cycle.growth_at_rest = growth_at_rest[row];
    cycle.frequency = natural_frequency[row] / period[row];
  }
  return cycles;
}

std::size_t drives_at_a_time(const TolerancedDrive& drive) {
  return highest_restitution(drive) > 0.0 ? 8 : 1024;
}

}  // namespace gearlash::detail
