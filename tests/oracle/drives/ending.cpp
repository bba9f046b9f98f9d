#include "ending.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "mechanism.hpp"

namespace gearlash::oracle {
namespace {

/// Extremes within one period of the trace: of both shafts, on a ramp from the moving reference,
/// and of a computer's torque.
struct Sample {
  Range load, motor, torque;
};

Range range_of(const std::vector<Sample>& trace, std::size_t from, std::size_t to,
               Range Sample::*what) {
  Range range = trace[from].*what;
  for (std::size_t i = from; i < to; ++i) {
    range.include((trace[i].*what).low);
    range.include((trace[i].*what).high);
  }
  return range;
}

/// Passings of the middle upwards, from below a tenth of the range under it to as much above it:
/// smaller swings are chatter. Resolved to the trace's period.
std::size_t passings_in(const std::vector<Sample>& trace, std::size_t from, Range Sample::*what,
                        const Range& range) {
  const double middle = 0.5 * (range.low + range.high);
  const double band = 0.2 * range.amplitude();
  bool is_below = false;
  std::size_t passings = 0;
  for (std::size_t i = from; i < trace.size(); ++i) {
    if (is_below && (trace[i].*what).high > middle + band) {
      ++passings;
      is_below = false;
    }
    if ((trace[i].*what).low < middle - band) is_below = true;
  }
  return passings;
}

/// s, from which on the signals have their final course.
double settling_time(const PlainDrive& drive) {
  return std::max(drive.reference_course.settling_time(), drive.load_torque_course.settling_time());
}

/// One start, carried forward; its trace grows. It runs away where it is a million gaps or encoder
/// steps from the reference, and a hundred times the start's own distance, the way in which the
/// highest torque stops it and that of the reference.
class Run {
 public:
  Run(const PlainDrive& drive, const ShaftReadings& start, const EndingOptions& options)
      : drive_(as_sampled(drive, options)),
        options_(options),
        mechanism_(drive_, start),
        computer_(drive_, start),
        period_(drive_.period > 0.0 ? drive_.period : options.trace_period),
        is_led_(drive.reference_course.moves()),
        is_loaded_(drive.load_torque_course.moves()),
        is_on_ramp_(drive.reference_course.last_rate() != 0.0),
        may_rest_(!drive.reference_course.goes_on() && !drive.load_torque_course.goes_on()),
        settled_(settling_time(drive)) {
    kept_every_ = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(options.trace_period / period_)));
    const double speed = std::max(std::abs(start.load_speed), std::abs(start.motor_speed));
    const double inertia = drive.motor.inertia + drive.load.inertia;
    const double way_to_stop = 0.5 * inertia * speed * speed / drive.limit + speed * unit_time;
    const double way_of_reference =
        drive.reference_course.size() + drive.reference_course.fastest() * unit_time;
    far_away_ =
        std::max({1e6 * drive.backlash, 1e6 * drive.step,
                  100.0 * (std::abs(start.load_position) + way_to_stop + way_of_reference)});
    forget();
  }

  void go_on(double until) {
    while (time() < until && !is_at_rest_ && !is_far_) {
      for (std::size_t i = 0; i < kept_every_; ++i) one_period();
      trace_.push_back(sample());
      mechanism_.forget_extremes();
      forget_sample();
      is_far_ = !(std::abs(error()) < far_away_);
    }
  }

  /// The trace so far.
  void forget() {
    trace_.clear();
    mechanism_.forget_extremes();
    forget_sample();
    errors_ = {error(), error()};
  }

  [[nodiscard]] bool is_at_rest() const { return is_at_rest_; }
  [[nodiscard]] bool is_far() const { return is_far_; }
  /// More of the time was left out than rounding explains.
  [[nodiscard]] bool has_gaps() const { return mechanism_.left_out() > 1e-4 * time(); }
  [[nodiscard]] double time() const { return static_cast<double>(periods_) * period_; }
  [[nodiscard]] const std::vector<Sample>& trace() const { return trace_; }
  /// From where positions of the trace count, now.
  [[nodiscard]] double origin() const { return is_on_ramp_ ? drive_.reference_at(time()) : 0.0; }
  [[nodiscard]] const ShaftReadings& shafts() const { return mechanism_.shafts(); }
  [[nodiscard]] double load_position() const {
    return mechanism_.shafts().load_position - origin();
  }
  [[nodiscard]] double motor_position() const {
    return mechanism_.shafts().motor_position - origin();
  }
  /// rad, reference less load: now, and its range since the trace was forgotten.
  [[nodiscard]] double error() const {
    return drive_.reference_at(time()) - mechanism_.shafts().load_position;
  }
  [[nodiscard]] Range errors() const { return errors_; }
  [[nodiscard]] bool is_led() const { return is_led_; }

