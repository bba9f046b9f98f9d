#include "gearlash/tune.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "base/progress_part.hpp"
#include "base/range_check.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "model/sound_drive.hpp"
#include "numeric/box_minimum.hpp"
#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/target.hpp"
#include "question/change/tune_derivatives.hpp"
#include "question/loop/linear_loop.hpp"
#include "question/series/corner_sample.hpp"
#include "question/series/samples.hpp"
#include "question/series/toleranced_drive.hpp"

namespace gearlash {
namespace {

using Values = std::vector<double>;

// How far a unit misses, in an order that leads the optimiser: an unsound drive, a linear loop
// without the margin, and then by how much the target is missed.
constexpr double unsound = 100.0;
constexpr double without_margin = 50.0;
constexpr double most_missed = 40.0;

struct JudgedUnit {
  bool is_tried = false;
  bool is_met = false;
  bool is_known = true;
  double missed_by = 0.0;  ///< > 0 where not met
  double reached = not_a_number;
  Answer answer{};
};

/// By how much the target is missed. Of hunting that is not permitted the amplitude counts too.
double missed_by(const Target& target, const Answer& answer, double backlash) {
  const double amplitude = answer.value(Quantity::motor_amplitude).value_or(infinity);
  const double scale = backlash > 0.0 ? backlash : 1e-3;
  const double share = std::isinf(amplitude) ? 1.0 : amplitude / (amplitude + scale);
  constexpr double least = 1e-6;  // so that what is not met is seen to be missed
  return std::clamp(excess(target, answer), least, most_missed - 1.0) + share;
}

/// Whether what the starts by now led to misses the target, wherever all others lead. Irregular
/// motion counts behind a computer only: without one it may still end in a cycle.
bool is_missed_already(const Target& target, const drive::AttractorSearch& search,
                       bool irregular_counts) {
  const double most_of_load = target.permitted(Quantity::amplitude).high;
  const double most_of_motor = target.permitted(Quantity::motor_amplitude).high;
  const auto is_too_much = [&](const auto& motion) {
    return motion.starts > 0 &&
           (target.no_hunting_if_disturbed || motion.amplitude > most_of_load ||
            motion.motor_amplitude > most_of_motor);
  };
  if (target.no_runaway && search.count(drive::MotionEnd::diverges) > 0) return true;
  if (any_of(search.cycles, [&](const auto& cycle) {
        return cycle.stability != Stability::unstable && is_too_much(cycle);
      })) {
    return true;
  }
  return irregular_counts && any_of(search.irregular, is_too_much);
}

/// What a unit's linear loop says before any search.
struct JudgedLoop {
  double lacks = 0.0;  ///< how far the drive is from one that is worth a search; 0 if it is
  double bandwidth = not_a_number;  ///< rad/s
};

/// The units of a series with tuned values.
class Units {
 public:
  Units(const TuneTask& task, const TuneEffort& effort) : task_(task), axes_(axes_of(task.series)) {
    add(means_of(task.series));
    const std::size_t width = task.series.varied.size();
    if (width == 0) return;
    add_corners(effort.units);
    if (effort.units <= all_.size()) return;
    const SamplePlan plan{
        .points = effort.units - all_.size(), .replicates = 2, .seed = effort.seed};
    const Values drawn = detail::SampleValues(task.series, plan, 1).of(0, plan.points);
    for (std::size_t i = 0; i < drawn.size(); i += width) {
      add({drawn.begin() + static_cast<std::ptrdiff_t>(i),
           drawn.begin() + static_cast<std::ptrdiff_t>(i + width)});
    }
  }

  std::size_t size() const { return all_.size(); }
  const Values& values(std::size_t unit) const { return all_[unit]; }

  Drive nominal(const Values& tuned) const {
    return drive_with(task_.series.nominal, task_.tuned, tuned);
  }

  Drive drive(std::size_t unit, const Values& tuned) const {
    return drive_with(nominal(tuned), axes_, all_[unit], Breakaway::keeps_its_ratio);
  }

