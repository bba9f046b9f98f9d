#include "question/series/drawn_results.hpp"

#include "gearlash/analyse.hpp"
#include "question/series/drawn_cycles.hpp"

namespace gearlash::detail {
namespace {

double amplitude_in(const Answer& answer, Quantity amplitude) {
  if (answer.verdict == Verdict::grows_without_bound || answer.verdict == Verdict::runs_away) {
    return infinity;
  }
  return answer.value(amplitude).value_or(not_a_number);
}

}  // namespace

bool DrawnResult::hunts() const { return gearlash::hunts(verdict); }

DrawnAnswers::DrawnAnswers(const TolerancedDrive& drive, const Target& target, Quantity amplitude,
                           VectorUnit unit)
    : drive_(drive),
      target_(target),
      amplitude_(amplitude),
      unit_(unit),
      one_by_one_(is_searched(drive) || !is_of_boxes(target) || amplitude != Quantity::amplitude) {}

std::size_t DrawnAnswers::at_a_time() const { return one_by_one_ ? 1 : drives_at_a_time(drive_); }

DrawnResults DrawnAnswers::of(std::size_t rows, std::span<const double> values,
                              Progress& progress) const {
  if (!one_by_one_) return in_closed_form(rows, values);
  DrawnResults results;
  const std::size_t width = drive_.varied.size();
  for (std::size_t row = 0; row < rows; ++row) {
    results.push_back(searched(values.subspan(row * width, width), progress));
  }
  return results;
}

DrawnResults DrawnAnswers::in_closed_form(std::size_t rows, std::span<const double> values) const {
  DrawnResults results;
  Answer answer;
  for (const DrawnCycle& cycle : solve(drive_, rows, values, unit_)) {
    cycle.fill(answer);
    const bool is_quiet = cycle.verdict == Verdict::cannot_hunt;
    results.push_back({.growth_at_rest = cycle.growth_at_rest,
                       .amplitude = is_quiet ? 0.0 : cycle.amplitude_per_backlash * cycle.backlash,
                       .frequency = cycle.frequency,
                       .verdict = cycle.verdict,
                       .meets = is_met(target_, answer),
                       .refused = cycle.refused});
  }
  return results;
}

DrawnResult DrawnAnswers::searched(std::span<const double> values, Progress& progress) const {
  const Drive drive = searched_drive_with(drive_, values);
  if (!faults(drive).empty()) return {.refused = true};
  Wanted wanted = wanted_for(target_, drive_.nominal);
  wanted.borders = true;  // of each sample the amplitude counts
  const Answer answer = analyse(drive, wanted, progress);
  return {.growth_at_rest = answer.growth_at_rest.value_or(not_a_number),
          .amplitude = amplitude_in(answer, amplitude_),
          .frequency = answer.value(Quantity::frequency).value_or(not_a_number),
          .verdict = answer.verdict,
          .meets = is_met(target_, answer)};
}

}  // namespace gearlash::detail
