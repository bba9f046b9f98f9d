#include "gearlash/tune.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "analysis/design/drawn_values.hpp"
#include "analysis/design/target.hpp"
#include "analysis/design/toleranced_drive.hpp"
#include "analysis/grid/axis.hpp"
#include "analysis/linear_loop.hpp"
#include "analysis/step_response.hpp"
#include "base/on_threads.hpp"
#include "base/progress_part.hpp"
#include "base/range_check.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/parameter.hpp"
#include "model/reduced_drive.hpp"
#include "numeric/box_minimum.hpp"

namespace gearlash {
namespace {

using Values = std::vector<double>;

// How far a unit misses, in an order that leads the optimiser: an unsound drive, a linear loop
// without the margin, and then by how much the target is missed.
constexpr double unsound = 100.0;
constexpr double without_margin = 50.0;
constexpr double most_missed = 40.0;

struct JudgedUnit {
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
  return std::clamp(excess(target, answer), 0.0, most_missed - 1.0) + share;
}

/// The units of a series with tuned values.
class Units {
 public:
  Units(const TuneTask& task, const TuneEffort& effort) : task_(task) {
    add(means_of(task.series));
    const std::size_t width = task.series.varied.size();
    if (width == 0) return;
    add_corners(effort.units);
    if (effort.units <= all_.size()) return;
    const SamplePlan plan{
        .points = effort.units - all_.size(), .replicates = 2, .seed = effort.seed};
    const Values drawn = detail::DrawnValues(task.series, plan, 1).of({0, 0, 0, plan.points});
    for (std::size_t i = 0; i < drawn.size(); i += width) {
      add({drawn.begin() + static_cast<std::ptrdiff_t>(i),
           drawn.begin() + static_cast<std::ptrdiff_t>(i + width)});
    }
  }

  std::size_t size() const { return all_.size(); }
  const Values& values(std::size_t unit) const { return all_[unit]; }

  Drive nominal(const Values& tuned) const {
    Drive drive = task_.series.nominal;
    for (std::size_t i = 0; i < tuned.size(); ++i) set_on(task_.tuned[i], drive, tuned[i]);
    return drive;
  }

  Drive drive(std::size_t unit, const Values& tuned) const {
    return searched_drive_with({nominal(tuned), task_.series.varied}, all_[unit]);
  }

  /// Without a search: how far the drive is from one that is worth it; 0 if it is.
  double lacks(std::size_t unit, const Values& tuned) const {
    const Drive drive = this->drive(unit, tuned);
    if (!faults(drive).empty()) return unsound;
    const auto loop = drive::loop_figures(reduce(drive));
    if (!loop) return 0.0;  // of a relay
    if (!loop->is_stable) return without_margin + 1.0;
    const double margin = loop->phase_margin.value_or(infinity);
    return margin >= task_.least_phase_margin
               ? 0.0
               : without_margin + (task_.least_phase_margin - margin) / std::numbers::pi;
  }

  JudgedUnit judged(std::size_t unit, const Values& tuned, Progress& progress) const {
    JudgedUnit judged{.missed_by = lacks(unit, tuned)};
    if (judged.missed_by > 0.0) return judged;
    const Drive drive = this->drive(unit, tuned);
    judged.answer =
        analyse(drive, {.proofs = false, .ceiling = asks_for_ceiling(task_.target)}, progress);
    judged.is_met = is_met(task_.target, judged.answer);
    judged.is_known = is_known(task_.target, judged.answer);
    if (!judged.is_met) {
      judged.missed_by = missed_by(task_.target, judged.answer, drive.gearbox.backlash);
    }
    judged.reached = reached(drive, judged.answer);
    return judged;
  }

  /// Whether one reached less of the aim than another. An unknown number is the worst.
  bool is_worse(double one, double other) const {
    if (std::isnan(one) || std::isnan(other)) return std::isnan(one) && !std::isnan(other);
    return task_.aim == Aim::bandwidth ? one < other : one > other;
  }

 private:
  void add(Values values) { all_.push_back(std::move(values)); }

