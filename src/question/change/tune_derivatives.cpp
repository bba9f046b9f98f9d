#include "question/change/tune_derivatives.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/lists.hpp"
#include "gearlash/sensitivity.hpp"
#include "model/sound_drive.hpp"
#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/derivatives.hpp"
#include "question/change/orbit_derivatives.hpp"
#include "question/change/target.hpp"
#include "question/family/analysed_line.hpp"
#include "question/family/family.hpp"
#include "question/loop/linear_loop.hpp"

namespace gearlash {
namespace {

bool is_of_loop(Quantity quantity) { return info_of(quantity).scope == QuantityScope::loop; }

bool is_of_cycle(Quantity quantity) {
  constexpr std::array of_cycle = {Quantity::amplitude, Quantity::motor_amplitude, Quantity::period,
                                   Quantity::frequency, Quantity::growth_at_rest};
  return contains(of_cycle, quantity);
}

Answer with_loop(const Drive& drive) {
  Answer answer;
  if (const auto sound = SoundDrive::of(drive)) answer.loop = drive::loop_figures(sound->settled());
  return answer;
}

class UnitSlopes {
 public:
  UnitSlopes(const Drive& unit, const TuneTask& task) : unit_(unit), task_(task) {
    for (const Axis& axis : task.tuned) {
      const double value = present_value(axis, unit).value_or(0.0);
      const double low = axis.values.front();
      const double high = axis.values.back();
      values_.push_back(value);
      per_position_.push_back(axis.logarithmic ? value * std::log(high / low) : high - low);
      paths_.push_back(axis.path);
    }
  }

  std::optional<SlopedNumbers> all(Progress& progress) {
    if (contains(values_, 0.0)) return std::nullopt;
    if (!add_loop() || !add_motion(progress)) return std::nullopt;
    return std::move(numbers_);
  }

 private:
  Jacobian loop_jacobian(const std::vector<Quantity>& quantities) const {
    Jacobian jacobian = without_slopes(quantities, paths_, values_, with_loop(unit_));
    for (std::size_t axis = 0; axis < paths_.size(); ++axis) {
      const DriveAlong along = drives_along(task_.tuned[axis], unit_);
      set_slopes(jacobian, axis, [&](double value) { return with_loop(along(value)); },
                 {.unit = std::abs(values_[axis])});
    }
    return jacobian;
  }

  /// A number whose slopes along the axes are `factor` times those of a quantity; false where one
  /// is missing.
  bool add(std::vector<SlopedNumber>& to, double number, double factor, const Jacobian& of,
           std::size_t quantity) const {
    SlopedNumber sloped{.value = number, .slopes = {}};
    for (std::size_t axis = 0; axis < values_.size(); ++axis) {
      const std::optional<double> slope = of.slope(quantity, axis);
      if (!slope) return false;
      sloped.slopes.push_back(factor * *slope * per_position_[axis]);
    }
    to.push_back(std::move(sloped));
    return true;
  }

  bool add_limit(const Bounds& permitted, const Jacobian& of, std::size_t quantity) {
    const auto at = [&](double limit, double sign) {
      if (!std::isfinite(limit)) return true;
      const double factor = sign / (limit == 0.0 ? 1.0 : std::abs(limit));
      return add(numbers_.limited, factor * (*of.values[quantity] - limit), factor, of, quantity);
    };
    return at(permitted.high, 1.0) && at(permitted.low, -1.0);
  }

  bool add_loop() {
    std::vector<QuantityLimit> limits = task_.target.limits;
    std::erase_if(limits, [](const QuantityLimit& limit) { return !is_of_loop(limit.quantity); });
    const double margin = task_.least_phase_margin;
    limits.insert(limits.begin(), {Quantity::phase_margin,
                                   {margin > 0.0 ? margin : -Target::infinity, Target::infinity}});
    std::vector<Quantity> quantities = {Quantity::bandwidth};
    for (const QuantityLimit& limit : limits) quantities.push_back(limit.quantity);
    const Jacobian loop = loop_jacobian(quantities);
    const std::optional<double> bandwidth = loop.values[0];
    if (!bandwidth || !add(numbers_.sizes, -std::log(*bandwidth), -1.0 / *bandwidth, loop, 0)) {
      return false;
    }
    for (std::size_t i = 0; i < limits.size(); ++i) {
      if (!loop.values[i + 1] || !add_limit(limits[i].permitted, loop, i + 1)) return false;
    }
    return true;
  }

  bool add_motion(Progress& progress) {
    std::vector<QuantityLimit> limits =
        those_of(task_.target.limits,
                 [](const QuantityLimit& limit) { return is_of_cycle(limit.quantity); });
    if (asks_for_rest(task_.target)) {
      limits.push_back({Quantity::growth_at_rest, {-Target::infinity, 1.0}});
    }
    if (limits.empty()) return true;
    const std::optional<Jacobian> jacobian =
        jacobian_of(of_each(limits, &QuantityLimit::quantity), progress);
    if (!jacobian) return false;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const Bounds& permitted = limits[i].permitted;
      if (jacobian->values[i]) {
        if (!add_limit(permitted, *jacobian, i)) return false;
        continue;
      }
      if (permitted.low > 0.0) return false;  // it rests, which keeps every limit but this
      numbers_.limited.push_back({-1.0, std::vector<double>(values_.size(), 0.0)});
    }
    return true;
  }

  std::optional<Jacobian> jacobian_of(const std::vector<Quantity>& quantities,
                                      Progress& progress) const {
    const EnginesNeeded engines = engines_of(unit_);
    if (!engines.search) {
      if (engines.bounces && !task_.target.limits.empty()) return std::nullopt;
      const std::vector<std::string_view> paths(paths_.begin(), paths_.end());
      return derivatives(unit_, quantities, paths);
    }
    if (asks_for_rest(task_.target)) return std::nullopt;
    const Analysis analysis = analyse_in_full(unit_, wanted_for(task_.target), progress);
    const bool is_whole =
        analysis.answer.irregular.empty() && analysis.search && analysis.search->is_complete;
    if (!is_whole) return std::nullopt;
    return orbit_derivatives(unit_, analysis, quantities, paths_, progress);
  }

  const Drive& unit_;
  const TuneTask& task_;
  std::vector<std::string> paths_;
  std::vector<double> values_;
  std::vector<double> per_position_;  ///< of the values, from 0 to 1 along the axis
  SlopedNumbers numbers_;
};

}  // namespace

bool may_have_slopes(const TuneTask& task) {
  const std::vector<QuantityLimit>& limits = task.target.limits;
  return task.aim == Aim::bandwidth &&
         (!asks_for_rest(task.target) || !engines_of(task.series.nominal).search) &&
         !task.series.nominal.sampling && all_of(limits, [](const QuantityLimit& limit) {
           return is_of_loop(limit.quantity) || is_of_cycle(limit.quantity);
         });
}

std::optional<SlopedNumbers> slopes_of_unit(const Drive& unit, const TuneTask& task,
                                            Progress& progress) {
  if (!faults(unit).empty()) return std::nullopt;
  try {
    return UnitSlopes(unit, task).all(progress);
  } catch (const InvalidInput&) {
    return std::nullopt;  // a value does not enter the closed form
  }
}

}  // namespace gearlash