 private:
  static PlainDrive as_sampled(PlainDrive drive, const EndingOptions& options) {
    if (drive.period == 0.0 && drive.needs_computer()) drive.period = options.longest_step;
    return drive;
  }

  [[nodiscard]] Sample sample() const {
    if (is_on_ramp_) return here_;
    return {{mechanism_.lowest_load(), mechanism_.highest_load()},
            {mechanism_.lowest_motor(), mechanism_.highest_motor()},
            here_.torque};
  }

  void forget_sample() {
    const double torque = computer_.torque();
    here_ = {
        {load_position(), load_position()}, {motor_position(), motor_position()}, {torque, torque}};
  }

  void steps_for(double from, double time, AppliedTorque torque) {
    if (time <= 0.0) return;
    const auto count = static_cast<int>(std::ceil(time / options_.longest_step * (1.0 - 1e-9)));
    const double step = time / count;
    if (is_led_ || is_loaded_) return moving_steps(from, step, count, torque);
    for (int i = 0; i < count; ++i) mechanism_.advance(step, torque);
  }

  /// Signals are those of the middle of each step.
  void moving_steps(double from, double step, int count, AppliedTorque torque) {
    for (int i = 0; i < count; ++i) {
      const double middle = from + (i + 0.5) * step;
      if (is_loaded_)
        mechanism_.set_load_torque(drive_.load_torque + drive_.load_torque_course.at(middle));
      if (torque.stiffness != 0.0)
        torque.held = torque.stiffness * drive_.reference_course.at(middle);
      mechanism_.advance(step, torque);
      if (is_led_) note(drive_.reference_at(from + (i + 1) * step));
    }
  }

  void note(double reference) {
    const ShaftReadings& now = mechanism_.shafts();
    errors_.include(reference - now.load_position);
    if (!is_on_ramp_) return;
    here_.load.include(now.load_position - reference);
    here_.motor.include(now.motor_position - reference);
  }

  void one_period() {
    const double now = time();
    ++periods_;
    const ShaftReadings before = mechanism_.shafts();
    if (drive_.period == 0.0) {
      steps_for(now, period_, {0.0, drive_.controller.proportional, drive_.controller.derivative});
      note_rest(mechanism_.shafts() == before);
      return;
    }
    computer_.sample(before, now);
    double held = 0.0;
    if (computer_.gives_out_later()) {
      held = computer_.output_after();
      apply(now, held);
      computer_.give_out();
    }
    apply(now + held, drive_.period - held);
    note_rest(mechanism_.shafts() == before && !computer_.has_changed());
  }

  void apply(double from, double time) {
    const double torque = computer_.torque();
    here_.torque.include(torque);
    steps_for(from, time, {torque});
  }

  /// All numbers as one period ago, three times, with signals at rest: for ever.
  void note_rest(bool is_same) {
    same_periods_ = is_same && may_rest_ && time() > settled_ ? same_periods_ + 1 : 0;
    if (same_periods_ >= 3) is_at_rest_ = true;
  }

  static constexpr double unit_time = 1.0;  // s, of a drive without a limit

  PlainDrive drive_;
  EndingOptions options_;
  Mechanism mechanism_;
  Computer computer_;
  double period_;
  bool is_led_, is_loaded_, is_on_ramp_, may_rest_;
  double settled_;  ///< s, when the signals are
  std::size_t periods_ = 0;
  double far_away_ = 0.0;
  std::size_t kept_every_ = 1;
  std::size_t same_periods_ = 0;
  bool is_at_rest_ = false;
  bool is_far_ = false;
  Range errors_;
  Sample here_{};  ///< of this period of the trace; of the shafts on a ramp alone
  std::vector<Sample> trace_;
};

struct Measured {
  Ending ending;
  bool is_steady = false;
  bool torque_grows = false;  ///< beyond its range of the quarter before
  double negligible = 0.0;    ///< rad, of amplitudes: a share of small lengths, or rounding
};

bool is_near(double one, double other, double share, double least) {
  return std::abs(one - other) <= std::max(share * std::max(one, other), least);
}