  JudgedLoop loop(std::size_t unit, const Values& tuned) const {
    const std::optional<SoundDrive> drive = SoundDrive::of(this->drive(unit, tuned));
    if (!drive) return {.lacks = unsound};
    const auto loop = drive::loop_figures(drive->settled());
    if (!loop) return {};  // of a relay
    if (!loop->is_stable) return {.lacks = without_margin + 1.0};
    const double margin = loop->phase_margin.value_or(infinity);
    const double lacks =
        margin >= task_.least_phase_margin
            ? 0.0
            : without_margin + (task_.least_phase_margin - margin) / std::numbers::pi;
    return {lacks, 2.0 * std::numbers::pi * loop->bandwidth.value_or(not_a_number)};
  }

  JudgedUnit judged(std::size_t unit, const Values& tuned, Progress& progress) const {
    const JudgedLoop loop = this->loop(unit, tuned);
    JudgedUnit judged{.is_tried = true, .missed_by = loop.lacks};
    if (judged.missed_by > 0.0) return judged;
    const Drive drive = this->drive(unit, tuned);
    judged.answer = analyse_in_full(drive, wanted_for(task_.target), progress,
                                    {.is_enough =
                                         [&](const drive::AttractorSearch& search) {
                                           return is_missed_already(task_.target, search,
                                                                    drive.sampling.has_value());
                                         }})
                        .answer;
    judged.is_met = is_met(task_.target, judged.answer);
    judged.is_known = is_known(task_.target, judged.answer);
    if (!judged.is_met) {
      judged.missed_by = missed_by(task_.target, judged.answer, drive.gearbox.backlash);
    }
    judged.reached = task_.aim == Aim::static_error
                         ? judged.answer.value(Quantity::error).value_or(not_a_number)
                         : reached_without_search(unit, tuned, loop, progress);
    return judged;
  }

  bool needs_search() const { return task_.aim == Aim::static_error; }
  /// Precondition: not needs_search().
  double reached_without_search(std::size_t unit, const Values& tuned, const JudgedLoop& loop,
                                Progress& progress) const {
    if (task_.aim == Aim::bandwidth) return loop.bandwidth;
    Answer answer;
    Wanted wanted;
    ask_for(Quantity::settling_time, wanted);
    add_figures(drive(unit, tuned), wanted, answer, progress);
    return answer.value(Quantity::settling_time).value_or(not_a_number);
  }

  /// Whether one reached less of the aim than another. An unknown number is the worst.
  bool is_worse(double one, double other) const {
    if (std::isnan(one) || std::isnan(other)) return std::isnan(one) && !std::isnan(other);
    return task_.aim == Aim::bandwidth ? one < other : one > other;
  }

 private:
  void add(Values values) { all_.push_back(std::move(values)); }

  void add_corners(std::size_t most) {
    const std::size_t width = task_.series.varied.size();
    const std::vector<std::vector<bool>> corners = corner_sample(width);
    if (all_.size() + corners.size() > most) return;  // the mean one is there
    for (const std::vector<bool>& is_high : corners) {
      add(of_each(indices(width), [&](std::size_t i) {
        const Bounds range = three_sigma_range_of(task_.series.varied[i].distribution);
        return is_high[i] ? range.high : range.low;
      }));
    }
  }

  const TuneTask& task_;
  std::vector<Axis> axes_;  ///< of the series
  std::vector<Values> all_;
};

/// The values of all units with one proposal.
struct Trial {
  Values tuned{};
  std::vector<JudgedUnit> units{};
  std::size_t tried = 0;
  std::size_t met = 0;
  double reached = not_a_number;

