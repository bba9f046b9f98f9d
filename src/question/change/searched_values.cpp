#include "question/change/searched_values.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "base/on_threads.hpp"
#include "gearlash/parameter.hpp"
#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/border.hpp"
#include "question/change/value_scan.hpp"

namespace gearlash {
namespace {

/// The drives along a line, as far as they were analysed.
class AnalysedDrives {
 public:
  /// `count` of them are analysed afresh.
  AnalysedDrives(const DriveAlong& drive, std::size_t count, const Target& target,
                 const Wanted& wanted, Progress& progress)
      : drive_(drive), count_(count), target_(target), wanted_(wanted), progress_(progress) {
    for (const QuantityLimit& limit : target.limits) {
      if (info_of(limit.quantity).scope == QuantityScope::motion)
        of_motion_.limits.push_back(limit);
    }
  }

  std::size_t evaluations() const { return evaluations_; }
  bool is_stopped() const { return is_stopped_; }

  JudgedValue afresh(double value) { return judged(value, nullptr); }

  /// What happens between the end of an interval, upwards or downwards, and the values beyond that
  /// were analysed, as far as `far`, from the nearest on: next to a fold motion lingers, and the
  /// nearest may not have closed the cycle. Empty if there is none, or it meets the target.
  std::optional<Border> border_at(double end, bool upwards, double far) {
    std::optional<Border> first;
    Hearing hearing(*this);
    const auto at_end = known_.find(end);
    if (at_end == known_.end()) return first;
    auto beyond = at_end;
    while (upwards ? std::next(beyond) != known_.end() : beyond != known_.begin()) {
      beyond = upwards ? std::next(beyond) : std::prev(beyond);
      const Judged& there = beyond->second;
      const bool is_near = upwards ? beyond->first <= far : beyond->first >= far;
      if (!is_near || !there.is_known || there.is_met) break;
      const Border border = border_between(drive_, {end, *at_end->second.analysis},
                                           {beyond->first, *there.analysis}, far, hearing);
      if (!first) first = border;
      if (border.kind == BorderKind::unnamed || border.kind == BorderKind::rest) continue;
      return border;
    }
    return first;
  }

  /// From the nearest value that was analysed.
  JudgedValue followed(double value) { return judged(value, nearest(value)); }

 private:
  using Known = std::shared_ptr<const Analysis>;
  struct Judged {
    Known analysis;
    bool is_met = false;
    bool is_known = false;
  };

  JudgedValue judged(double value, const Known& near) {
    const Drive drive = drive_(value);
    if (!faults(drive).empty()) {
      return {.value = value, .beyond = Target::infinity, .moves_beyond = Target::infinity};
    }
    const JudgedValue unknown{.value = value, .is_known = false, .beyond = Target::infinity};
    if (is_stopped_) return unknown;
    Hearing hearing(*this);
    const auto analysis =
        std::make_shared<const Analysis>(near ? analyse_near(drive, *near, wanted_, hearing)
                                              : analyse_in_full(drive, wanted_, hearing));
    ++evaluations_;
    const Answer& answer = analysis->answer;
    if (answer.search && !answer.search->is_complete) return unknown;
    const Judged judged{analysis, is_met(target_, answer), is_known(target_, answer)};
    {
      const std::scoped_lock lock(keeping_);
      known_[value] = judged;
    }
    return {.value = value,
            .is_met = judged.is_met,
            .is_known = judged.is_known,
            .moves = answer.value(Quantity::amplitude).value_or(0.0) > 0.0,
            .beyond = excess(target_, answer),
            .moves_beyond = excess(of_motion_, answer)};
  }

  Known nearest(double value) {
    const std::scoped_lock lock(keeping_);
    const auto above = known_.lower_bound(value);
    if (above == known_.end()) return known_.empty() ? nullptr : std::prev(above)->second.analysis;
    if (above == known_.begin()) return above->second.analysis;
    const auto below = std::prev(above);
    return (value - below->first < above->first - value ? below : above)->second.analysis;
  }

