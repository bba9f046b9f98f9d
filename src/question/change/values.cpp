#include "question/change/values.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "base/progress_part.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameter_values.hpp"
#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/analysed_values.hpp"
#include "question/change/proved_values.hpp"
#include "question/change/servo_line.hpp"
#include "question/change/value_scan.hpp"
#include "question/family/family.hpp"

namespace gearlash {
namespace {

/// Values spread over a range: by ratio where it is wide, over the last four decades where it
/// begins at 0, evenly for a restitution.
std::vector<double> spread_over(const Bounds& range, std::size_t count, bool evenly) {
  constexpr double decades = 1e-4;
  const double low = range.low > 0.0 ? range.low : decades * range.high;
  const bool by_ratio = !evenly && range.high > 4.0 * low;
  std::vector<double> values;
  if (by_ratio && low > range.low) values.push_back(range.low);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    values.push_back(by_ratio ? low * std::pow(range.high / low, share)
                              : range.low + share * (range.high - range.low));
  }
  values.push_back(range.high);
  return values;
}

/// Answers that need no search, each asking whether to go on; empty for an unsound drive.
AnalysedLine::Analyse answered_by(std::function<std::optional<Answer>(double value)> answer_at) {
  return [answer_at = std::move(answer_at)](double value, const SearchScope&,
                                            Progress& progress) -> AnalysedLine::Known {
    std::optional<Answer> answer = progress.go_on(0.0) ? answer_at(value) : std::nullopt;
    if (!answer) return nullptr;
    return std::make_shared<const Analysis>(Analysis{.answer = *std::move(answer)});
  };
}

/// The search along a line in closed form.
class ServoSearch {
 public:
  ServoSearch(const ServoLine& line, const Target& target, Progress& progress)
      : line_(line),
        target_(target),
        judged_([&line](double value) { return line.drive_at(value); },
                answered_by([this](double value) { return answer_at(value); }), usual_evaluations,
                target, progress) {
    if (line.is_backlash() && line.has_bounces() && line.present() > 0.0) {
      at_present_ = line.answer_at(line.present());
    }
  }

  std::size_t evaluations() const { return judged_.line().evaluations() + boxes_; }
  bool is_stopped() const { return judged_.line().is_stopped(); }

  bool is_met_at(double value) { return judged(value).is_met; }

  /// The range in parts, in order: proved parts and undecided slivers. Each round halves all open
  /// parts, so that a difficult part does not leave others unsearched.
  std::vector<Part> certified(const Bounds& range) {
    std::vector<Part> proved;
    std::vector<Bounds> open = {range};
    while (!open.empty()) {
      std::vector<Bounds> halves;
      for (const Bounds& values : open) {
        const Judgement judgement = judge_part(values);
        if (judgement != Judgement::some || is_sliver(values, range.high)) {
          proved.push_back({values, judgement});
          continue;
        }
        const double middle = middle_value(values.low, values.high);
        halves.push_back({values.low, middle});
        halves.push_back({middle, values.high});
      }
      open = std::move(halves);
      constexpr std::size_t most_open = 20'000;
      if (open.size() <= most_open && judged_.line().progress().go_on(0.0)) continue;
      for (const Bounds& values : open) proved.push_back({values, Judgement::some});
      break;
    }
    sort_by(proved, [](const Part& part) { return part.values.low; });
    return proved;
  }

  /// The parts of a scan. None is a sliver; the ends of each decide its judgement.
  std::vector<Part> scanned(const Bounds& range) { return parts_between(tried(range)); }

  LastMet last_met_between(double met, double unmet) {
    const auto judge = [this](double value) { return judged(value); };
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    if (!line_.has_bounces()) return last_met(judge, met, unmet, {rounding, rounding});
    // Growth at rest is cheap, and what it does not rule out usually meets the target.
    const double allowed = last_allowed_by_growth(met, unmet);
    if (allowed == met || is_met_at(allowed)) return {allowed, unmet};
    constexpr double at_jump = 1e-6;  // more is not worth a search for cycles per step
    return last_met(judge, met, allowed, {rounding, at_jump});
  }

  /// The tried value that comes closest to the target.
  double closest(const Bounds& range) {
    std::vector<JudgedValue> all = tried(range);
    if (!std::isnan(line_.present())) all.push_back(judged(line_.present()));
    return closest_of(all);
  }

 private:
  Answer answer_at(double value) const {
    return at_present_ ? with_backlash(*at_present_, value) : line_.answer_at(value, target_);
  }

  JudgedValue judged(double value) {
    JudgedValue here = judged_.afresh(value);
    here.is_known = here.is_known || (!line_.has_bounces() && !is_stopped());
    return here;
  }

