#include "question/series/drawn_values.hpp"

#include <algorithm>
#include <span>

namespace gearlash::detail {

DrawnValues::DrawnValues(const TolerancedDrive& drive, const SamplePlan& sampling, std::size_t sets)
    : points_(drive.varied.size() * sets, sampling),
      of_replicate_(sampling.points),
      width_(drive.varied.size() * sets) {
  for (const ParameterTolerance& varied : drive.varied) {
    quantiles_.emplace_back(varied.distribution);
  }
}

std::vector<double> DrawnValues::of(std::size_t first, std::size_t count) const {
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

}  // namespace gearlash::detail
