// What a number of a data sheet may be, piece by piece of a production run.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/fault.hpp"
#include "closed_form/cycle_bounds.hpp"

namespace gearlash {

/// The same in every piece.
struct ExactValue {
  double value = 0.0;

  bool operator==(const ExactValue&) const = default;
};

/// Every value from `min` to `max` is as likely.
struct UniformBetween {
  double min = 0.0;
  double max = 0.0;

  bool operator==(const UniformBetween&) const = default;
};

/// Likewise, from nominal − tolerance to nominal + tolerance; the tolerance is absolute, ≥ 0.
struct UniformAbout {
  double nominal = 0.0;
  double tolerance = 0.0;

  bool operator==(const UniformAbout&) const = default;
};

/// "± 10 %" is a share of 0.1.
inline UniformAbout within_share(double nominal, double share) {
  return {nominal, share * nominal};
}

/// Gauss's, density ∝ exp(−(x − mean)²/(2 standard_deviation²)), of which pieces below `min` or
/// above `max` are sorted out where those are given; mean and standard deviation are those before
/// the sorting. standard_deviation > 0, min < max, min < mean + 3 standard deviations and max >
/// mean − 3 standard deviations.
struct Normal {
  double mean = 0.0;
  double standard_deviation = 1.0;
  std::optional<double> min = {};
  std::optional<double> max = {};

  bool operator==(const Normal&) const = default;
};

struct Lot {
  double value = 0.0;
  double weight = 1.0;  ///< > 0; only ratios of weights matter

  bool operator==(const Lot&) const = default;
};

/// One of several values, each as likely as its weight says: lots of several makers, gear wheels of
/// several ratios. At least one lot.
struct DiscreteLots {
  std::vector<Lot> lots;

  bool operator==(const DiscreteLots&) const = default;
};

using Distribution = std::variant<ExactValue, UniformBetween, UniformAbout, Normal, DiscreteLots>;

/// Every fault of the ranges above, fields being `field`.min and so on.
std::vector<Fault> validate(const Distribution& distribution, std::string_view field);

/// The functions below: precondition: validate() is empty.

/// The value that a share u of all pieces do not exceed; 0 < u < 1.
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
