#include "question/change/value_scan.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "base/bracketed_root.hpp"
#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "question/analyse.hpp"

namespace gearlash {
namespace {

constexpr double least = 1e-300;

/// The middles of the intervals that tried_values() halves.
std::vector<double> middles_to_try(const std::vector<JudgedValue>& tried, bool everywhere) {
  const auto beyond = [&](std::size_t i) { return tried[i].beyond_limits; };
  const auto change = [&](std::size_t i) {
    return i + 1 < tried.size() ? std::abs(beyond(i + 1) - beyond(i)) : 0.0;
  };
  const auto is_near_limit = [&](std::size_t i) {
    const bool is_crossed = (beyond(i) > 0.0) != (beyond(i + 1) > 0.0);
    const double distance = std::min(std::abs(beyond(i)), std::abs(beyond(i + 1)));
    const double steepest = std::max({change(i), i > 0 ? change(i - 1) : 0.0, change(i + 1)});
    return !is_crossed && std::isfinite(distance) && steepest > distance;
  };
  const auto is_wanted = [&](std::size_t i) {
    if (is_near_limit(i) || tried[i].is_known != tried[i + 1].is_known) return true;
    return everywhere && tried[i].moves && tried[i + 1].moves;
  };
  std::vector<double> middles;
  for (std::size_t i = 0; i + 1 < tried.size(); ++i) {
    if (!is_wanted(i)) continue;
    const double low = tried[i].value;
    const double high = tried[i + 1].value;
    middles.push_back(low == 0.0 ? 0.5 * high : middle_value(low, high));
  }
  return middles;
}

}  // namespace

JudgedValue JudgedLine::judged(double value, const AnalysedLine::Known& analysis) const {
  if (!analysis) {
    const bool is_unsound = !faults(line_.drive()(value)).empty();
    return {.value = value,
            .is_known = is_unsound,
            .beyond = Target::infinity,
            .beyond_limits = is_unsound ? Target::infinity : 0.0};
  }
  const Answer& answer = analysis->answer;
  return {.value = value,
          .is_met = is_met(target_, answer),
          .is_known = is_known(target_, answer),
          .moves = !is_at_rest(answer.verdict),
          .beyond = excess(target_, answer),
          .beyond_limits = excess({.limits = target_.limits}, answer)};
}

bool is_in(const std::vector<Bounds>& intervals, double value) {
  return any_of(intervals, [&](const Bounds& interval) { return interval.contains(value); });
}

void add(std::vector<Bounds>& intervals, const Bounds& more) {
  if (!intervals.empty() && intervals.back().high >= more.low) {
    intervals.back().high = more.high;
  } else {
    intervals.push_back(more);
  }
}

double middle_value(double low, double high) {
  return low == 0.0 && high < least ? 0.5 * high : detail::middle_of(low, high);
}

std::vector<JudgedValue> judged_values(const Judge& judge, const std::vector<double>& values) {
  return of_each_on_threads(values, judge);
}

std::vector<JudgedValue> tried_between(std::vector<JudgedValue> tried, const Judge& judge,
                                       const ScanPlan& plan) {
  for (int i = 0; i < plan.most_halvings; ++i) {
    const bool met_unknown = any_of(tried, [](const auto& one) { return !one.is_known; });
    const bool everywhere = met_unknown && i < plan.halvings_everywhere;
    const std::vector<JudgedValue> between =
        judged_values(judge, middles_to_try(tried, everywhere));
    if (between.empty()) break;
    add_all(tried, between);
    sort_by(tried, &JudgedValue::value);
  }
  return tried;
}

std::vector<Part> parts_between(const std::vector<JudgedValue>& tried) {
  return of_neighbors(tried, [](const JudgedValue& low, const JudgedValue& high) {
    const Judgement alike = low.is_met ? Judgement::all : Judgement::none;
    return Part{{low.value, high.value},
                low.is_met == high.is_met ? alike : Judgement::some,
                !low.is_known || !high.is_known};
  });
}

double closest_of(const std::vector<JudgedValue>& tried) {
  return std::min_element(tried.begin(), tried.end(), by(&JudgedValue::beyond))->value;
}

LastMet last_met(const Judge& judge, double met, double unmet, const Resolution& resolution) {
  bool met_unknown = false;
  double met_by = 1.0;
  double missed_by = 1.0;
  const auto signed_excess = [&](double value) {
    const JudgedValue here = judge(value);
    met_unknown = met_unknown || !here.is_known;
    (here.is_met ? met : unmet) = value;
    // Only the sign decides; the magnitude speeds up the root finder.
    const double size = std::abs(here.beyond);
    const double usable = std::clamp(std::isnan(size) ? 1.0 : size, least, 1.0);
    (here.is_met ? met_by : missed_by) = usable;
    return here.is_met ? -usable : usable;
  };
  const auto is_close = [&](double low, double high) {
    constexpr double near = 1e-3;
    const bool is_smooth = met_by < near && missed_by < near;
    const double relative = is_smooth ? resolution.smooth : resolution.at_jump;
    return high - low <= std::max(relative * std::max(-low, high), resolution.least);
  };
  const double low = std::min(met, unmet);
  const double high = std::max(met, unmet);
  if (is_close(low, high)) return {met, unmet};
  // A drive that is followed may end in something else here than one that is not.
  const auto at_end = [&](double value, bool is_known_to_meet) {
    const std::pair before{met, unmet};
    const double found = signed_excess(value);
    std::tie(met, unmet) = before;
    return is_known_to_meet == (found < 0.0) ? found : -found;
  };
  const double at_low = at_end(low, low == met);
  const double at_high = at_end(high, high == met);
  std::uintmax_t most = 400;
  boost::math::tools::toms748_solve(signed_excess, low, high, at_low, at_high, is_close, most);
  return {met, unmet, met_unknown};
}

void put_together(const std::vector<Part>& parts, const std::function<bool(double)>& is_met_at,
                  const std::function<LastMet(double met, double unmet)>& last_met_between,
                  FeasibleValues& found) {
  struct Ends {
    bool low_met = false;
    bool high_met = false;
    LastMet last{};
  };
  const std::vector<Ends> ends = of_each_on_threads(parts, [&](const Part& part) {
    const auto& [low, high] = part.values;
    if (part.is_unknown || part.judgement != Judgement::some) return Ends{};
    const bool low_met = is_met_at(low);
    const bool high_met = is_met_at(high);
    if (low_met == high_met) return Ends{low_met, high_met, {}};
    return Ends{low_met, high_met,
                low_met ? last_met_between(low, high) : last_met_between(high, low)};
  });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    const Bounds& values = part.values;
    if (part.is_unknown) {
      add(found.undecided, values);
      continue;
    }
    if (part.judgement == Judgement::all) add(found.intervals, values);
    if (part.judgement != Judgement::some) continue;
    // The ends of a sliver belong to its neighbors, which are decided.
    const auto& [low_met, high_met, last] = ends[i];
    if (low_met == high_met) {
      if (values.low > 0.0) add(found.undecided, values);  // else it ends the range
      if (low_met) add(found.intervals, values);
    } else if (low_met) {
      add(found.intervals, {values.low, last.value});
      if (last.met_unknown) add(found.undecided, {last.value, values.high});
    } else {
      if (last.met_unknown) add(found.undecided, {values.low, last.value});
      add(found.intervals, {last.value, values.high});
    }
  }
}

}  // namespace gearlash
