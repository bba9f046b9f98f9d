#include "question/series/sample_plan.hpp"

#include "base/range_check.hpp"

namespace gearlash {

SamplePlan sampling_of(std::size_t samples, const SamplePlan& like) {
  SamplePlan sampling = like;
  sampling.points = 1;
  while (sampling.samples() < samples && sampling.samples() <= SamplePlan::most_samples) {
    sampling.points *= 2;
  }
  return sampling;
}

std::vector<Fault> faults(const SamplePlan& sampling) {
  RangeCheck check("sampling.");
  if (sampling.points < 1) check.refuse("points", "0", "must be at least 1");
  if (sampling.replicates < 2) {
    check.refuse("replicates", std::to_string(sampling.replicates),
                 "must be at least 2: their scatter gives the error");
  }
  constexpr std::size_t most = SamplePlan::most_samples;
  if (sampling.replicates > 0 && sampling.points > most / sampling.replicates) {
    check.refuse("points", std::to_string(sampling.points),
                 "must give at most " + std::to_string(most) +
                     " samples with all replicates together: every sample is kept");
  }
  return check.faults();
}

}  // namespace gearlash
