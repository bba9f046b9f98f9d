// Properties of a distribution of tolerance.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/tolerance.hpp"

namespace gearlash {

/// Every fault of the ranges in gearlash/tolerance.hpp; its fields are named `field`.min and so on.
std::vector<Fault> faults(const Distribution& distribution, std::string_view field);

/// Precondition of the functions below: faults() is empty.

/// The value that a share u of all samples does not exceed; 0 < u < 1.
double quantile(const Distribution& distribution, double u);
double mean_of(const Distribution& distribution);
double standard_deviation_of(const Distribution& distribution);
/// The lowest and highest possible values; infinite where a normal is not truncated.
Bounds support_of(const Distribution& distribution);
/// The lowest and highest values ever drawn: the quantiles of 2⁻⁵³ and 1 − 2⁻⁵³. For a normal that
/// is not truncated they lie 8.2 standard deviations from its mean.
Bounds range_of_draws(const Distribution& distribution);
/// The support, with infinite ends replaced by the mean ± 3 standard deviations.
Bounds three_sigma_range_of(const Distribution& distribution);

/// "uniform from 0.9 to 1.1", "normal with mean 1 and standard deviation 0.1, at least 0.8", …
std::string text_of(const Distribution& distribution);

/// quantile() with everything that does not depend on u precomputed.
class QuantileFunction {
 public:
  explicit QuantileFunction(const Distribution& distribution);
  double operator()(double u) const;

 private:
  enum class Kind { linear, normal, lots };
  Kind kind_ = Kind::linear;
  Bounds support_;                  ///< infinite where a normal is not truncated
  double centre_ = 0.0;             ///< of a normal
  double scale_ = 0.0;              ///< of a normal
  Bounds share_{0.0, 1.0};          ///< of the untruncated normal below either end
  std::vector<double> values_;      ///< of lots, rising
  std::vector<double> cumulative_;  ///< of lots: share of samples up to each value
};

}  // namespace gearlash
