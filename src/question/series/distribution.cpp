#include "question/series/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "base/lists.hpp"
#include "base/overloaded.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

constexpr double least_share = 0x1p-53;
constexpr double sigmas = 3.0;  // where an unbounded range is cut off

/// Avoids long double, which costs ten times as much and adds nothing to a tolerance.
using NormalLaw = boost::math::normal_distribution<
    double, boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

class DistributionCheck {
 public:
  explicit DistributionCheck(std::string_view field)
      : field_(field), check_(std::string(field) + ".") {}

  void operator()(const ExactValue& exact) { check_.finite("value", exact.value); }
  void operator()(const UniformBetween& uniform) {
    check_.finite("min", uniform.min);
    check_.finite("max", uniform.max);
    require_order(uniform.min, uniform.max);
  }
  void operator()(const UniformAbout& uniform) {
    check_.finite("nominal", uniform.nominal);
    check_.not_negative("tolerance", uniform.tolerance, "");
  }
  void operator()(const Normal& normal) {
    check_.finite("mean", normal.mean);
    check_.positive("standard_deviation", normal.standard_deviation, "");
    if (normal.min) check_.finite("min", *normal.min);
    if (normal.max) check_.finite("max", *normal.max);
    if (!check_.faults().empty()) return;
    const double reach = sigmas * normal.standard_deviation;
    if (normal.min && *normal.min >= normal.mean + reach) {
      check_.refuse("min", exact_text(*normal.min),
                    "must be below mean + 3 standard deviations, " +
                        exact_text(normal.mean + reach) + ": almost no samples remain");
    }
    if (normal.max && *normal.max <= normal.mean - reach) {
      check_.refuse("max", exact_text(*normal.max),
                    "must be above mean - 3 standard deviations, " +
                        exact_text(normal.mean - reach) + ": almost no samples remain");
    }
    if (normal.min && normal.max && *normal.min >= *normal.max) {
      check_.refuse("max", exact_text(*normal.max),
                    "must be above min, " + exact_text(*normal.min));
    }
  }
  void operator()(const DiscreteLots& discrete) {
    if (discrete.lots.empty())
      check_.refuse("lots", "", "must be at least one value with a weight");
    for (std::size_t i = 0; i < discrete.lots.size(); ++i) {
      const std::string lot = "lots[" + std::to_string(i) + "].";
      check_.finite(lot + "value", discrete.lots[i].value);
      check_.positive(lot + "weight", discrete.lots[i].weight, "");
    }
  }

  std::vector<Fault> faults() const { return check_.faults(); }

 private:
  void require_order(double min, double max) {
    if (min > max) {
      check_.refuse("max", exact_text(max),
                    "must be at least min, " + exact_text(min) + " in SI units");
    }
  }

  std::string field_;
  RangeCheck check_;
};

double sum_of_weights(const DiscreteLots& discrete) {
  double sum = 0.0;
  for (const Lot& lot : discrete.lots) sum += lot.weight;
  return sum;
}

/// Mean and variance of a truncated normal, relative to its mean and in its standard deviations.
struct StandardMoments {
  double mean = 0.0;
  double variance = 1.0;
};

StandardMoments moments_between(const Bounds& ends) {
  using boost::math::quadrature::gauss;
  if (ends.high - ends.low < 1.0) {  // the closed form would cancel
    const double half = 0.5 * (ends.high - ends.low);
    const double middle = ends.low + half;
    const auto moment = [&](double origin, int power) {
      return gauss<double, 20>::integrate(
          [&](double x) {
            const double from_middle = half * x;
            return std::pow(from_middle - origin, power) *
                   std::exp(-from_middle * (middle + 0.5 * from_middle));
          },
          -1.0, 1.0);
    };
    const double all = moment(0.0, 0);
    const double mean = moment(0.0, 1) / all;
    return {middle + mean, moment(mean, 2) / all};
  }
  const NormalLaw standard;
  const auto density = [&](double x) { return std::isinf(x) ? 0.0 : pdf(standard, x); };
  const auto weighted = [&](double x) { return std::isinf(x) ? 0.0 : x * pdf(standard, x); };
  const auto below = [&](double x) {
    return std::isinf(x) ? (x < 0.0 ? 0.0 : 1.0) : cdf(standard, x);
  };
  const double share = below(ends.high) - below(ends.low);
  const double mean = (density(ends.low) - density(ends.high)) / share;
  return {mean, 1.0 + (weighted(ends.low) - weighted(ends.high)) / share - mean * mean};
}

StandardMoments moments_of(const Normal& normal) {
  const Bounds ends = support_of(normal);
  return moments_between({(ends.low - normal.mean) / normal.standard_deviation,
                          (ends.high - normal.mean) / normal.standard_deviation});
}

double spread_of(const DiscreteLots& discrete) {
  const double mean = mean_of(discrete);
  double sum = 0.0;
  for (const Lot& lot : discrete.lots) sum += lot.weight * (lot.value - mean) * (lot.value - mean);
  return std::sqrt(sum / sum_of_weights(discrete));
}

std::string text_of_normal(const Normal& normal) {
  std::string text = "normal with mean " + exact_text(normal.mean) + " and standard deviation " +
                     exact_text(normal.standard_deviation);
  if (normal.min) text += ", at least " + exact_text(*normal.min);
  if (normal.max) text += ", at most " + exact_text(*normal.max);
  return text;
}