  /// The unit that misses the target most; size() where none does.
  std::size_t worst() const {
    const auto most = std::max_element(units.begin(), units.end(), by(&JudgedUnit::missed_by));
    return most == units.end() || most->missed_by <= 0.0
               ? units.size()
               : static_cast<std::size_t>(most - units.begin());
  }
  std::size_t missed() const {
    return count_of(units, [](const auto& one) { return one.is_tried && !one.is_met; });
  }
};

class Tuning {
 public:
  Tuning(const TuneTask& task, const TuneEffort& effort, Progress& progress)
      : task_(task), effort_(effort), progress_(progress), units_(task, effort) {
    limiting_.push_back(0);
    for (const Axis& axis : task.tuned) {
      const double present = present_value(axis, task.series.nominal).value_or(axis.values.front());
      start_.push_back(std::clamp(position_on(axis, present), 0.0, 1.0));
      const auto [low, high] = std::minmax(axis.values.front(), axis.values.back());
      present_.push_back(std::clamp(present, low, high));
    }
    point_ = start_;
  }

  TunedDrive result() {
    Trial best;
    std::optional<TunedUnit> last_missed;
    while (rounds_ < effort_.rounds && !stopped_) {
      ProgressPart part(progress_, rounds_, effort_.rounds);
      ++rounds_;
      const Values proposed = proposal(part);
      if (stopped_ && !best.units.empty()) break;
      Trial trial = tried(proposed, part);
      const bool holds = keeps_share(trial);
      if (const std::size_t worst = trial.worst(); worst < units_.size()) {
        last_missed = unit_of(trial, worst);
      }
      const bool is_new = add_limiting(trial);
      if (best.units.empty() || is_better(trial, best)) best = std::move(trial);
      if (holds || !is_new) break;
    }
    if (!stopped_) try_the_rest(best, progress_);
    return reported(best, std::move(last_missed));
  }

 private:
  Values tuned_at(std::span<const double> point) const {
    return of_each(indices(point.size()), [&](std::size_t i) {
      return point[i] == start_[i] ? present_[i] : value_at(task_.tuned[i], point[i]);
    });
  }

  bool keeps_share(const Trial& trial) const {
    return static_cast<double>(trial.met) >=
           task_.share * static_cast<double>(trial.units.size()) * (1.0 - 1e-12);
  }

  bool is_better(const Trial& one, const Trial& other) const {
    return one.met != other.met ? one.met > other.met : units_.is_worse(other.reached, one.reached);
  }

  /// What `make` gives of each unit; nothing of those that a stop leaves out.
  template <class Make>
  auto side_by_side(const std::vector<std::size_t>& units, Progress& progress, const Make& make) {
    SharedProgress shared(progress, units.size());
    auto found = of_each_on_threads(units, [&](std::size_t unit) {
      if (shared.is_stopped()) return decltype(make(unit, progress)){};
      auto one = make(unit, shared);
      shared.finish(1);
      return one;
    });
    stopped_ = stopped_ || shared.is_stopped();
    return found;
  }

  /// Judges units with one proposal, side by side.
  std::vector<JudgedUnit> judged(const std::vector<std::size_t>& which, const Values& tuned,
                                 Progress& progress) {
    std::vector<JudgedUnit> found = side_by_side(
        which, progress,
        [&](std::size_t unit, Progress& shared) { return units_.judged(unit, tuned, shared); });
    analyses_ +=
        count_of(found, [](const JudgedUnit& one) { return one.missed_by < without_margin; });
    return found;
  }

  /// What the optimiser makes small: negative, and the aim, where all limiting units meet the
  /// target. No unit is searched where the aim is no better than with values that they permit, and
  /// no further one once some miss the target.
  std::optional<double> merit(std::span<const double> point, Progress& progress) {
    const Values tuned = tuned_at(point);
    constexpr double missed = 1000.0;
    double most_lacking = 0.0;
    std::vector<double> reached;
    for (const std::size_t unit : limiting_) {
      const JudgedLoop loop = units_.loop(unit, tuned);
      most_lacking = std::max(most_lacking, loop.lacks);
      if (most_lacking > 0.0 || units_.needs_search()) continue;
      reached.push_back(units_.reached_without_search(unit, tuned, loop, progress));
    }
    if (most_lacking > 0.0) return missed + most_lacking;
    if (!units_.needs_search() && size_of(reached) >= least_permitted_) return size_of(reached);
    reached.clear();
    for (std::size_t first = 0; first < limiting_.size(); first += at_once) {
      const std::size_t count = std::min(at_once, limiting_.size() - first);
      const auto from = limiting_.begin() + static_cast<std::ptrdiff_t>(first);
      const auto to = from + static_cast<std::ptrdiff_t>(count);
      const std::vector<JudgedUnit> found = judged({from, to}, tuned, progress);
      if (stopped_) return std::nullopt;
      const auto most = std::max_element(found.begin(), found.end(), by(&JudgedUnit::missed_by));
      if (most->missed_by > 0.0) {
        // It is tried first from now on.
        std::rotate(limiting_.begin(), from + (most - found.begin()),
                    from + (most - found.begin()) + 1);
        return missed + most->missed_by + static_cast<double>(limiting_.size() - first - count);
      }
      add_all(reached, of_each(found, &JudgedUnit::reached));
    }
    least_permitted_ = std::min(least_permitted_, size_of(reached));
    return size_of(reached);
  }