  /// Values over the whole range, in order, denser near a limit.
  const std::vector<JudgedValue>& tried(const Bounds& range) {
    if (tried_.empty()) {
      tried_ = tried_values([this](double value) { return judged(value); }, first_values(range));
    }
    return tried_;
  }

  std::vector<double> first_values(const Bounds& range) {
    const bool bounces = line_.has_bounces();
    const bool evenly = line_.is_share();
    std::vector<double> values = spread_over(range, bounces ? coarse : fine, evenly);
    if (!bounces) return values;
    // Growth at rest is cheap; between these values it passes 1 or a limit.
    const std::vector<double> looked_at = spread_over(range, fine, evenly);
    const std::vector<double> growths = of_each_on_threads(looked_at, [&](double value) {
      return judged_.line().progress().go_on(0.0) ? line_.growth_at(value) : 0.0;
    });
    const auto differ = [&](double a, double b) {
      return (a > 1.0) != (b > 1.0) || is_ruled_out(target_, a) != is_ruled_out(target_, b);
    };
    for (std::size_t i = 0; i + 1 < looked_at.size(); ++i) {
      if (!differ(growths[i], growths[i + 1])) continue;
      values.push_back(looked_at[i]);
      values.push_back(looked_at[i + 1]);
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
  }

  /// The last value, starting from one that meets the target, that growth at rest does not rule
  /// out. Growth very close to 1 is excluded too, because the search for cycles cannot distinguish
  /// rest from hunting there.
  double last_allowed_by_growth(double met, double unmet) const {
    constexpr double told_apart = 1e-6;
    const auto is_allowed = [&](double value) {
      const double growth = line_.growth_at(value);
      return !is_ruled_out(target_, growth) &&
             !(asks_for_rest(target_) && growth > 1.0 - told_apart);
    };
    if (is_allowed(unmet)) return unmet;
    for (;;) {
      const double middle = middle_value(std::min(met, unmet), std::max(met, unmet));
      if (middle == met || middle == unmet) return met;
      (is_allowed(middle) ? met : unmet) = middle;
    }
  }

  Judgement judge_part(const Bounds& values) {
    ++boxes_;
    return judge(target_, line_.bounds(values));
  }

  static bool is_sliver(const Bounds& values, double top) {
    constexpr double width = 1e-10;
    return values.high - values.low <= width * values.high || values.high <= width * width * top;
  }

  static constexpr std::size_t coarse = 64;  ///< a servo with bounces takes milliseconds
  static constexpr std::size_t fine = 1024;
  static constexpr std::size_t usual_evaluations = 500;  ///< for the progress alone

  const ServoLine& line_;
  const Target& target_;
  std::optional<Answer> at_present_;  ///< for backlash: amplitudes are proportional to it
  std::vector<JudgedValue> tried_;
  JudgedLine judged_;
  std::size_t boxes_ = 0;
};

/// Joins neighbors with the same judgement.
std::vector<Part> joined(const std::vector<Part>& parts) {
  std::vector<Part> all;
  for (const Part& part : parts) {
    if (!all.empty() && all.back().judgement == part.judgement) {
      all.back().values.high = part.values.high;
    } else {
      all.push_back(part);
    }
  }
  return all;
}

/// What the closed form answers of the target, over a range.
FeasibleValues values_of_servos(const ServoLine& line, const Bounds& range, const Target& target,
                                Progress& progress) {
  FeasibleValues found{.searched = range};
  const bool is_certified = !line.has_bounces();
  found.kind = is_certified ? SearchKind::certified : SearchKind::scanned;
  ServoSearch search(line, target, progress);
  put_together(
      is_certified ? joined(search.certified(range)) : search.scanned(range),
      [&](double value) { return search.is_met_at(value); },
      [&](double met, double unmet) { return search.last_met_between(met, unmet); }, found);
  if (found.intervals.empty()) found.closest = search.closest(range);
  found.evaluations = search.evaluations();
  found.stopped = search.is_stopped();
  return found;
}

// ---- what is searched within the intervals
// -------------------------------------------------------

/// The values within an interval, with its ends, rising.
std::vector<double> values_within(const Bounds& interval, const std::vector<double>& values) {
  std::vector<double> within = {interval.low};
  add_all(within, those_of(values, [&](double value) {
            return value > interval.low && value < interval.high;
          }));
  if (interval.high > interval.low) within.push_back(interval.high);
  return within;
}

/// The borders of the intervals that are left. `before`: the intervals that were narrowed.
void name_ends(const std::vector<Bounds>& before, FeasibleValues& found) {
  const auto has_end = [](const std::vector<Bounds>& intervals, double end) {
    return any_of(intervals, [&](const Bounds& interval) {
      return interval.low == end || interval.high == end;
    });
  };
  std::erase_if(found.borders,
                [&](const Border& border) { return !has_end(found.intervals, border.end); });
  for (const Bounds& interval : found.intervals) {
    for (const double end : {interval.low, interval.high}) {
      if (has_end(before, end) || is_in(found.undecided, end)) continue;
      found.borders.push_back({.end = end, .kind = BorderKind::limit, .at = end});
    }
  }
}

/// Keeps of the intervals what meets the other conditions too. An interval all of whose values meet
/// them stays as it is.
void narrow(const Drive& drive, const Axis& axis, const ServoLine* line, const Target& others,
            const std::vector<double>& values, FeasibleValues& found, Progress& progress) {
  constexpr std::size_t usual_evaluations = 200;
  const Wanted wanted = wanted_for(others);
  const DriveAlong along = drives_along(axis, drive);
  JudgedLine search(along, answered_by([&](double value) -> std::optional<Answer> {
                      const std::optional<SoundDrive> changed = SoundDrive::of(along(value));
                      if (!changed) return std::nullopt;
                      Answer answer = line == nullptr ? Answer{} : line->answer_at(value);
                      add_figures(*changed, wanted, answer, search.line().progress());
                      return answer;
                    }),
                    usual_evaluations, others, progress);
  const auto judge = [&](double value) { return search.afresh(value); };
  constexpr Resolution resolution{.smooth = 1e-12, .at_jump = 1e-9};
  const std::vector<Bounds> intervals = std::exchange(found.intervals, {});
  std::vector<JudgedValue> all;
  for (const Bounds& interval : intervals) {
    const std::vector<JudgedValue> tried = tried_values(judge, values_within(interval, values));
    add_all(all, tried);
    if (tried.size() == 1 && tried[0].is_met) found.intervals.push_back(interval);
    FeasibleValues within;
    put_together(
        parts_between(tried), [&](double value) { return judge(value).is_met; },
        [&](double met, double unmet) { return last_met(judge, met, unmet, resolution); }, within);
    add_all(found.intervals, within.intervals);
    add_all(found.undecided, within.undecided);
  }
  name_ends(intervals, found);
  if (found.intervals.empty() && !all.empty()) found.closest = closest_of(all);
  found.searched_within = others;
  found.evaluations += search.line().evaluations();
  found.stopped = found.stopped || search.line().is_stopped();
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
  const auto is_sound = [along = drives_along(axis, drive)](double value) {
    return faults(along(value)).empty();
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

/// What a target says of ceilings is proved over each interval, as far as bounds go.
void prove_ceilings(const Drive& drive, const Axis& axis, const Target& target,
                    FeasibleValues& found, Progress& progress) {
  const Target ceilings{.limits = those_of(target.limits, is_provable)};
  if (is_empty(ceilings)) return;
  constexpr std::size_t most_boxes = 8000;
  for (const Bounds& interval : found.intervals) {
    found.proofs.push_back(
        prove_target(drive, axis.path, interval, ceilings, most_boxes, progress));
  }
}

/// Whether a word asks for numbers that the drive does not have, as a cascade's gains.
bool asks_for_more(const Axis& axis, double word, const Drive& drive) {
  Drive changed = drive;
  set_on(axis, changed, word);
  const std::vector<Parameter>& all = all_parameters_of_drives();
  return any_of(all, [&](const Parameter& parameter) {
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

/// Whether the path means the parameter itself, not another number that gives it.
bool is_alias(const Parameter& parameter, std::string_view path) {
  const OtherForm* form = form_named(parameter, path);
  return form != nullptr && form->relation == Relation::same;
}

/// What a designer considers first, if it enters the closed form.
std::vector<std::string> usual_numbers_of_servo(const Drive& drive) {
  constexpr std::string_view first[] = {"servo.backlash",      "gearbox.backlash",
                                        "gearbox.ratio",       "controller.proportional",
                                        "controller.position", "controller.speed",
                                        "controller.gain",     "load.friction",
                                        "motor.friction",      "controller.motor_speed_feedback",
                                        "load.inertia",        "motor.inertia",
                                        "contact.restitution"};
  std::vector<std::string> usual;
  for (const std::string_view path : first) {
    const bool is_said_before = drive.servo && path == "gearbox.backlash";
    const std::string name(path);
    if (!is_said_before && ServoLine::along(drive, name)) usual.push_back(name);
  }
  return usual;
}

/// The values of a number that meet the target. `found` has its grid.
FeasibleValues values_of_number(const Drive& drive, const Axis& axis, const Target& target,
                                FeasibleValues found, Progress& progress,
                                AnalysedLine::Known& at_closest) {
  const std::optional<ServoLine> line = ServoLine::along(drive, axis.path);
  const bool is_bounded = line && !line->has_bounces();
  const auto [first, others] = is_bounded
                                   ? parts_of(target, [](Quantity one) { return is_of_boxes(one); })
                                   : parts_of(target, [](Quantity one) { return !is_figure(one); });
  const double share = is_empty(others) ? 1.0 : 0.8;
  ProgressPart searching(progress, 0.0, share);
  ProgressPart narrowing(progress, share, 1.0);
  if (is_empty(first)) {
    found.kind = SearchKind::scanned;
    found.intervals = {found.searched};
  } else if (line) {
    FeasibleValues closed = values_of_servos(*line, found.searched, first, searching);
    closed.parameter = found.parameter;
    closed.present = found.present;
    found = std::move(closed);
  } else {
    at_closest =
        searched_values(drives_along(axis, drive), first, wanted_for(first), found, searching);
  }
  if (!is_empty(others)) {
    at_closest.reset();
    const bool of_motion = line && any_of(others.limits, [](const QuantityLimit& limit) {
                             return !is_figure(limit.quantity);
                           });
    constexpr std::size_t count = 64;
    const std::vector<double> values =
        line ? spread_over(found.searched, count, line->is_share()) : found.grid;
    narrow(drive, axis, of_motion ? &*line : nullptr, others, values, found, narrowing);
  }
  prove_ceilings(drive, axis, target, found, progress);
  return found;
}

}  // namespace

bool FeasibleValues::contains(double value) const { return is_in(intervals, value); }

std::optional<double> FeasibleValues::nearest() const {
  std::optional<double> nearest;
  const auto distance = [&](double value) {
    return present > 0.0 && value > 0.0 ? std::abs(std::log(value / present))
                                        : std::abs(value - present);
  };
  for (const Bounds& interval : intervals) {
    const double here = std::clamp(present, interval.low, interval.high);
    if (!nearest || distance(here) < distance(*nearest)) nearest = here;
  }
  return nearest;
}

std::vector<double> FeasibleValues::nearest_of_each() const {
  if (closest) return {*closest};
  return of_each(intervals, [&](const Bounds& interval) {
    const double from = std::isnan(present) ? interval.low : present;
    return std::clamp(from, interval.low, interval.high);
  });
}

Axis usual_axis(const Drive& drive, std::string_view parameter) {
  return usual_axis("parameter", drive, parameter);
}

Axis axis_to_search(std::string_view field, const Drive& drive, std::string_view parameter) {
  Axis axis{.path = path_named(parameter, drive)};
  const std::optional<ServoLine> line = ServoLine::along(drive, axis.path);
  if (!line) return usual_axis(field, drive, parameter);
  if (const Parameter& own = *parameter_of(axis, drive); is_alias(own, axis.path)) {
    axis.path = own.path;
  }
  const Bounds range = line->range();
  axis.values = {range.low};
  if (range.high > range.low) axis.values.push_back(range.high);
  return axis;
}

Axis axis_to_search(const Drive& drive, std::string_view parameter) {
  require_none(faults(drive));
  return axis_to_search("parameter", drive, parameter);
}

std::vector<std::string> usual_parameters(const Drive& drive) {
  if (faults(drive).empty() && !engines_of(drive).search) return usual_numbers_of_servo(drive);
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

FeasibleValues values(const Drive& drive, const Axis& axis, const Target& target,
                      Progress& progress) {
  AnalysedLine::Known at_closest;
  return values(drive, axis, target, progress, at_closest);
}

FeasibleValues values(const Drive& drive, const Axis& axis, const Target& target,
                      Progress& progress, AnalysedLine::Known& at_closest) {
  require_none(faults(drive), faults_of_axis(axis, drive, "axis"), faults(target));
  const std::optional<double> present = present_value(axis, drive);
  const auto [least, most] = std::minmax_element(axis.values.begin(), axis.values.end());
  FeasibleValues found{.parameter = axis.path,
                       .present = present.value_or(not_a_number),
                       .searched = {*least, *most},
                       .grid = axis.values};
  std::sort(found.grid.begin(), found.grid.end());
  if (!parameter_of(axis, drive)->choices.empty()) {
    std::erase_if(found.grid, [&](double word) { return asks_for_more(axis, word, drive); });
    at_closest =
        searched_words(drives_along(axis, drive), target, wanted_for(target), found, progress);
    return found;
  }
  cut_to_sound_drives(axis, drive, found);
  if (present && found.searched.contains(*present)) add_present(*present, found.grid);
  return values_of_number(drive, axis, target, std::move(found), progress, at_closest);
}

FeasibleValues values(const Drive& drive, std::string_view parameter, const Target& target,
                      Progress& progress) {
  return values(drive, axis_to_search(drive, parameter), target, progress);
}

}  // namespace gearlash
