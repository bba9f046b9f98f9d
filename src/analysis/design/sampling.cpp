#include "analysis/design/sampling.hpp"

#include "base/range_check.hpp"

namespace gearlash {

SamplePlan sampling_of(std::size_t samples, const SamplePlan& like) {
  SamplePlan sampling = like;
  sampling.points = 1;
  while (sampling.samples() < samples && sampling.samples() <= most_samples) sampling.points *= 2;
  return sampling;
}

std::vector<Fault> validate(const SamplePlan& sampling) {
  RangeCheck check("sampling.");
  if (sampling.points < 1) check.refuse("points", "0", "must be at least 1");
  if (sampling.replicates < 2) {
    check.refuse("replicates", std::to_string(sampling.replicates),
                 "must be at least 2: their scatter gives the error");
  }
  if (sampling.replicates > 0 && sampling.points > most_samples / sampling.replicates) {
    check.refuse(
        "points", std::to_string(sampling.points),
        "must be at most " + std::to_string(most_samples) + " with all replicates together");
  }
  return check.faults();
}

}  // namespace gearlash