  /// Of the aim, as the optimiser makes it small, by the worst unit.
  double size_of(const std::vector<double>& reached) const {
    double worst = reached.front();
    for (const double one : reached) {
      if (units_.is_worse(one, worst)) worst = one;
    }
    constexpr double unknown = 500.0;
    if (std::isnan(worst)) return unknown;
    constexpr double least = 1e-300;
    const double size = std::log(std::max(worst, least));
    return task_.aim == Aim::bandwidth ? -size : size;
  }

  /// Values that all limiting units permit, if there are any.
  Values proposal(Progress& progress) {
    ProgressPart part(progress, 0.0, 0.6);
    double evaluated = 0.0;
    least_permitted_ = infinity;
    const auto function = [&](std::span<const double> point) {
      const double share = std::min(evaluated / (2.0 * effort_.evaluations), 1.0);
      evaluated += 1.0;
      ProgressPart at(part, share, share);
      if (!at.go_on(0.0)) stopped_ = true;
      return stopped_ ? std::nullopt : merit(point, at);
    };
    const bool has_slopes = may_have_slopes(task_);
    const CubeMinimum found = minimum_on_cube(
        function, point_,
        {.global_evaluations = rounds_ == 1 ? effort_.evaluations : effort_.evaluations / 2,
         .local_evaluations = has_slopes ? 0 : effort_.evaluations});
    point_ = found.point;
    by_slopes_ = has_slopes && !stopped_ && improves_by_slopes(found.value, part);
    if (has_slopes && !by_slopes_ && !stopped_) {
      point_ = minimum_on_cube(function, point_,
                               {.global_evaluations = 0, .local_evaluations = effort_.evaluations})
                   .point;
    }
    return tuned_at(point_);
  }

  /// Whether the last proposal, of this merit, was improved by its derivatives.
  bool improves_by_slopes(double merit_of_last, Progress& progress) {
    const auto found =
        minimum_by_slopes([&](std::span<const double> point) { return slopes(point, progress); },
                          point_, effort_.evaluations);
    if (!found || stopped_) return false;
    const std::optional<double> merit_of_found = merit(found->point, progress);
    if (!merit_of_found || !(*merit_of_found < merit_of_last)) return false;
    point_ = found->point;
    return true;
  }

  /// Of all limiting units together; empty where one has no derivatives.
  std::optional<SlopedNumbers> slopes(std::span<const double> point, Progress& progress) {
    const Values tuned = tuned_at(point);
    const auto found = side_by_side(limiting_, progress, [&](std::size_t unit, Progress& shared) {
      return slopes_of_unit(units_.drive(unit, tuned), task_, shared);
    });
    analyses_ += found.size();
    SlopedNumbers all;
    for (const std::optional<SlopedNumbers>& one : found) {
      if (!one) return std::nullopt;
      add_all(all.sizes, one->sizes);
      add_all(all.limited, one->limited);
    }
    return all;
  }

