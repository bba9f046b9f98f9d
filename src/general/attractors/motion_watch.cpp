#include "general/attractors/motion_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "hybrid/guard_form.hpp"

namespace gearlash::drive {

namespace {

void include(std::vector<Extent>& all, const hybrid::Vector& low, const hybrid::Vector& high) {
  all.resize(static_cast<std::size_t>(low.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].include(low[static_cast<Eigen::Index>(i)]);
    all[i].include(high[static_cast<Eigen::Index>(i)]);
  }
}

/// The range of every number.
struct Ranges {
  hybrid::Vector low;
  hybrid::Vector high;

  explicit Ranges(Eigen::Index size) : low(hybrid::Vector::Constant(size, infinity)), high(-low) {}
  void add(const hybrid::Vector& numbers) {
    low = low.cwiseMin(numbers);
    high = high.cwiseMax(numbers);
  }
};

/// Keeps the first value of a number, its turns, both ends of its pauses and its last value.
class Turns {
 public:
  Turns(const Watched& watched, std::vector<Sample>& kept)
      : value_(watched.value), speed_(watched.speed), kept_(kept) {}

  void moved(double from, double to, const hybrid::Vector& before, const hybrid::Vector& after) {
    const double value = value_.at(before.data());
    add({from, value});
    const double speed = speed_.at(before.data());
    const double next_speed = speed_.at(after.data());
    const double next = value_.at(after.data());
    if (speed * next_speed < 0.0) add(turn({from, value}, speed, {to, next}, next_speed));
    add({to, next});
  }

  void end() {
    if (!is_first_) kept_.push_back(last_);
  }

 private:
  /// Where the cubic through two samples with their speeds turns. Precondition: the speeds have
  /// different signs.
  static Sample turn(const Sample& start, double speed, const Sample& end, double end_speed) {
    const double length = end.time - start.time;
    const double rise = end.value - start.value;
    const double a = length * speed;
    const double b = length * end_speed;
    // value(s) = start + a s + c s² + d s³, with s from 0 to 1
    const double c = 3.0 * rise - 2.0 * a - b;
    const double d = a + b - 2.0 * rise;
    const double root = std::sqrt(std::max(0.0, c * c - 3.0 * a * d));
    const double s = a / (-c + std::copysign(root, a));  // the zero of a + 2cs + 3ds² in [0, 1]
    if (!(s >= 0.0 && s <= 1.0)) return start;
    return {start.time + s * length, start.value + s * (a + s * (c + s * d))};
  }

  void add(const Sample& sample) {
    if (is_first_) {
      is_first_ = false;
      kept_.push_back(sample);
    } else if (sample.value != last_.value) {
      const double way = sample.value > last_.value ? 1.0 : -1.0;
      if (way_ * way < 0.0 || is_paused_) kept_.push_back(last_);
      way_ = way;
      is_paused_ = false;
    } else if (!is_paused_ && sample.time > last_.time) {
      kept_.push_back(last_);
      is_paused_ = true;
    }
    last_ = sample;
  }

  hybrid::SparseForm value_;
  hybrid::SparseForm speed_;
  std::vector<Sample>& kept_;
  bool is_first_ = true;
  Sample last_;
  double way_ = 0.0;
  bool is_paused_ = false;
};

/// All numbers at even phases of a sine, in the last two periods.
class CourseWatch {
 public:
  CourseWatch(double from, const SearchSetting& setting)
      : setting_(setting), every_(setting.common_sine / static_cast<double>(phases)) {
    if (every_ > 0.0) next_ = static_cast<std::size_t>(std::ceil(from / every_));
  }

  void moved(double from, double to, const hybrid::Vector& before, const hybrid::Vector& after) {
    if (!(every_ > 0.0)) return;
    for (; time() <= to; ++next_, ++count_) {
      const double share = to > from ? std::max(0.0, (time() - from) / (to - from)) : 1.0;
      numbers_[next_ % numbers_.size()] = before + share * (after - before);
    }
  }