  /// Asks whether to go on, from several threads. The ends of intervals take about as many values
  /// as the grid has.
  class Hearing : public Progress {
   public:
    explicit Hearing(AnalysedDrives& of) : of_(of) {}
    bool go_on(double share, std::size_t bytes = 0) override {
      const std::scoped_lock lock(of_.hearing_);
      const double done = static_cast<double>(of_.evaluations_) + share;
      const double left = std::max(1.0, 2.0 * static_cast<double>(of_.count_) - done);
      if (!of_.progress_.go_on(done / (done + left), bytes)) of_.is_stopped_ = true;
      return !of_.is_stopped_;
    }

   private:
    AnalysedDrives& of_;
  };

  const DriveAlong& drive_;
  std::size_t count_;
  const Target& target_;
  const Wanted wanted_;
  Target of_motion_;
  Progress& progress_;
  std::map<double, Judged> known_;
  std::mutex keeping_;
  std::mutex hearing_;
  std::atomic<std::size_t> evaluations_ = 0;
  std::atomic<bool> is_stopped_ = false;
};

/// More is not worth a second or two for each value that is tried.
Resolution resolution_over(const Bounds& range) {
  constexpr double at_jump = 1e-4;
  return {.smooth = 1e-9, .at_jump = at_jump, .least = 1e-3 * at_jump * (range.high - range.low)};
}

std::vector<JudgedValue> of_words(AnalysedDrives& analysed, FeasibleValues& found) {
  const auto afresh = [&](double value) { return analysed.afresh(value); };
  std::vector<JudgedValue> tried =
      tried_values(afresh, {.first = found.grid, .most_halvings = 0, .halvings_everywhere = 0});
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
std::vector<IntervalEnd> ends_with_borders(AnalysedDrives& analysed, const FeasibleValues& found) {
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
    end.border = analysed.border_at(value, end.is_upper, far);
  });
  return ends;
}

/// Names the ends of intervals. A cycle that misses the target may go on into an interval, where no
/// start led to it: the interval begins where it ends. Of one that it fills nothing is known.
void name_borders(AnalysedDrives& analysed, FeasibleValues& found) {
  if (analysed.is_stopped()) return;
  std::vector<IntervalEnd> ends = ends_with_borders(analysed, found);
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
    if (interval.contains(within) && analysed.afresh(within).is_met) {
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

std::vector<JudgedValue> of_numbers(AnalysedDrives& analysed, FeasibleValues& found) {
  const Resolution resolution = resolution_over(found.searched);
  const auto afresh = [&](double value) { return analysed.afresh(value); };
  const auto followed = [&](double value) { return analysed.followed(value); };
  constexpr int most_halvings = 2;
  std::vector<JudgedValue> tried = tried_values(
      afresh, {.first = found.grid, .most_halvings = most_halvings, .halvings_everywhere = 0});
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
  name_borders(analysed, found);
  return tried;
}

/// Precondition: `found` has its grid.
template <class Search>
void fill(FeasibleValues& found, const DriveAlong& drive, const Target& target,
          const Wanted& wanted, Progress& progress, const Search& search) {
  found.kind = SearchKind::searched;
  AnalysedDrives analysed(drive, found.grid.size(), target, wanted, progress);
  const std::vector<JudgedValue> tried = search(analysed, found);
  if (found.intervals.empty()) found.closest = closest_of(tried);
  found.evaluations = analysed.evaluations();
  found.stopped = analysed.is_stopped();
}

}  // namespace

FeasibleValues feasible_along(const DriveAlong& drive, const std::vector<double>& grid,
                              const Target& target, Progress& progress) {
  FeasibleValues found{.searched = {grid.front(), grid.back()}, .grid = grid};
  fill(found, drive, target, wanted_for(target, drive(grid.front())), progress, of_numbers);
  return found;
}

void search_numbers(const Drive& drive, const Axis& axis, const Target& target,
                    FeasibleValues& found, Progress& progress) {
  fill(found, drives_along(axis, drive), target, wanted_for(target, drive), progress, of_numbers);
}

void search_words(const Drive& drive, const Axis& axis, const Target& target, FeasibleValues& found,
                  Progress& progress) {
  fill(found, drives_along(axis, drive), target, wanted_for(target, drive), progress, of_words);
}

}  // namespace gearlash