  /// Puts values to the units, until more of them miss the target than may.
  Trial tried(const Values& tuned, Progress& progress) {
    Trial trial{.tuned = tuned, .units = std::vector<JudgedUnit>(units_.size())};
    ProgressPart part(progress, 0.6, 1.0);
    constexpr std::size_t block = 8;
    const auto permitted = static_cast<std::size_t>(
        (1.0 - task_.share) * static_cast<double>(units_.size()) * (1.0 + 1e-12));
    for (std::size_t first = 0; first < units_.size() && !stopped_; first += block) {
      try_units(trial, first, std::min(first + block, units_.size()), part);
      if (trial.missed() > permitted && trial.missed() >= most_added) break;
    }
    return trial;
  }

  void try_units(Trial& trial, std::size_t from, std::size_t to, Progress& progress) {
    std::vector<std::size_t> which;
    for (std::size_t unit = from; unit < to; ++unit) {
      if (!trial.units[unit].is_tried) which.push_back(unit);
    }
    std::vector<JudgedUnit> found = judged(which, trial.tuned, progress);
    for (std::size_t i = 0; i < which.size(); ++i) {
      JudgedUnit& one = trial.units[which[i]] = std::move(found[i]);
      if (!one.is_tried) continue;  // stopped
      trial.met += one.is_met ? 1 : 0;
      const bool is_first = trial.tried++ == 0;
      if (is_first || units_.is_worse(one.reached, trial.reached)) trial.reached = one.reached;
    }
  }

  void try_the_rest(Trial& trial, Progress& progress) {
    try_units(trial, 0, units_.size(), progress);
  }

  /// Adds the units that miss the target most; false where there is none that is new.
  bool add_limiting(const Trial& trial) {
    const auto missed_by = [&](std::size_t unit) { return trial.units[unit].missed_by; };
    std::vector<std::size_t> missed = those_of(indices(trial.units.size()), [&](std::size_t unit) {
      return missed_by(unit) > 0.0 && !contains(limiting_, unit);
    });
    sort_by(missed, [&](std::size_t unit) { return -missed_by(unit); });
    if (missed.size() > most_added) missed.resize(most_added);
    add_all(limiting_, missed);
    return !missed.empty();
  }

  /// Analysed in full: until now it was only until it missed the target.
  TunedUnit unit_of(const Trial& trial, std::size_t unit) const {
    if (trial.units[unit].missed_by >= without_margin) return {units_.values(unit), {}};
    return {units_.values(unit),
            analyse(units_.drive(unit, trial.tuned), {.proofs = false}, progress_)};
  }

  TunedDrive reported(const Trial& best, std::optional<TunedUnit> last_missed) const {
    TunedDrive tuned{.values = best.tuned,
                     .drive = units_.nominal(best.tuned),
                     .meets = keeps_share(best) && !stopped_,
                     .units = best.tried,
                     .met = best.met,
                     .reached = best.reached,
                     .limiting = std::move(last_missed),
                     .by_derivatives = by_slopes_,
                     .rounds = rounds_,
                     .analyses = analyses_,
                     .stopped = stopped_};
    tuned.undecided =
        count_of(best.units, [](const JudgedUnit& one) { return !one.is_met && !one.is_known; });
    if (const std::size_t worst = best.worst(); worst < best.units.size()) {
      tuned.limiting = unit_of(best, worst);
    }
    return tuned;
  }

  static constexpr std::size_t at_once = 2;     ///< limiting units that are judged side by side
  static constexpr std::size_t most_added = 2;  ///< units that one trial makes limiting