  /// Of the last period, or of the one `earlier`.
  Course course(std::size_t earlier) const {
    const std::size_t back = (earlier + 1) * phases;
    if (count_ < back) return {};
    Course course{.positions = std::vector<double>(2 * phases)};
    std::vector<Extent> ranges(static_cast<std::size_t>(setting_.own));
    course.means.resize(ranges.size());
    for (std::size_t i = next_ - back; i < next_ - back + phases; ++i) {
      const hybrid::Vector& here = numbers_[i % numbers_.size()];
      course.positions[2 * (i % phases)] = setting_.load.value.at(here);
      course.positions[2 * (i % phases) + 1] = setting_.motor.value.at(here);
      for (std::size_t n = 0; n < ranges.size(); ++n) {
        ranges[n].include(here[static_cast<Eigen::Index>(n)]);
        course.means[n] += here[static_cast<Eigen::Index>(n)] / static_cast<double>(phases);
      }
    }
    for (const Extent& range : ranges) course.widths.push_back(range.width());
    return course;
  }

 private:
  static constexpr std::size_t phases = 32;

  double time() const { return static_cast<double>(next_) * every_; }

  const SearchSetting& setting_;
  double every_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::array<hybrid::Vector, 2 * phases> numbers_{};
};

class StretchObserver : public hybrid::MotionObserver {
 public:
  StretchObserver(Watch& watch, double until, const SearchSetting& setting)
      : middle_(0.5 * (watch.time + until)),
        all_(watch.here.numbers.size()),
        last_(all_),
        course_(watch.time, setting),
        load_(setting.load, watch.load),
        motor_(setting.motor, watch.motor),
        speeds_{setting.load.speed, setting.motor.speed} {
    if (setting.error) error_.emplace(*setting.error, watch.error);
  }

  const std::vector<hybrid::AffineForm>& watched() const override { return speeds_; }

  void moved(double from, double to, const hybrid::Vector& before,
             const hybrid::Vector& after) override {
    all_.add(before);
    all_.add(after);
    if (to > middle_) {
      last_.add(before);
      last_.add(after);
      is_in_last_ = true;
    }
    course_.moved(from, to, before, after);
    load_.moved(from, to, before, after);
    motor_.moved(from, to, before, after);
    if (error_) error_->moved(from, to, before, after);
  }

  void end(Watch& watch, Stretch& stretch) {
    load_.end();
    motor_.end();
    if (error_) error_->end();
    include(watch.all, all_.low, all_.high);
    if (is_in_last_) include(stretch.last, last_.low, last_.high);
    stretch.course = course_.course(0);
    stretch.course_before = course_.course(1);
  }

