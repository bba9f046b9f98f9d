#include "analysis/design/drawn_results.hpp"

#include "analysis/design/drawn_cycles.hpp"
#include "gearlash/analyse.hpp"

namespace gearlash::detail {
namespace {

double amplitude_in(const Answer& answer, Quantity amplitude) {
  if (answer.verdict == Verdict::grows_without_bound || answer.verdict == Verdict::runs_away) {
    return infinity;
  }
  return answer.value(amplitude).value_or(not_a_number);
}

}  // namespace

bool DrawnResults::hunts(std::size_t row) const { return gearlash::hunts(verdict(row)); }

DrawnAnswers::DrawnAnswers(const TolerancedDrive& drive, const Target& target, Quantity amplitude,
                           VectorUnit unit)
    : drive_(drive),
      target_(target),
      amplitude_(amplitude),
      unit_(unit),
      one_by_one_(is_searched(drive) || !is_of_performance(target) ||
                  amplitude != Quantity::amplitude) {}

std::size_t DrawnAnswers::at_a_time() const { return one_by_one_ ? 1 : drives_at_a_time(drive_); }

DrawnResults DrawnAnswers::of(std::size_t rows, std::span<const double> values,
                              Progress& progress) const {
  return one_by_one_ ? one_by_one(rows, values, progress) : in_closed_form(rows, values);
}

DrawnResults DrawnAnswers::in_closed_form(std::size_t rows, std::span<const double> values) const {
  const DrawnCycles cycles = solve(drive_, rows, values, unit_);
  DrawnResults results{.refused = cycles.refused};
  for (std::size_t row = 0; row < rows; ++row) {
    results.performance.push_back(cycles.performance(row));
    results.meets.push_back(is_met(target_, results.performance.back()));
  }
  return results;
}

DrawnResults DrawnAnswers::one_by_one(std::size_t rows, std::span<const double> values,
                                      Progress& progress) const {
  DrawnResults results;
  const std::size_t width = drive_.varied.size();
  Wanted wanted = wanted_for(target_, drive_.nominal);
  wanted.borders = true;  // of each sample the amplitude counts
  for (std::size_t row = 0; row < rows; ++row) {
    const Drive drive = searched_drive_with(drive_, values.subspan(row * width, width));
    const bool is_sound = faults(drive).empty();
    const Answer answer = is_sound ? analyse(drive, wanted, progress) : Answer{};
    results.refused += is_sound ? 0 : 1;
    results.performance.push_back(
        {.verdict = answer.verdict,
         .growth_at_rest = answer.growth_at_rest.value_or(not_a_number),
         .amplitude = amplitude_in(answer, amplitude_),
         .frequency = answer.value(Quantity::frequency).value_or(not_a_number)});
    results.meets.push_back(is_sound && is_met(target_, answer));
  }
  return results;
}

}  // namespace gearlash::detail
