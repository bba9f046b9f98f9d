#include "analysis/design/drawn_cycles.hpp"

#include <limits>

#include "base/special_numbers.hpp"
#include "gearlash/parameter.hpp"

namespace gearlash::detail {
namespace {

void write_refused(DrawnCycles& cycles, std::size_t row) {
  cycles.verdict[row] = Verdict::undecided;
  cycles.amplitude_per_backlash[row] = not_a_number;
  cycles.growth_at_rest[row] = not_a_number;
  cycles.frequency[row] = not_a_number;
}

double known_amplitude(Verdict verdict, double amplitude) {
  if (verdict == Verdict::cannot_hunt) return 0.0;
  if (verdict == Verdict::grows_without_bound) return std::numeric_limits<double>::infinity();
  return amplitude;
}

double highest_restitution(const TolerancedDrive& drive) {
  for (const ParameterTolerance& varied : drive.varied) {
    if (varied.path == "contact.restitution") return drawn_range_of(varied.distribution).high;
  }
  return get(drive.nominal, "contact.restitution");
}

}  // namespace

Performance DrawnCycles::performance(std::size_t row) const {
  return {.verdict = verdict[row],
          .growth_at_rest = growth_at_rest[row],
          .amplitude = amplitude(row),
          .frequency = frequency[row]};
}

DrawnCycles solve(const TolerancedDrive& drive, std::size_t rows, std::span<const double> values,
                  VectorUnit unit) {
  const NormalizedServo stand_in{.damping = 1.0};  // where the values give no valid drive
  DrawnCycles cycles;
  cycles.backlash.resize(rows);
  std::vector<NormalizedServo> servos(rows);
  std::vector<double> natural_frequency(rows, 1.0);
  std::vector<std::size_t> refused;
  const std::size_t width = drive.varied.size();
  DrawnDrive drawn_drive(drive);
  for (std::size_t row = 0; row < rows; ++row) {
    const auto drawn = drawn_drive.per_backlash(values.subspan(row * width, width));
    if (!drawn) {
      servos[row] = stand_in;
      refused.push_back(row);
      continue;
    }
    servos[row] = drawn->drive.servo;
    natural_frequency[row] = drawn->drive.natural_frequency;
    cycles.backlash[row] = drawn->backlash;
  }
  std::vector<double> amplitude(rows);
  std::vector<double> period(rows);
  cycles.verdict.resize(rows);
  cycles.growth_at_rest.resize(rows);
  CycleColumns columns{.verdict = cycles.verdict};
  columns[Quantity::growth_at_rest] = cycles.growth_at_rest;
  columns[Quantity::amplitude] = amplitude;
  columns[Quantity::period] = period;
  find_limit_cycles(servos, columns, unit);
  cycles.amplitude_per_backlash.resize(rows);
  cycles.frequency.resize(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    cycles.amplitude_per_backlash[row] = known_amplitude(cycles.verdict[row], amplitude[row]);
    cycles.frequency[row] = natural_frequency[row] / period[row];
  }
  for (const std::size_t row : refused) write_refused(cycles, row);
  cycles.refused = refused.size();
  return cycles;
}

std::size_t drives_at_a_time(const TolerancedDrive& drive) {
  return highest_restitution(drive) > 0.0 ? 8 : 1024;
}

}  // namespace gearlash::detail
