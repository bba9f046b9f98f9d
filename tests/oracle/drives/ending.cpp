#include "ending.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanism.hpp"

namespace gearlash::oracle {
namespace {

/// Extremes of both shafts within one period of the trace.
struct Sample {
  double lowest_load, highest_load, lowest_motor, highest_motor;
};

struct Range {
  double low = 0.0, high = 0.0;
  [[nodiscard]] double amplitude() const { return 0.5 * (high - low); }
};

Range range_of(const std::vector<Sample>& trace, std::size_t from, std::size_t to,
               double Sample::*low, double Sample::*high) {
  Range range{trace[from].*low, trace[from].*high};
  for (std::size_t i = from; i < to; ++i) {
    range.low = std::min(range.low, trace[i].*low);
    range.high = std::max(range.high, trace[i].*high);
  }
  return range;
}

/// Passings of the middle upwards, from below a tenth of the range under it to as much above it:
/// smaller swings are chatter. Resolved to the trace's period.
std::size_t passings_in(const std::vector<Sample>& trace, std::size_t from, double Sample::*low,
                        double Sample::*high, const Range& range) {
  const double middle = 0.5 * (range.low + range.high);
  const double band = 0.2 * range.amplitude();
  bool is_below = false;
  std::size_t passings = 0;
  for (std::size_t i = from; i < trace.size(); ++i) {
    if (is_below && trace[i].*high > middle + band) {
      ++passings;
      is_below = false;
    }
    if (trace[i].*low < middle - band) is_below = true;
  }
  return passings;
}

/// One start, carried forward; its trace grows. It runs away where it is a million gaps or encoder
/// steps from the reference, and a hundred times the start's own distance and the way in which the
/// highest torque stops it.
class Run {
 public:
  Run(const PlainDrive& drive, const ShaftReadings& start, const EndingOptions& options)
      : drive_(as_sampled(drive, options)),
        options_(options),
        mechanism_(drive_, start),
        computer_(drive_, start),
        last_(computer_),
        period_(drive_.period > 0.0 ? drive_.period : options.trace_period) {
    kept_every_ = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(options.trace_period / period_)));
    const double speed = std::max(std::abs(start.load_speed), std::abs(start.motor_speed));
    const double inertia = drive.motor.inertia + drive.load.inertia;
    const double way_to_stop = 0.5 * inertia * speed * speed / drive.limit + speed * unit_time;
    far_away_ = std::max({1e6 * drive.backlash, 1e6 * drive.step,
                          100.0 * (std::abs(start.load_position) + way_to_stop)});
  }

  void go_on(double until) {
    const double trace = period_ * static_cast<double>(kept_every_);
    while (time() < until && !is_at_rest_ && !is_far_) {
      for (std::size_t i = 0; i < kept_every_; ++i) one_period();
      trace_.push_back({mechanism_.lowest_load(), mechanism_.highest_load(),
                        mechanism_.lowest_motor(), mechanism_.highest_motor()});
      mechanism_.forget_extremes();
      elapsed_ += trace;
      const double away = std::abs(mechanism_.shafts().load_position - drive_.reference);
      is_far_ = !(away < far_away_);
    }
  }

  [[nodiscard]] bool is_at_rest() const { return is_at_rest_; }
  [[nodiscard]] bool is_far() const { return is_far_; }
  /// More of the time was left out than rounding explains.
  [[nodiscard]] bool has_gaps() const { return mechanism_.left_out() > 1e-4 * elapsed_; }
  [[nodiscard]] double time() const { return elapsed_; }
  [[nodiscard]] const std::vector<Sample>& trace() const { return trace_; }
  [[nodiscard]] const ShaftReadings& shafts() const { return mechanism_.shafts(); }

 private:
  static PlainDrive as_sampled(PlainDrive drive, const EndingOptions& options) {
    if (drive.period == 0.0 && drive.has_states()) drive.period = options.longest_step;
    return drive;
  }

  void steps_for(double time, const AppliedTorque& torque) {
    if (time <= 0.0) return;
    const auto count = static_cast<int>(std::ceil(time / options_.longest_step * (1.0 - 1e-9)));
    for (int i = 0; i < count; ++i) mechanism_.advance(time / count, torque);
  }

  void one_period() {
    if (drive_.period == 0.0) {
      steps_for(period_, {0.0, drive_.controller.proportional, drive_.controller.derivative});
      return;
    }
    const ShaftReadings before = mechanism_.shafts();
    computer_.sample(before);
    if (computer_.gives_out_later()) {
      steps_for(drive_.delay, {computer_.torque()});
      computer_.give_out();
      steps_for(drive_.period - drive_.delay, {computer_.torque()});
    } else {
      steps_for(drive_.period, {computer_.torque()});
    }
    note_rest(before);
  }