  void add_corners(std::size_t most) {
    constexpr std::size_t most_corners = 16;
    const std::size_t width = task_.series.varied.size();
    if (width > 4 || (std::size_t{1} << width) > std::min(most_corners, most)) return;
    for (std::size_t corner = 0; corner < std::size_t{1} << width; ++corner) {
      Values values;
      for (std::size_t i = 0; i < width; ++i) {
        const Bounds range = three_sigma_range_of(task_.series.varied[i].distribution);
        values.push_back((corner >> i & 1U) != 0 ? range.high : range.low);
      }
      add(std::move(values));
    }
  }

  double reached(const Drive& drive, const Answer& answer) const {
    const drive::ReducedDrive reduced = reduce(drive);
    if (task_.aim == Aim::static_error) {
      return answer.value(Quantity::static_error).value_or(not_a_number);
    }
    if (task_.aim == Aim::settling) {
      const drive::Step step = drive::usual_step(reduced);
      return drive::step_response(reduced, step.size, step.until).settling_time;
    }
    const auto loop = drive::loop_figures(reduced);
    return loop && loop->bandwidth ? *loop->bandwidth : not_a_number;
  }

  const TuneTask& task_;
  std::vector<Values> all_;
};

/// The values of all units with one proposal.
struct Trial {
  Values tuned{};
  std::vector<JudgedUnit> units{};
  std::size_t met = 0;
  double reached = not_a_number;

  /// The unit that misses the target most; size() where none does.
  std::size_t worst() const {
    const auto most = std::max_element(
        units.begin(), units.end(),
        [](const JudgedUnit& a, const JudgedUnit& b) { return a.missed_by < b.missed_by; });
    return most == units.end() || most->is_met ? units.size()
                                               : static_cast<std::size_t>(most - units.begin());
  }
};

class Tuning {
 public:
  Tuning(const TuneTask& task, const TuneEffort& effort, Progress& progress)
      : task_(task), effort_(effort), progress_(progress), units_(task, effort) {
    limiting_.push_back(0);
    for (const Axis& axis : task.tuned) {
      const double present = present_value(axis, task.series.nominal).value_or(axis.values.front());
      point_.push_back(std::clamp(position_on(axis, present), 0.0, 1.0));
    }
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
    return reported(best, std::move(last_missed));
  }

 private:
  Values tuned_at(std::span<const double> point) const {
    Values tuned;
    for (std::size_t i = 0; i < point.size(); ++i) {
      tuned.push_back(value_at(task_.tuned[i], point[i]));
    }
    return tuned;
  }

  bool keeps_share(const Trial& trial) const {
    return static_cast<double>(trial.met) >=
           task_.share * static_cast<double>(trial.units.size()) * (1.0 - 1e-12);
  }

  bool is_better(const Trial& one, const Trial& other) const {
    return one.met != other.met ? one.met > other.met : units_.is_worse(other.reached, one.reached);
  }

  /// Judges units with one proposal, side by side.
  std::vector<JudgedUnit> judged(const std::vector<std::size_t>& which, const Values& tuned,
                                 Progress& progress) {
    std::vector<JudgedUnit> found(which.size());
    SharedProgress shared(progress, which.size());
    on_threads(0, which.size(), [&](std::size_t i) {
      if (shared.is_stopped()) return;
      found[i] = units_.judged(which[i], tuned, shared);
      shared.finish(1);
    });
    stopped_ = stopped_ || shared.is_stopped();
    analyses_ += static_cast<std::size_t>(
        std::count_if(found.begin(), found.end(),
                      [](const JudgedUnit& one) { return one.missed_by < without_margin; }));
    return found;
  }

  /// What the optimiser makes small: negative, and the aim, where all limiting units meet the
  /// target.
  std::optional<double> merit(std::span<const double> point, Progress& progress) {
    const Values tuned = tuned_at(point);
    constexpr double missed = 1000.0;
    double most_lacking = 0.0;
    for (const std::size_t unit : limiting_) {
      most_lacking = std::max(most_lacking, units_.lacks(unit, tuned));
    }
    if (most_lacking > 0.0) return missed + most_lacking;
    const std::vector<JudgedUnit> found = judged(limiting_, tuned, progress);
    if (stopped_) return std::nullopt;
    double most = 0.0;
    double worst = found.front().reached;
    for (const JudgedUnit& one : found) {
      if (!one.is_met) most = std::max(most, one.missed_by);
      if (units_.is_worse(one.reached, worst)) worst = one.reached;
    }
    if (most > 0.0) return missed + most;
    if (std::isnan(worst)) return 0.5 * missed;
    constexpr double least = 1e-300;
    const double size = std::log(std::max(worst, least));
    return task_.aim == Aim::bandwidth ? -size : size;
  }

