// The values of the varied parameters at the points of a sampling.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/design/replicates.hpp"
#include "analysis/design/shifted_sobol.hpp"
#include "analysis/design/toleranced_drive.hpp"

namespace gearlash::detail {

class DrawnValues {
 public:
  /// `sets` independent sets of values at each point.
  DrawnValues(const TolerancedDrive& drive, const SamplePlan& sampling, std::size_t sets)
      : points_(drive.varied.size() * sets, sampling), width_(drive.varied.size() * sets) {
    for (const ParameterTolerance& varied : drive.varied)
      quantiles_.emplace_back(varied.distribution);
  }

  /// The values point by point; at each point first the whole first set, then the next.
  std::vector<double> of(const SampleBlock& block) const {
    std::vector<double> values(block.count * width_);
    points_.fill(block.replicate, block.first, values);
    std::size_t number = 0;
    for (double& value : values) {
      value = quantiles_[number](value);
      if (++number == quantiles_.size()) number = 0;
    }
    return values;
  }

 private:
  ShiftedSobol points_;
  std::size_t width_;
  std::vector<QuantileFunction> quantiles_;
};

}  // namespace gearlash::detail
