// What can be said of a distribution of tolerance.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gearlash/tolerance.hpp"

namespace gearlash {

/// Every fault of the ranges in gearlash/tolerance.hpp, fields being `field`.min and so on.
std::vector<Fault> validate(const Distribution& distribution, std::string_view field);

/// The functions below: precondition: validate() is empty.

/// The value that a share u of all samples do not exceed; 0 < u < 1.
double quantile(const Distribution& distribution, double u);
double mean_of(const Distribution& distribution);
double standard_deviation_of(const Distribution& distribution);
/// The lowest and the highest possible value; infinite where a normal is not truncated.
Bounds support_of(const Distribution& distribution);
/// The lowest and the highest value that are ever drawn: quantiles of 2⁻⁵³ and 1 − 2⁻⁵³, which of a
/// normal that is not truncated are 8.2 standard deviations from its mean.
Bounds drawn_range_of(const Distribution& distribution);
/// The support, but where it is infinite the mean ± 3 standard deviations.
Bounds three_sigma_range_of(const Distribution& distribution);

/// "uniform from 0.9 to 1.1", "normal with mean 1 and standard deviation 0.1, at least 0.8", …
std::string text_of(const Distribution& distribution);

/// quantile() with what does not depend on u worked out once.
class QuantileFunction {
 public:
  explicit QuantileFunction(const Distribution& distribution);
  double operator()(double u) const;

 private:
  enum class Kind { linear, normal, lots };
  Kind kind_ = Kind::linear;
  Bounds support_;                  ///< infinite where a normal has no end
  double centre_ = 0.0;             ///< a normal's
  double scale_ = 0.0;              ///< a normal's
  Bounds share_{0.0, 1.0};          ///< of the untruncated normal below either end
  std::vector<double> values_;      ///< of lots, rising
  std::vector<double> cumulative_;  ///< of lots: share of pieces up to each value
};

}  // namespace gearlash