  /// All numbers as one period ago, three times: for ever.
  void note_rest(const ShaftReadings& before) {
    const ShaftReadings& now = mechanism_.shafts();
    const bool is_same = now == before && computer_ == last_;
    last_ = computer_;
    same_periods_ = is_same ? same_periods_ + 1 : 0;
    if (same_periods_ >= 3) is_at_rest_ = true;
  }

  static constexpr double unit_time = 1.0;  // s, of a drive without a limit

  PlainDrive drive_;
  EndingOptions options_;
  Mechanism mechanism_;
  Computer computer_;
  Computer last_;
  double period_;
  double elapsed_ = 0.0;
  double far_away_ = 0.0;
  std::size_t kept_every_ = 1;
  std::size_t same_periods_ = 0;
  bool is_at_rest_ = false;
  bool is_far_ = false;
  std::vector<Sample> trace_;
};

struct Measured {
  Ending ending;
  bool is_steady = false;
};

bool is_near(double one, double other, double share, double least) {
  return std::abs(one - other) <= std::max(share * std::max(one, other), least);
}

/// Of the last quarter and the one before it.
Measured measured(const Run& run, const PlainDrive& drive) {
  const std::vector<Sample>& trace = run.trace();
  const std::size_t quarter = trace.size() / 4;
  const std::size_t last = trace.size() - quarter;
  const auto load =
      range_of(trace, last, trace.size(), &Sample::lowest_load, &Sample::highest_load);
  const auto motor =
      range_of(trace, last, trace.size(), &Sample::lowest_motor, &Sample::highest_motor);
  Measured result;
  Ending& ending = result.ending;
  ending.amplitude = load.amplitude();
  ending.motor_amplitude = motor.amplitude();
  ending.earlier_amplitude =
      range_of(trace, last - quarter, last, &Sample::lowest_load, &Sample::highest_load)
          .amplitude();
  ending.earlier_motor_amplitude =
      range_of(trace, last - quarter, last, &Sample::lowest_motor, &Sample::highest_motor)
          .amplitude();
  const bool load_stands = ending.amplitude < 0.01 * ending.motor_amplitude;
  const std::size_t passings =
      load_stands ? passings_in(trace, last, &Sample::lowest_motor, &Sample::highest_motor, motor)
                  : passings_in(trace, last, &Sample::lowest_load, &Sample::highest_load, load);
  ending.frequency = static_cast<double>(passings) / (run.time() * static_cast<double>(quarter) /
                                                      static_cast<double>(trace.size()));
  ending.load_position = run.shafts().load_position;
  ending.time = run.time();
  const double least = 1e-6 * drive.small_length();
  constexpr std::size_t enough_passings = 8;
  result.is_steady = passings >= enough_passings &&
                     is_near(ending.amplitude, ending.earlier_amplitude, 0.02, least) &&
                     is_near(ending.motor_amplitude, ending.earlier_motor_amplitude, 0.02, least);
  return result;
}

/// Standstill is rest only without an integral, which may still break the shafts away.
bool is_fading(const Ending& ending, const PlainDrive& drive) {
  const double least = 1e-9 * drive.small_length();
  if (ending.motor_amplitude < least && ending.amplitude < least) {
    return drive.controller.integral == 0.0 && ending.earlier_motor_amplitude < least;
  }
  const double small = 0.1 * drive.small_length();
  return ending.amplitude < small && ending.motor_amplitude < small &&
         ending.amplitude < 0.9 * ending.earlier_amplitude &&
         ending.motor_amplitude < 0.9 * ending.earlier_motor_amplitude;
}

EndKind unsteady_kind(const Ending& ending, const PlainDrive& drive) {
  if (is_fading(ending, drive)) return EndKind::fades;
  const double growth = ending.amplitude / std::max(ending.earlier_amplitude, 1e-300);
  if (growth > 1.3 && ending.amplitude > 1e3 * drive.backlash) return EndKind::runs_away;
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

Ending ending_of(const PlainDrive& drive, const ShaftReadings& start,
                 const EndingOptions& options) {
  Run run(drive, start, options);
  for (double until = options.first_time;; until *= 2.0) {
    run.go_on(until);
    if (run.has_gaps()) return {.kind = EndKind::unclear, .time = run.time()};
    if (run.is_at_rest() || run.is_far()) {
      Ending ending;
      ending.kind = run.is_at_rest() ? EndKind::rest : EndKind::runs_away;
      ending.load_position = run.shafts().load_position;
      ending.time = run.time();
      return ending;
    }
    Measured found = measured(run, drive);
    if (found.is_steady) {
      found.ending.kind = EndKind::hunts;
      return found.ending;
    }
    if (until >= options.longest_time || is_fading(found.ending, drive)) {
      found.ending.kind = unsteady_kind(found.ending, drive);
      return found.ending;
    }
  }
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