double sine_period(const PlainDrive& drive) {
  return std::max(drive.reference_course.period(), drive.load_torque_course.period());
}

/// By more than rounding of itself or of what holds the shafts.
bool grows(const Range& earlier, const Range& now, const PlainDrive& drive) {
  const double rounding = 1e-9 * std::max({std::abs(now.low), std::abs(now.high),
                                           drive.motor.breakaway + drive.load.breakaway});
  return now.low < earlier.low - rounding || now.high > earlier.high + rounding;
}

/// Of the last quarter and the one before it.
Measured measured(const Run& run, const PlainDrive& drive) {
  const std::vector<Sample>& trace = run.trace();
  const std::size_t quarter = trace.size() / 4;
  const std::size_t last = trace.size() - quarter;
  const auto lately = [&](Range Sample::*what) {
    return range_of(trace, last, trace.size(), what);
  };
  const auto earlier = [&](Range Sample::*what) {
    return range_of(trace, last - quarter, last, what);
  };
  Measured result;
  Ending& ending = result.ending;
  ending.amplitude = lately(&Sample::load).amplitude();
  ending.motor_amplitude = lately(&Sample::motor).amplitude();
  ending.earlier_amplitude = earlier(&Sample::load).amplitude();
  ending.earlier_motor_amplitude = earlier(&Sample::motor).amplitude();
  result.torque_grows = grows(earlier(&Sample::torque), lately(&Sample::torque), drive);
  const bool load_stands = ending.amplitude < 0.01 * ending.motor_amplitude;
  Range Sample::*const swings = load_stands ? &Sample::motor : &Sample::load;
  const std::size_t passings = passings_in(trace, last, swings, lately(swings));
  ending.frequency = static_cast<double>(passings) / (run.time() * static_cast<double>(quarter) /
                                                      static_cast<double>(trace.size()));
  ending.load_position = run.load_position();
  ending.time = run.time();
  const double least = 1e-6 * drive.small_length();
  // A sine has a few of its periods in a quarter.
  const std::size_t enough_passings = sine_period(drive) > 0.0 ? 2 : 8;
  result.negligible =
      std::max(1e-9 * drive.small_length(), 1e-12 * std::abs(run.shafts().load_position));
  result.is_steady = passings >= enough_passings && ending.motor_amplitude > result.negligible &&
                     is_near(ending.amplitude, ending.earlier_amplitude, 0.02, least) &&
                     is_near(ending.motor_amplitude, ending.earlier_motor_amplitude, 0.02, least);
  return result;
}

/// Standstill is rest only while the torque does not grow, which may still break the shafts away;
/// those that a ramp leads show it.
/// Encoders count a ramp for ever, so that what shrinks may be part of a slow beat.
bool is_fading(const Measured& found, const PlainDrive& drive) {
  const Ending& ending = found.ending;
  const double least = found.negligible;
  const bool is_on_ramp = drive.reference_course.last_rate() != 0.0;
  if (ending.motor_amplitude < least && ending.amplitude < least) {
    return (is_on_ramp || !found.torque_grows) && ending.earlier_motor_amplitude < least;
  }
  const bool is_counted = drive.step > 0.0 || (drive.speed_step > 0.0 && !drive.has_tachometer);
  if (is_counted && is_on_ramp) return false;
  const double small = 0.1 * drive.small_length();
  return ending.amplitude < small && ending.motor_amplitude < small &&
         ending.amplitude < 0.9 * ending.earlier_amplitude &&
         ending.motor_amplitude < 0.9 * ending.earlier_motor_amplitude;
}

EndKind unsteady_kind(const Measured& found, const PlainDrive& drive) {
  if (is_fading(found, drive)) return EndKind::fades;
  const Ending& ending = found.ending;
  const double growth = ending.amplitude / std::max(ending.earlier_amplitude, 1e-300);
  const double large = 1e3 * std::max(drive.backlash, drive.reference_course.size());
  if (growth > 1.3 && ending.amplitude > large) return EndKind::runs_away;
  // Irregular motion has quarters that differ a little.
  const bool is_irregular =
      is_near(ending.amplitude, ending.earlier_amplitude, 0.2, 0.0) &&
      is_near(ending.motor_amplitude, ending.earlier_motor_amplitude, 0.2, 0.0);
  const bool moves = ending.motor_amplitude > 1e-6 * drive.small_length();
  return is_irregular && moves && ending.frequency > 0.0 ? EndKind::hunts : EndKind::unclear;
}

}  // namespace

