#include "question/change/analysed_values.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "base/on_threads.hpp"
#include "gearlash/parameter.hpp"
#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/border.hpp"
#include "question/change/value_scan.hpp"
#include "question/family/followed_drives.hpp"

namespace gearlash {
namespace {

/// Part of a grid, by its first and its last place.
struct GridRun {
  std::size_t low;
  std::size_t high;
};

bool misses(const JudgedValue& one) { return one.is_known && !one.is_met; }

/// Analyses the ends afresh. Where both miss the target, the values between are followed from one
/// to the next, and analysed afresh unless their verdicts miss it too; else the middle is analysed
/// afresh too, and so on.
std::vector<JudgedValue> on_grid(JudgedLine& judged, const std::vector<double>& grid) {
  AnalysedLine& line = judged.line();
  const auto is_missed_there = [&](const Answer& there) {
    return is_missed(judged.target(), there);
  };
  std::vector<JudgedValue> all(grid.size());
  std::vector<AnalysedLine::Known> analyses(grid.size());
  std::vector<std::size_t> next = {0};
  if (grid.size() > 1) next.push_back(grid.size() - 1);
  std::vector<GridRun> open = {{0, grid.size() - 1}};
  std::vector<GridRun> missing;
  while (!next.empty()) {
    on_threads(0, next.size(), [&](std::size_t i) {
      const std::size_t place = next[i];
      analyses[place] = line.afresh(grid[place]);
      all[place] = judged.judged(grid[place], analyses[place]);
    });
    next.clear();
    std::vector<GridRun> halves;
    for (const auto& [low, high] : open) {
      if (high - low < 2) continue;
      const bool both_miss = misses(all[low]) && misses(all[high]);
      if (both_miss && high - low <= longest_run) {
        missing.push_back({low, high});
        continue;
      }
      const std::size_t middle = low + (high - low) / 2;
      next.push_back(middle);
      halves.push_back({low, middle});
      halves.push_back({middle, high});
    }
    open = std::move(halves);
  }
  on_threads(0, missing.size(), [&](std::size_t i) {
    const auto [low, high] = missing[i];
    AnalysedLine::Known near = analyses[low];
    for (std::size_t place = low + 1; place < high; ++place) {
      const AnalysedLine::Known here = line.followed(grid[place], near, is_missed_there);
      all[place] = judged.judged(grid[place], here);
      const bool is_followed = here && here->is_followed;
      if (is_followed && !misses(all[place])) all[place] = judged.afresh(grid[place]);
      if (here) near = here;
    }
  });
  return all;
}

/// What happens between the end of an interval, upwards or downwards, and the values beyond that
/// were analysed, as far as `far`, from the nearest on: next to a fold motion lingers, and the
/// nearest may not have closed the cycle. Empty if there is none, or it meets the target.
std::optional<Border> border_at(JudgedLine& judged, double end, bool upwards, double far) {
  AnalysedLine& line = judged.line();
  std::optional<Border> first;
  const std::map<double, AnalysedLine::Known>& known = line.known();
  const auto at_end = known.find(end);
  if (at_end == known.end()) return first;
  auto beyond = at_end;
  while (upwards ? std::next(beyond) != known.end() : beyond != known.begin()) {
    beyond = upwards ? std::next(beyond) : std::prev(beyond);
    const bool is_near = upwards ? beyond->first <= far : beyond->first >= far;
    if (!is_near || !misses(judged.judged(beyond->first, beyond->second))) break;
    const Border border = border_between(line.drive(), {end, *at_end->second},
                                         {beyond->first, *beyond->second}, far, line.progress());
    if (!first) first = border;
    if (border.kind == BorderKind::unnamed || border.kind == BorderKind::rest) continue;
    return border;
  }
  return first;
}

/// More is not worth a second or two for each value that is tried.
Resolution resolution_over(const Bounds& range) {
  constexpr double at_jump = 1e-4;
  return {.smooth = 1e-9, .at_jump = at_jump, .least = 1e-3 * at_jump * (range.high - range.low)};
}

std::vector<JudgedValue> judged_words(JudgedLine& line, FeasibleValues& found) {
  std::vector<JudgedValue> tried =
      judged_values([&](double value) { return line.afresh(value); }, found.grid);
  for (const JudgedValue& one : tried) {
    if (one.is_met) found.intervals.push_back({one.value, one.value});
    if (!one.is_known) found.undecided.push_back({one.value, one.value});
  }
  return tried;
}

/// An end of an interval within the range.
struct IntervalEnd {
  std::size_t interval = 0;
  bool is_upper = false;
  std::optional<Border> border{};
};

/// What happens at each end of an interval within the range. Cycles are followed as far as the next
/// value of the grid.
std::vector<IntervalEnd> ends_with_borders(JudgedLine& line, const FeasibleValues& found) {
  std::vector<IntervalEnd> ends;
  for (std::size_t i = 0; i < found.intervals.size(); ++i) {
    if (found.intervals[i].low > found.searched.low) ends.push_back({i, false});
    if (found.intervals[i].high < found.searched.high) ends.push_back({i, true});
  }
  const std::vector<double>& grid = found.grid;
  on_threads(0, ends.size(), [&](std::size_t i) {
    IntervalEnd& end = ends[i];
    const Bounds& interval = found.intervals[end.interval];
    const double value = end.is_upper ? interval.high : interval.low;
    const double far = end.is_upper ? *std::upper_bound(grid.begin(), grid.end(), value)
                                    : *std::prev(std::lower_bound(grid.begin(), grid.end(), value));
    end.border = border_at(line, value, end.is_upper, far);
  });
  return ends;
}

/// Names the ends of intervals. A cycle that misses the target may go on into an interval, where no
/// start led to it: the interval begins where it ends. Of one that it fills nothing is known.
void name_borders(JudgedLine& line, FeasibleValues& found) {
  if (line.line().is_stopped()) return;
  std::vector<IntervalEnd> ends = ends_with_borders(line, found);
  std::vector<bool> is_filled(found.intervals.size(), false);
  for (IntervalEnd& end : ends) {
    if (!end.border) continue;
    Border& border = *end.border;
    Bounds& interval = found.intervals[end.interval];
    double& edge = end.is_upper ? interval.high : interval.low;
    const bool goes_on = end.is_upper ? border.at < edge : border.at > edge;
    if (!goes_on) continue;
    const double aside = 2.0 * border.located * std::abs(border.at);
    const double within = border.at + (end.is_upper ? -aside : aside);
    if (interval.contains(within) && line.afresh(within).is_met) {
      border.end = edge = within;
    } else {
      is_filled[end.interval] = true;
    }
  }
  for (IntervalEnd& end : ends) {
    if (end.border && !is_filled[end.interval]) found.borders.push_back(std::move(*end.border));
  }
  for (std::size_t i = is_filled.size(); i-- > 0;) {
    if (!is_filled[i]) continue;
    const auto filled = found.intervals.begin() + static_cast<std::ptrdiff_t>(i);
    found.undecided.push_back(*filled);
    found.intervals.erase(filled);
  }
}

/// Near a border where few starts lead to another motion, verdicts do not repeat from value to
/// value. The interval then ends before the values just inside that miss the target.
LastMet where_verdicts_repeat(const Judge& afresh, double met, LastMet last,
                              const Resolution& resolution) {
  constexpr double inside[] = {0.003, 0.01, 0.05};  // of the way from the end to `met`
  constexpr int most_times = 4;
  for (int times = 0; times < most_times && last.value != met; ++times) {
    const auto* const missed = std::find_if_not(
        std::begin(inside), std::end(inside),
        [&](double share) { return afresh(last.value + share * (met - last.value)).is_met; });
    if (missed == std::end(inside)) break;
    last = last_met(afresh, met, last.value + *missed * (met - last.value), resolution);
  }
  return last;
}

std::vector<JudgedValue> judged_numbers(JudgedLine& line, FeasibleValues& found) {
  const Resolution resolution = resolution_over(found.searched);
  const auto afresh = [&](double value) { return line.afresh(value); };
  const auto followed = [&](double value) { return line.followed(value); };
  constexpr int most_halvings = 2;
  std::vector<JudgedValue> tried =
      tried_between(on_grid(line, found.grid), afresh,
                    {.most_halvings = most_halvings, .halvings_everywhere = 0});
  found.located = resolution.at_jump;
  if (tried.size() == 1 && tried[0].is_met) found.intervals = {found.searched};
  const auto is_met_at = [&](double value) {
    return std::lower_bound(
               tried.begin(), tried.end(), value,
               [](const JudgedValue& one, double wanted) { return one.value < wanted; })
        ->is_met;
  };
  put_together(
      parts_between(tried), is_met_at,
      [&](double met, double unmet) {
        LastMet last = last_met(followed, met, unmet, resolution);
        if (last.value != met && !afresh(last.value).is_met) {
          last = last_met(afresh, met, last.value, resolution);
        }
        return where_verdicts_repeat(afresh, met, last, resolution);
      },
      found);
  name_borders(line, found);
  return tried;
}

/// Returns the fresh analysis of the closest value, or nullptr. Precondition: `found` has its grid.
template <class Search>
AnalysedLine::Known fill(FeasibleValues& found, const DriveAlong& drive, const Target& target,
                         const Wanted& wanted, Progress& progress, const Search& search) {
  found.kind = SearchKind::searched;
  // The ends of intervals take about as many analyses as the grid.
  JudgedLine line(drive, wanted, 2 * found.grid.size(), target, progress);
  const std::vector<JudgedValue> tried = search(line, found);
  if (found.intervals.empty()) found.closest = closest_of(tried);
  found.evaluations = line.line().evaluations();
  found.stopped = line.line().is_stopped();
  const auto closest =
      found.closest ? line.line().known().find(*found.closest) : line.line().known().end();
  const bool is_fresh = closest != line.line().known().end() && !closest->second->is_followed;
  return is_fresh ? closest->second : nullptr;
}

}  // namespace

AnalysedLine::Known searched_values(const DriveAlong& drive, const Target& target,
                                    const Wanted& wanted, FeasibleValues& found,
                                    Progress& progress) {
  return fill(found, drive, target, wanted, progress, judged_numbers);
}

AnalysedLine::Known searched_words(const DriveAlong& drive, const Target& target,
                                   const Wanted& wanted, FeasibleValues& found,
                                   Progress& progress) {
  return fill(found, drive, target, wanted, progress, judged_words);
}

}  // namespace gearlash