std::string text_of_lots(const DiscreteLots& discrete) {
  std::string text = "lots of";
  for (const Lot& lot : discrete.lots) {
    text += (&lot == &discrete.lots.front() ? " " : ", ") + exact_text(lot.value) + " (weight " +
            exact_text(lot.weight) + ")";
  }
  return text;
}

}  // namespace

std::vector<Fault> faults(const Distribution& distribution, std::string_view field) {
  DistributionCheck check(field);
  std::visit(check, distribution);
  return check.faults();
}

double quantile(const Distribution& distribution, double u) {
  return QuantileFunction(distribution)(u);
}

double mean_of(const Distribution& distribution) {
  return std::visit(
      Overloaded{[](const ExactValue& exact) { return exact.value; },
                 [](const UniformBetween& uniform) { return 0.5 * (uniform.min + uniform.max); },
                 [](const UniformAbout& uniform) { return uniform.nominal; },
                 [](const Normal& normal) {
                   return normal.mean + normal.standard_deviation * moments_of(normal).mean;
                 },
                 [](const DiscreteLots& discrete) {
                   double sum = 0.0;
                   for (const Lot& lot : discrete.lots) sum += lot.weight * lot.value;
                   return sum / sum_of_weights(discrete);
                 }},
      distribution);
}

double standard_deviation_of(const Distribution& distribution) {
  return std::visit(
      Overloaded{[](const ExactValue&) { return 0.0; },
                 [](const UniformBetween& uniform) {
                   return (uniform.max - uniform.min) / std::sqrt(12.0);
                 },
                 [](const UniformAbout& uniform) { return uniform.tolerance / std::sqrt(3.0); },
                 [](const Normal& normal) {
                   return normal.standard_deviation * std::sqrt(moments_of(normal).variance);
                 },
                 [](const DiscreteLots& discrete) { return spread_of(discrete); }},
      distribution);
}

Bounds support_of(const Distribution& distribution) {
  return std::visit(
      Overloaded{
          [](const ExactValue& exact) {
            return Bounds{exact.value, exact.value};
          },
          [](const UniformBetween& uniform) {
            return Bounds{uniform.min, uniform.max};
          },
          [](const UniformAbout& uniform) {
            return Bounds{uniform.nominal - uniform.tolerance, uniform.nominal + uniform.tolerance};
          },
          [](const Normal& normal) {
            return Bounds{normal.min.value_or(-infinity), normal.max.value_or(infinity)};
          },
          [](const DiscreteLots& discrete) {
            Bounds support{infinity, -infinity};
            for (const Lot& lot : discrete.lots) {
              support.low = std::min(support.low, lot.value);
              support.high = std::max(support.high, lot.value);
            }
            return support;
          }},
      distribution);
}

Bounds range_of_draws(const Distribution& distribution) {
  const QuantileFunction value_at(distribution);
  return {value_at(least_share), value_at(1.0 - least_share)};
}

Bounds three_sigma_range_of(const Distribution& distribution) {
  Bounds range = support_of(distribution);
  if (const Normal* normal = std::get_if<Normal>(&distribution)) {
    const double reach = sigmas * normal->standard_deviation;
    if (!normal->min) range.low = normal->mean - reach;
    if (!normal->max) range.high = normal->mean + reach;
  }
  return range;
}

std::string text_of(const Distribution& distribution) {
  return std::visit(Overloaded{[](const ExactValue& exact) { return exact_text(exact.value); },
                               [](const UniformBetween& uniform) {
                                 return "uniform from " + exact_text(uniform.min) + " to " +
                                        exact_text(uniform.max);
                               },
                               [](const UniformAbout& uniform) {
                                 return exact_text(uniform.nominal) + " +- " +
                                        exact_text(uniform.tolerance);
                               },
                               [](const Normal& normal) { return text_of_normal(normal); },
                               [](const DiscreteLots& discrete) { return text_of_lots(discrete); }},
                    distribution);
}

QuantileFunction::QuantileFunction(const Distribution& distribution)
    : support_(support_of(distribution)) {
  if (const Normal* normal = std::get_if<Normal>(&distribution)) {
    kind_ = Kind::normal;
    centre_ = normal->mean;
    scale_ = normal->standard_deviation;
    const NormalLaw law(centre_, scale_);
    if (normal->min) share_.low = cdf(law, *normal->min);
    if (normal->max) share_.high = cdf(law, *normal->max);
  } else if (const DiscreteLots* discrete = std::get_if<DiscreteLots>(&distribution)) {
    kind_ = Kind::lots;
    std::vector<Lot> lots = discrete->lots;
    sort_by(lots, &Lot::value);
    const double all = sum_of_weights(*discrete);
    double sum = 0.0;
    for (const Lot& lot : lots) {
      sum += lot.weight;
      values_.push_back(lot.value);
      cumulative_.push_back(sum / all);
    }
  }
}

double QuantileFunction::operator()(double u) const {
  if (kind_ == Kind::linear) {
    return std::clamp(support_.low + u * (support_.high - support_.low), support_.low,
                      support_.high);
  }
  if (kind_ == Kind::normal) {
    const double share = share_.low + u * (share_.high - share_.low);
    const double within = std::clamp(share, least_share, 1.0 - least_share);
    return std::clamp(quantile(NormalLaw(centre_, scale_), within), support_.low, support_.high);
  }
  const auto lot = std::lower_bound(cumulative_.begin(), cumulative_.end() - 1, u);
  return values_[static_cast<std::size_t>(lot - cumulative_.begin())];
}

}  // namespace gearlash
