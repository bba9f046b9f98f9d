#include "analysis/design/searched_values.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "analysis/analyse.hpp"
#include "analysis/design/border.hpp"
#include "analysis/design/proved_values.hpp"
#include "analysis/design/value_scan.hpp"
#include "analysis/grid/axis.hpp"
#include "base/on_threads.hpp"
#include "gearlash/parameter.hpp"

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

/// Whether a word asks for numbers that the drive does not have, as a cascade's gains.
bool asks_for_more(const Axis& axis, double word, const Drive& drive) {
  Drive changed = drive;
  set_on(axis, changed, word);
  const std::vector<Parameter>& all = all_parameters_of_drives();
  return std::any_of(all.begin(), all.end(), [&](const Parameter& parameter) {
    return parameter.is_required && exists(parameter, changed) && !exists(parameter, drive);
  });
}

/// In place of a value that differs from it by rounding.
void add_present(double present, std::vector<double>& grid) {
  constexpr double rounding = 1e-12;
  const auto above = std::lower_bound(grid.begin(), grid.end(), present);
  for (const auto near : {above, above == grid.begin() ? above : std::prev(above)}) {
    if (near == grid.end() || std::abs(*near - present) > rounding * std::abs(present)) continue;
    *near = present;
    return;
  }
  grid.insert(above, present);
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

/// The last value towards an unsound one of which the drive is sound: `sound` itself towards 0.
template <class IsSound>
double last_sound(double sound, double unsound, IsSound&& is_sound) {
  constexpr int bisections = 40;
  for (int i = 0; i < bisections && unsound != 0.0; ++i) {
    const double middle = 0.5 * (sound + unsound);
    (is_sound(middle) ? sound : unsound) = middle;
  }
  return sound;
}

/// Cuts a rising grid to where the drive is sound, unless it is so nowhere.
void cut_to_sound_drives(const Axis& axis, const Drive& drive, FeasibleValues& found) {
  const auto is_sound = [&](double value) {
    Drive changed = drive;
    set_on(axis, changed, value);
    return faults(changed).empty();
  };
  std::vector<double>& grid = found.grid;
  const auto first = std::find_if(grid.begin(), grid.end(), is_sound);
  const auto last = std::find_if(grid.rbegin(), grid.rend(), is_sound);
  if (first == grid.end()) return;
  std::vector<double> sound(first, last.base());
  if (first != grid.begin()) {
    const double end = last_sound(*first, *(first - 1), is_sound);
    if (end < sound.front()) sound.insert(sound.begin(), end);
  }
  if (last != grid.rbegin()) {
    const double end = last_sound(*last, *(last - 1), is_sound);
    if (end > sound.back()) sound.push_back(end);
  }
  grid = std::move(sound);
  found.searched = {grid.front(), grid.back()};
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

Axis usual_axis(const Drive& drive, std::string_view parameter) {
  return usual_axis("parameter", drive, parameter);
}

std::vector<std::string> usual_parameters(const Drive& drive) {
  std::vector<std::string> usual;
  for (const ParameterInfo& parameter : parameters_of(drive)) {
    const std::string path(parameter.path);
    const bool is_wanted =
        path == "gearbox.backlash" || path.starts_with("controller.") || path.starts_with("servo.");
    if (!is_wanted || parameter.kind != ParameterKind::number) continue;
    const std::optional<double> present = present_value({.path = path}, drive);
    if (present && *present > 0.0 && std::isfinite(*present)) usual.push_back(path);
  }
  return usual;
}

FeasibleValues feasible_along(const DriveAlong& drive, const std::vector<double>& grid,
                              const Target& target, Progress& progress) {
  FeasibleValues found{.searched = {grid.front(), grid.back()}, .grid = grid};
  fill(found, drive, target, wanted_for(target, drive(grid.front())), progress, of_numbers);
  return found;
}

/// The drive is analysed afresh at each value of the axis, at the present one, and at the ends of
/// intervals. Between two values, of which one meets the target, analyse_near() closes in on the
/// last one that does. If that misses the target when it is analysed afresh, the search between is
/// repeated without following; if values just inside do, the interval ends before them. A value
/// whose drive is unsound does not meet the target.
FeasibleValues feasible_values(const Drive& drive, const Axis& axis, const Target& target,
                               Progress& progress) {
  std::vector<Fault> all = faults(drive);
  for (const std::vector<Fault>& more : {faults_of_axis(axis, drive, "axis"), faults(target)}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  require_none(std::move(all));
  const std::optional<double> present = present_value(axis, drive);
  const auto [least, most] = std::minmax_element(axis.values.begin(), axis.values.end());
  FeasibleValues found{.parameter = axis.path,
                       .present = present.value_or(std::numeric_limits<double>::quiet_NaN()),
                       .searched = {*least, *most},
                       .grid = axis.values};
  const bool is_word = !parameter_of(axis, drive)->choices.empty();
  std::sort(found.grid.begin(), found.grid.end());
  if (is_word) {
    std::erase_if(found.grid, [&](double word) { return asks_for_more(axis, word, drive); });
  }
  if (!is_word) cut_to_sound_drives(axis, drive, found);
  if (present && !is_word && found.searched.contains(*present)) add_present(*present, found.grid);
  fill(found, drives_along(axis, drive), target, wanted_for(target, drive), progress,
       is_word ? of_words : of_numbers);
  if (!is_word && is_of_ceilings(target)) {
    for (const Bounds& interval : found.intervals) {
      constexpr std::size_t most_boxes = 8000;
      found.proofs.push_back(
          prove_target(drive, axis.path, interval, target, most_boxes, progress));
    }
  }
  return found;
}

}  // namespace gearlash