 private:
  double middle_;
  Ranges all_;
  Ranges last_;
  bool is_in_last_ = false;
  CourseWatch course_;
  Turns load_;
  Turns motor_;
  std::optional<Turns> error_;
  std::vector<hybrid::AffineForm> speeds_;
};

Stretch begun(Watch& watch) {
  watch.marks.push_back({watch.time, watch.here});
  Stretch stretch;
  stretch.from = watch.time;
  return stretch;
}

/// To the end of the stretch.
void move_on(Watch& watch, const Stretch& stretch) {
  watch.time = stretch.time;
  watch.events += stretch.events;
  watch.here = stretch.end;
}

/// Time between any two successive samples of one of both shafts, each counted up to `longest`.
double busy_time(const std::vector<Sample>& load, const std::vector<Sample>& motor,
                 double longest) {
  double sum = 0.0;
  double last = load.front().time;
  for (std::size_t i = 0, j = 0; i < load.size() || j < motor.size();) {
    const bool is_of_load = j == motor.size() || (i < load.size() && load[i].time < motor[j].time);
    const double next = is_of_load ? load[i++].time : motor[j++].time;
    sum += std::min(next - last, longest);
    last = next;
  }
  return sum;
}

}  // namespace

Stretch follow(Watch& watch, double until, std::size_t step_limit, std::size_t event_limit,
               const SearchSetting& setting, const SearchBudget& budget) {
  Stretch stretch = begun(watch);
  stretch.motion = simulate(setting.system, watch.here,
                            {.from = watch.time,
                             .until = until,
                             .event_limit = event_limit,
                             .step_limit = step_limit,
                             .progress = watch.progress});
  const hybrid::Trajectory& motion = *stretch.motion;
  static_cast<hybrid::Observed&>(stretch) = {motion.end_time(), motion.end(), motion.stop_reason(),
                                             motion.culprit(), motion.events().size()};
  const std::vector<Extent> all = extents(motion, motion.start_time());
  if (watch.all.empty()) watch.all = all;
  for (std::size_t i = 0; i < all.size(); ++i) watch.all[i].include(all[i]);
  stretch.last = extents(motion, 0.5 * (motion.start_time() + motion.end_time()));
  const std::vector<Sample> load = rough_samples(motion, setting.load);
  const std::vector<Sample> motor = rough_samples(motion, setting.motor);
  add_all(watch.load, load);
  add_all(watch.motor, motor);
  if (setting.error) add_all(watch.error, rough_samples(motion, *setting.error));
  watch.busy += busy_time(load, motor, budget.counted_between_events * setting.swing_time);
  move_on(watch, stretch);
  return stretch;
}

Stretch observe(Watch& watch, double until, std::size_t event_limit, const SearchSetting& setting) {
  Stretch stretch = begun(watch);
  StretchObserver observer(watch, until, setting);
  static_cast<hybrid::Observed&>(stretch) = observe(
      setting.system, watch.here,
      {.from = watch.time, .until = until, .event_limit = event_limit, .progress = watch.progress},
      observer);
  observer.end(watch, stretch);
  move_on(watch, stretch);
  return stretch;
}

std::optional<double> longest_move(const hybrid::Trajectory& motion, const SearchSetting& setting) {
  std::optional<double> middle;
  double longest = 0.0;
  double from = motion.start_time();
  for (const hybrid::Event& event : motion.events()) {
    const DriveMode mode = setting.built.modes.mode(event.mode);
    const bool moves =
        mode.motor != FrictionState::sticking || mode.load != FrictionState::sticking;
    if (moves && event.time - from > longest) {
      longest = event.time - from;
      middle = 0.5 * (from + event.time);
    }
    from = event.time;
  }
  return middle;
}

namespace {

/// Whether the shafts' motion, or whether the mode ends, depends on a number at once.
bool acts(const hybrid::AffineMode& mode, Eigen::Index number) {
  if (number <= load_speed) return true;
  const auto moves = [&](Eigen::Index shaft) { return mode.flow.matrix(shaft, number) != 0.0; };
  return moves(motor_speed) || moves(load_speed) ||
         any_of(mode.transitions,
                [&](const hybrid::Transition& one) { return one.guard.normal[number] != 0.0; });
}

/// Whether all numbers that act at once change by at most a share of their total movement.
template <class Change>
bool hardly_changes(const Watch& watch, const SearchSetting& setting,
                    const RestTolerances& tolerances, Change&& change) {
  const hybrid::AffineMode& mode = setting.system.system().mode(watch.here.mode);
  const hybrid::Vector& scale = setting.frame.scale;
  const double positions =
      std::max({watch.all[motor_position].width(), watch.all[load_position].width(),
                setting.drive.backlash / scale[load_position]});
  const double speeds =
      std::max({watch.all[motor_speed].width(), watch.all[load_speed].width(),
                positions * scale[load_position] / (scale[load_speed] * setting.swing_time)});
  for (std::size_t i = 0; i < static_cast<std::size_t>(setting.own); ++i) {
    const bool is_position = i == motor_position || i == load_position;
    const bool is_speed = i == motor_speed || i == load_speed;
    const double extent = is_position ? positions : is_speed ? speeds : watch.all[i].width();
    if (change(i) > tolerances.still * extent && acts(mode, static_cast<Eigen::Index>(i)))
      return false;
  }
  return true;
}

bool trembles_at_rest(const Watch& watch, const SearchSetting& setting,
                      const RestTolerances& tolerances) {
  const hybrid::AffineFlow& flow = setting.system.system().mode(watch.here.mode).flow;
  const hybrid::Vector velocity = flow.velocity(watch.here.numbers);
  return hardly_changes(watch, setting, tolerances, [&](std::size_t i) {
    return std::abs(velocity[static_cast<Eigen::Index>(i)]) * setting.swing_time;
  });
}

}  // namespace

bool is_endless(const Stretch& stretch) {
  return stretch.stop_reason == hybrid::StopReason::zeno ||
         stretch.stop_reason == hybrid::StopReason::chattering;
}

bool is_at_rest(const Watch& watch, const Stretch& stretch, const SearchSetting& setting,
                const RestTolerances& tolerances) {
  if (is_endless(stretch)) return trembles_at_rest(watch, setting, tolerances);
  const std::vector<Extent>& last = stretch.last;
  return !last.empty() &&
         hardly_changes(watch, setting, tolerances, [&](std::size_t i) { return last[i].width(); });
}

bool moves_along(const Watch& watch, const Stretch& stretch, const SearchSetting& setting,
                 const RestTolerances& tolerances) {
  const auto hardly_moves = [&](const std::vector<Sample>& samples) {
    const double all = std::max(extent_of(samples).width(), setting.small_length);
    return extent_of(after(samples, stretch.from)).width() <= tolerances.still * all;
  };
  return setting.coordinates == Coordinates::in_place && hardly_moves(watch.load) &&
         hardly_moves(watch.motor);
}

namespace {

/// rad: a load beyond it has run away.
double far_away(const SearchSetting& setting, const SearchTolerances& tolerances) {
  const double far = tolerances.far_away * setting.large_length;
  if (!std::isfinite(setting.farthest_length)) return far;
  return std::max(far, tolerances.far_grown * setting.farthest_length);
}

bool is_far(const Watch& watch, const std::vector<Sample>& turns, const SearchSetting& setting,
            const SearchTolerances& tolerances) {
  const double away = std::abs(setting.load.value.at(watch.here.numbers));
  if (!(away > far_away(setting, tolerances))) return false;
  // Without a way back it is no swing.
  constexpr double beyond = 2.0;
  const bool swings = any_of(turns, [&](const Sample& turn) {
    return beyond * std::abs(turn.value) > away && turn.time < watch.time;
  });
  return away > setting.braked_length || !swings;
}

bool grows_away(const std::vector<Sample>& turns, const SearchSetting& setting,
                const SearchTolerances& tolerances) {
  const std::size_t count = tolerances.growing_swings;
  if (turns.size() < count + 2) return false;
  const double far =
      std::max(tolerances.far_grown * setting.farthest_length, setting.braked_length);
  if (!(swing(turns, 0) > far)) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const double growth = swing(turns, i) - swing(turns, i + 1);
    if (!(growth > 0.0)) return false;
    const bool has_before = i + 1 < count;
    const double before = has_before ? swing(turns, i + 1) - swing(turns, i + 2) : 0.0;
    if (!(growth >= tolerances.steady_growth * before)) return false;
  }
  return true;
}

}  // namespace