const char* name_of(EndKind kind) {
  switch (kind) {
    case EndKind::rest:
      return "rest";
    case EndKind::fades:
      return "fades";
    case EndKind::hunts:
      return "hunts";
    case EndKind::runs_away:
      return "runs away";
    case EndKind::unclear:
      break;
  }
  return "unclear";
}

void Range::include(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

Ending ending_of(const PlainDrive& drive, const ShaftReadings& start,
                 const EndingOptions& options) {
  Run run(drive, start, options);
  const double unsettled = 2.0 * settling_time(drive);  // the last half of a run has none of it
  const double longest = unsettled + std::max(options.longest_time, 48.0 * sine_period(drive));
  double until = unsettled + std::max(options.first_time, 12.0 * sine_period(drive));
  for (;; until *= 2.0) {
    run.go_on(until);
    if (run.has_gaps()) return {.kind = EndKind::unclear, .time = run.time()};
    if (run.is_at_rest() || run.is_far()) {
      Ending ending;
      ending.kind = run.is_at_rest() ? EndKind::rest : EndKind::runs_away;
      ending.load_position = run.load_position();
      ending.time = run.time();
      return ending;
    }
    Measured found = measured(run, drive);
    if (found.is_steady) {
      found.ending.kind = EndKind::hunts;
      return found.ending;
    }
    if (until >= longest || is_fading(found, drive)) {
      found.ending.kind = unsteady_kind(found, drive);
      return found.ending;
    }
  }
}

Extremes extremes_between(const PlainDrive& drive, const ShaftReadings& start, double from,
                          double until, const EndingOptions& options) {
  if (!(from >= 0.0 && until > from)) throw std::invalid_argument("0 <= from < until is needed");
  EndingOptions coarse = options;
  coarse.trace_period = std::max(options.trace_period, (until - from) / 200.0);
  Run run(drive, start, coarse);
  run.go_on(from);
  run.forget();
  run.go_on(until);
  Extremes found;
  found.load = {run.load_position(), run.load_position()};
  found.motor = {run.motor_position(), run.motor_position()};
  found.error = {run.error(), run.error()};
  found.stands = run.is_at_rest();
  found.runs_away = run.is_far();
  found.is_whole = !run.has_gaps();
  found.time = run.time();
  const std::vector<Sample>& trace = run.trace();
  if (trace.empty()) return found;
  found.load = range_of(trace, 0, trace.size(), &Sample::load);
  found.motor = range_of(trace, 0, trace.size(), &Sample::motor);
  const double reference = drive.reference;
  found.error =
      run.is_led() ? run.errors() : Range{reference - found.load.high, reference - found.load.low};
  const std::size_t last = trace.size() - (trace.size() + 9) / 10;
  const double least = 1e-6 * drive.small_length();
  const auto still = [&](Range Sample::*what) {
    return range_of(trace, last, trace.size(), what).amplitude() <= least;
  };
  found.stands = found.stands || (still(&Sample::load) && still(&Sample::motor));
  return found;
}

double error_exceeded_for(double share, const PlainDrive& drive, const ShaftReadings& start,
                          double from, double until, const EndingOptions& options) {
  EndingOptions coarse = options;
  coarse.trace_period = std::max(options.trace_period, (until - from) / 200.0);
  Run run(drive, start, coarse);
  run.go_on(from);
  constexpr std::size_t steps = 50'000;
  std::vector<double> errors;
  for (std::size_t i = 1; i <= steps; ++i) {
    run.go_on(from + (until - from) * static_cast<double>(i) / static_cast<double>(steps));
    errors.push_back(std::abs(run.error()));
  }
  const auto place = static_cast<std::ptrdiff_t>((1.0 - share) * static_cast<double>(steps));
  std::nth_element(errors.begin(), errors.begin() + place, errors.end());
  return errors[static_cast<std::size_t>(place)];
}

bool agree(const Ending& one, const Ending& other, const PlainDrive& drive, double share) {
  const auto kind_of = [](const Ending& ending) {
    return ending.kind == EndKind::fades ? EndKind::rest : ending.kind;
  };
  if (kind_of(one) != kind_of(other)) return false;
  if (one.kind != EndKind::hunts) return one.kind != EndKind::unclear;
  return is_near(one.amplitude, other.amplitude, share, drive.step) &&
         is_near(one.motor_amplitude, other.motor_amplitude, share, drive.step);
}

}  // namespace gearlash::oracle
