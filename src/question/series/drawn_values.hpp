// The values of the varied parameters at the points of a sampling.
#pragma once

#include <cstddef>
#include <vector>

#include "question/series/shifted_sobol.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash::detail {

class DrawnValues {
 public:
  /// `sets` independent sets of values at each point.
  DrawnValues(const TolerancedDrive& drive, const SamplePlan& sampling, std::size_t sets);

  /// The values sample by sample, from sample `first` on, numbered replicate by replicate; of each
  /// first the whole first set, then the next.
  std::vector<double> of(std::size_t first, std::size_t count) const;

 private:
  ShiftedSobol points_;
  std::size_t of_replicate_;
  std::size_t width_;
  std::vector<QuantileFunction> quantiles_;
};

}  // namespace gearlash::detail