bool has_run_away(const Watch& watch, const SearchSetting& setting,
                  const SearchTolerances& tolerances) {
  const std::vector<Sample> turns = extremes(watch.load);
  return is_far(watch, turns, setting, tolerances) || grows_away(turns, setting, tolerances);
}

void add_rest(RestFound& rest, double load, double motor, const SearchSetting& setting,
              const RestTolerances& tolerances) {
  const auto place = [&](double value) {
    return std::abs(value) > tolerances.no_move * setting.small_length ? value : 0.0;
  };
  const bool has_image = is_own_image(setting.drive);
  for (const double way : {1.0, -1.0}) {
    if (way < 0.0 && !has_image) break;
    rest.load.include(way * place(load) + 0.0);  // no −0
    rest.error.include(-way * place(load) + 0.0);
    rest.motor.include(way * place(motor) + 0.0);
  }
}

std::size_t count_of_swings(const std::vector<Sample>& turns, double from,
                            const SearchSetting& setting, const RestTolerances& tolerances) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const double size = std::abs(turns[i].value - turns[i - 1].value);
    if (turns[i].time > from && size > tolerances.negligible_swing * setting.small_length) ++count;
  }
  return count;
}

double swing(const std::vector<Sample>& turns, std::size_t from_last) {
  const std::size_t last = turns.size() - 1 - from_last;
  return std::abs(turns[last].value - turns[last - 1].value);
}

