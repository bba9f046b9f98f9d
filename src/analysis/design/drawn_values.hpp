// The values of the varied parameters at the points of a sampling.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "analysis/design/shifted_sobol.hpp"
#include "analysis/design/toleranced_drive.hpp"

namespace gearlash::detail {

class DrawnValues {
 public:
  /// `sets` independent sets of values at each point.
  DrawnValues(const TolerancedDrive& drive, const SamplePlan& sampling, std::size_t sets)
      : points_(drive.varied.size() * sets, sampling),
        of_replicate_(sampling.points),
        width_(drive.varied.size() * sets) {
    for (const ParameterTolerance& varied : drive.varied)
      quantiles_.emplace_back(varied.distribution);
  }

  /// The values sample by sample, from sample `first` on, numbered replicate by replicate; of each
  /// first the whole first set, then the next.
  std::vector<double> of(std::size_t first, std::size_t count) const {
    std::vector<double> values(count * width_);
    for (std::size_t done = 0; done < count;) {
      const std::size_t point = (first + done) % of_replicate_;
      const std::size_t part = std::min(count - done, of_replicate_ - point);
      points_.fill((first + done) / of_replicate_, point,
                   std::span(values).subspan(done * width_, part * width_));
      done += part;
    }
    std::size_t number = 0;
    for (double& value : values) {
      value = quantiles_[number](value);
      if (++number == quantiles_.size()) number = 0;
    }
    return values;
  }

 private:
  ShiftedSobol points_;
  std::size_t of_replicate_;
  std::size_t width_;
  std::vector<QuantileFunction> quantiles_;
};

}  // namespace gearlash::detail