  /// Values that all limiting units permit, if there are any.
  Values proposal(Progress& progress) {
    ProgressPart part(progress, 0.0, 0.6);
    double evaluated = 0.0;
    const auto function = [&](std::span<const double> point) {
      const double share = std::min(evaluated / (2.0 * effort_.evaluations), 1.0);
      evaluated += 1.0;
      ProgressPart at(part, share, share);
      if (!at.go_on(0.0)) stopped_ = true;
      return stopped_ ? std::nullopt : merit(point, at);
    };
    const CubeMinimum found = minimum_on_cube(
        function, point_,
        {.global_evaluations = rounds_ == 1 ? effort_.evaluations : effort_.evaluations / 2,
         .local_evaluations = effort_.evaluations});
    point_ = found.point;
    return tuned_at(point_);
  }

  Trial tried(const Values& tuned, Progress& progress) {
    ProgressPart part(progress, 0.6, 1.0);
    std::vector<std::size_t> all(units_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    Trial trial{.tuned = tuned, .units = judged(all, tuned, part)};
    trial.reached = trial.units.front().reached;
    for (const JudgedUnit& one : trial.units) {
      trial.met += one.is_met ? 1 : 0;
      if (units_.is_worse(one.reached, trial.reached)) trial.reached = one.reached;
    }
    return trial;
  }

  /// Adds the units that miss the target most; false where there is none that is new.
  bool add_limiting(const Trial& trial) {
    constexpr std::size_t most_added = 2;
    std::vector<std::size_t> missed;
    for (std::size_t unit = 0; unit < trial.units.size(); ++unit) {
      const bool is_known = std::find(limiting_.begin(), limiting_.end(), unit) != limiting_.end();
      if (!trial.units[unit].is_met && !is_known) missed.push_back(unit);
    }
    std::stable_sort(missed.begin(), missed.end(), [&](std::size_t a, std::size_t b) {
      return trial.units[a].missed_by > trial.units[b].missed_by;
    });
    if (missed.size() > most_added) missed.resize(most_added);
    limiting_.insert(limiting_.end(), missed.begin(), missed.end());
    return !missed.empty();
  }

  TunedUnit unit_of(const Trial& trial, std::size_t unit) const {
    return {units_.values(unit), trial.units[unit].answer};
  }

  TunedDrive reported(const Trial& best, std::optional<TunedUnit> last_missed) const {
    TunedDrive tuned{.values = best.tuned,
                     .drive = units_.nominal(best.tuned),
                     .meets = keeps_share(best) && !stopped_,
                     .units = best.units.size(),
                     .met = best.met,
                     .reached = best.reached,
                     .limiting = std::move(last_missed),
                     .rounds = rounds_,
                     .analyses = analyses_,
                     .stopped = stopped_};
    for (const JudgedUnit& one : best.units) {
      tuned.undecided += !one.is_met && !one.is_known ? 1 : 0;
    }
    if (const std::size_t worst = best.worst(); worst < best.units.size()) {
      tuned.limiting = unit_of(best, worst);
    }
    return tuned;
  }

  const TuneTask& task_;
  const TuneEffort& effort_;
  Progress& progress_;
  Units units_;
  std::vector<std::size_t> limiting_;
  Values point_;  ///< of the last proposal, on the unit cube
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
    if (std::find(paths.begin(), paths.end(), parameter->path) != paths.end()) {
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
  const auto* pid = std::get_if<PID>(&nominal.controller.law);
  if (pid == nullptr || (pid->terms != PIDTerms::PI && pid->terms != PIDTerms::PID)) return {};
  const PIDTerms left = pid->terms == PIDTerms::PI ? PIDTerms::P : PIDTerms::PD;
  set_on({.path = "controller.kind"}, nominal, static_cast<double>(left));
  std::erase_if(without.tuned,
                [&](const Axis& axis) { return parameter_of(axis, nominal) == nullptr; });
  std::erase_if(without.series.varied, [&](const ParameterTolerance& varied) {
    return parameter_of({.path = varied.path}, nominal) == nullptr;
  });
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