  const TuneTask& task_;
  const TuneEffort& effort_;
  Progress& progress_;
  Units units_;
  std::vector<std::size_t> limiting_;
  Values start_;                       ///< the present values, on the unit cube
  Values present_;                     ///< ... exactly
  Values point_;                       ///< of the last proposal, on the unit cube
  double least_permitted_ = infinity;  ///< merit of values that all limiting units permit
  bool by_slopes_ = false;             ///< the last proposal
  std::size_t rounds_ = 0;
  std::size_t analyses_ = 0;
  bool stopped_ = false;
};

std::vector<Fault> faults_of_tuned(const TuneTask& task) {
  RangeCheck check;
  if (task.tuned.empty()) check.refuse("tuned", "", "must name a parameter to tune");
  std::vector<std::string_view> paths;
  for (const Axis& axis : task.tuned) {
    const std::vector<Fault> found = faults_of_axis(axis, task.series.nominal, axis.path);
    check.include(found);
    if (!found.empty()) continue;
    const Parameter* parameter = parameter_of(axis, task.series.nominal);
    if (!parameter->choices.empty()) check.refuse(axis.path, "a word", "must be a number");
    if (axis.values.size() < 2) check.refuse(axis.path, "one value", "must have two ends");
    if (contains(paths, parameter->path)) {
      check.refuse(axis.path, "twice", "must be named once");
    }
    paths.push_back(parameter->path);
    for (const ParameterTolerance& varied : task.series.varied) {
      if (varied.path != parameter->path) continue;
      check.refuse(axis.path, text_of(varied.distribution),
                   "must be exact where it is tuned: without a tolerance");
    }
  }
  return check.faults();
}

}  // namespace

std::vector<Fault> faults(const TuneTask& task, const TuneEffort& effort) {
  RangeCheck check;
  check.include(faults(task.series)).include(faults_of_tuned(task)).include(faults(task.target));
  if (!(task.share > 0.0 && task.share <= 1.0)) {
    check.refuse("share", exact_text(task.share), "must be above 0 and at most 1");
  }
  check.within("least_phase_margin", task.least_phase_margin, 0.0, 0.5 * std::numbers::pi);
  if (effort.units < 1) check.refuse("units", "0", "must be at least 1");
  if (effort.rounds < 1) check.refuse("rounds", "0", "must be at least 1");
  if (effort.evaluations < 1) check.refuse("evaluations", "0", "must be at least 1");
  return check.faults();
}

TunedDrive tune(const TuneTask& task, const TuneEffort& effort, Progress& progress) {
  require_none(faults(task, effort));
  return Tuning(task, effort, progress).result();
}

std::optional<TuneTask> without_integral_action(const TuneTask& task) {
  TuneTask without = task;
  Drive& nominal = without.series.nominal;
  if (auto* cascade = std::get_if<CascadeController>(&nominal.controller.law)) {
    if (cascade->speed_integral == 0.0) return {};
    cascade->speed_integral = 0.0;
  } else {
    const auto* pid = std::get_if<PID>(&nominal.controller.law);
    if (pid == nullptr || (pid->terms != PIDTerms::PI && pid->terms != PIDTerms::PID)) return {};
    const PIDTerms left = pid->terms == PIDTerms::PI ? PIDTerms::P : PIDTerms::PD;
    set_on({.path = "controller.kind"}, nominal, static_cast<double>(left));
  }
  const auto is_given_up = [&](const std::string& path) {
    const Parameter* parameter = parameter_of({.path = path}, nominal);
    return parameter == nullptr || parameter->path == "controller.speed_integral";
  };
  std::erase_if(without.tuned, [&](const Axis& axis) { return is_given_up(axis.path); });
  std::erase_if(without.series.varied,
                [&](const ParameterTolerance& varied) { return is_given_up(varied.path); });
  if (without.tuned.empty() || !faults(without).empty()) return {};
  return without;
}

std::optional<std::string> why_integral_action_hunts(const Drive& drive) {
  const auto* pid = std::get_if<PID>(&drive.controller.law);
  const bool integrates = pid != nullptr && pid->integral > 0.0 &&
                          (pid->terms == PIDTerms::PI || pid->terms == PIDTerms::PID);
  const auto sticks = [](const Friction& friction) {
    return friction.breakaway.value_or(friction.coulomb) > friction.coulomb;
  };
  const bool is_exact = !drive.sensor.encoder.counts_per_turn && !drive.sensor.encoder.resolution;
  if (!integrates || !is_exact || drive.controller.dead_band.width > 0.0) return std::nullopt;
  if (!sticks(drive.motor.friction) && !sticks(drive.load.friction)) return std::nullopt;
  return "Integral action always hunts where static friction exceeds Coulomb friction "
         "(Armstrong-Hélouvry and Amin, Automatica 32, 1996)";
}

}  // namespace gearlash