bool is_small(const std::vector<Sample>& turns, const SearchSetting& setting,
              const RestTolerances& tolerances) {
  return turns.size() > 2 && swing(turns, 0) < tolerances.small_swing * setting.small_length &&
         swing(turns, 0) < swing(turns, 1);
}

std::vector<Sample> turns_of(const Watch& watch, const SearchSetting& setting,
                             const RestTolerances& tolerances) {
  std::vector<Sample> turns = extremes(watch.load);
  if (watch.starts_at_rest) turns.insert(turns.begin(), watch.load.front());
  const double speed = std::abs(setting.load.speed.at(watch.here.numbers));
  const double swing_so_far =
      turns.empty() ? 0.0 : std::abs(watch.load.back().value - turns.back().value);
  if (speed * setting.swing_time < tolerances.standing_speed * swing_so_far) {
    turns.push_back(watch.load.back());
  }
  return turns;
}

double limit_of(double first, double second, double third) {
  const double last_step = third - second;
  return third - last_step * last_step / (last_step - (second - first));
}

namespace {

/// With the last swing and its ratio to the one before, and both durations.
ShrinkingSteps last_steps(const std::vector<Sample>& turns) {
  const Sample* last = &turns.back();
  const double before = (last - 1)->time - (last - 2)->time;
  const double duration = last->time - (last - 1)->time;
  return {.final = 0.5 * (last->value + (last - 1)->value),
          .size = 0.5 * swing(turns, 0),
          .ratio = swing(turns, 0) / swing(turns, 1),
          .duration = duration,
          .duration_ratio = duration / before};
}

/// By one ratio: Aitken's extrapolation of any three gives 0.
bool shrink_by_one_ratio(const std::vector<Sample>& turns, const RestTolerances& tolerances) {
  for (std::size_t count = 2; count < turns.size(); ++count) {
    const double first = swing(turns, count - 1);
    const double second = swing(turns, count - 2);
    if (!(second < first)) return false;
    if (count > 2) {
      const double third = swing(turns, count - 3);
      const double limit = limit_of(first, second, third);
      if (!(third < second) || !(std::abs(limit) < tolerances.vanishing_limit * third)) {
        return false;
      }
    }
    if (count >= tolerances.vanishing_swings ||
        swing(turns, 0) < tolerances.vanishing_fast * first) {
      return true;
    }
  }
  return false;
}

/// By ratios that scatter, as the ticks of a clock fall: each below 1, and their mean logarithm
/// below 0 by a multiple of its standard error.
bool shrink_on_average(const std::vector<Sample>& turns, const RestTolerances& tolerances) {
  const std::size_t count = tolerances.scattering_swings;
  if (turns.size() < count + 2) return false;
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < count; ++i) {
    logarithms.push_back(std::log(swing(turns, i) / swing(turns, i + 1)));
    if (!(logarithms.back() < 0.0)) return false;
  }
  const Spread spread = spread_of(logarithms);
  return spread.mean + tolerances.scattering_errors * spread.deviation /
                           std::sqrt(static_cast<double>(count)) <
         0.0;
}

/// Whether small motion has no size but its own: nothing but the gap, which it does not fill, tells
/// a swing from one half as large.
bool has_no_small_size(const ReducedDrive& drive) {
  return !has_dry_friction(drive) && !drive.sensing.reads_steps() &&
         !drive.error_shape.changes_small_errors() && is_mirrored(drive);
}

}  // namespace

std::optional<ShrinkingSteps> vanishing_swings(const std::vector<Sample>& turns,
                                               const SearchSetting& setting,
                                               const RestTolerances& tolerances) {
  if (!has_no_small_size(setting.drive) || !is_small(turns, setting, tolerances)) {
    return std::nullopt;
  }
  const bool is_clocked = setting.drive.sampling.has_value();
  if (!shrink_by_one_ratio(turns, tolerances) &&
      !(is_clocked && shrink_on_average(turns, tolerances))) {
    return std::nullopt;
  }
  return last_steps(turns);
}

}  // namespace gearlash::drive
