#include "comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <vector>

#include "closed_form/trajectory.hpp"
#include "reference_simulator.hpp"

namespace gearlash::oracle {
namespace {

constexpr Extended period = 6.283185307179586476925L;
constexpr Extended perturbation_size = 1e-12L;
constexpr std::size_t perturbed_runs = 4;

using Components = std::array<Extended, 4>;

Components components(const Shafts& s) {
  return {s.motor_position, s.motor_speed, s.load_position, s.load_speed};
}
Components components(const ServoState& s) {
  return {s.motor_position, s.motor_speed, s.load_position, s.load_speed};
}

/// What each component is measured against: positions by the largest excursion from the reference,
/// speeds by the largest speed of the same shaft.
Components scales(const ReferenceRun& run, Extended reference, Extended backlash) {
  Extended position = backlash;
  Extended motor_speed = 0;
  Extended load_speed = 0;
  for (const ReferenceEvent& event : run.events) {
    for (const Shafts& s : {event.before, event.after}) {
      position = std::max(position, std::abs(s.load_position - reference));
      motor_speed = std::max(motor_speed, std::abs(s.motor_speed));
      load_speed = std::max(load_speed, std::abs(s.load_speed));
    }
  }
  const Extended speed = std::max(load_speed, position);
  return {position, std::max(motor_speed, speed), position, speed};
}

Extended largest_difference(const Components& a, const Components& b, const Components& scale) {
  Extended largest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]) / scale[i]);
  }
  return largest;
}

bool same_event(const ReferenceEvent& a, const ReferenceEvent& b) {
  return a.kind == b.kind && a.face == b.face && a.mode_after == b.mode_after;
}

/// Deviations in units of the period and of the scales.
struct Deviation {
  Extended time = 0;
  Extended state = 0;
};

/// For every event of `base`, how far the same event of `other` lies away; the list ends where the
/// two runs differ in kind. Two chains of bounces may differ in how many were followed.
std::vector<Deviation> deviations(const ReferenceRun& base, const ReferenceRun& other,
                                  const Components& scale) {
  std::vector<Deviation> result;
  std::size_t j = 0;
  for (const ReferenceEvent& event : base.events) {
    if (event.kind == EventKind::settling) {
      while (j < other.events.size() && other.events[j].kind == EventKind::impact) ++j;
    }
    const bool chain_ended = j < other.events.size() && event.kind == EventKind::impact &&
                             other.events[j].kind == EventKind::settling;
    if (chain_ended && !result.empty()) {
      result.push_back(result.back());
      continue;
    }
    if (j >= other.events.size() || !same_event(event, other.events[j])) break;
    const ReferenceEvent& match = other.events[j++];
    result.push_back(
        {std::abs(match.time - event.time) / period,
         std::max(largest_difference(components(event.before), components(match.before), scale),
                  largest_difference(components(event.after), components(match.after), scale))});
  }
  return result;
}

const char* name(EventKind kind) {
  return kind == EventKind::separation ? "separation"
         : kind == EventKind::impact   ? "impact"
                                       : "settling";
}

/// One case under comparison: the library's trajectory, the reference, and the perturbed references
/// that measure the condition.
template <class Propagator>
class Comparison {
 public:
  Comparison(const RandomCase& drawn, const ComparisonOptions& options, Propagator propagator,
             const Trajectory& trajectory, CaseReport& report)
      : drawn_(drawn),
        options_(options),
        trajectory_(trajectory),
        report_(report),
        reference_(drawn.servo, std::move(propagator)) {}

  void run() {
    horizon_ = reference_options().until / (1 + 1e-9L);
    run_ = reference_.run(drawn_.initial, reference_options());
    scale_ = scales(run_, drawn_.reference, drawn_.servo.backlash);
    measure_condition();
    compare_events();
    if (!report_.failure.empty()) return;
    compare_between_events();
  }

  ReferenceOptions reference_options() const {
    ReferenceOptions options;
    const bool stopped_early = trajectory_.stop_reason() == StopReason::event_limit;
    const double end = stopped_early ? trajectory_.end_time() : options_.until;
    options.until = end * (1 + 1e-9L);  // the last event must not be lost to rounding
    options.reference = drawn_.reference;
    return options;
  }

  const ReferenceRun& reference_run() const { return run_; }
  const Components& scale() const { return scale_; }
  const std::vector<Deviation>& conditions() const { return condition_; }

 private:
  using Perturbed = ReferenceSimulator<ExponentialPropagator>;

  /// condition_[j] belongs to event j of the reference; the list ends before the first event that
  /// is not the same in every perturbed run.
  void measure_condition() {
    ReferenceOptions options = reference_options();
    const ExponentialPropagator propagator(drawn_.servo);
    condition_.assign(run_.events.size(), {});
    for (std::size_t i = 0; i < perturbed_runs; ++i) {
      options.perturbation = {perturbation_size, i + 1};
      perturbed_.emplace_back(drawn_.servo, propagator);
      const ReferenceRun run = perturbed_.back().run(drawn_.initial, options);
      const std::vector<Deviation> seen = deviations(run_, run, scale_);
      condition_.resize(std::min(condition_.size(), seen.size()));
      for (std::size_t j = 0; j < condition_.size(); ++j) {
        condition_[j].time = std::max(condition_[j].time, seen[j].time / perturbation_size);
        condition_[j].state = std::max(condition_[j].state, seen[j].state / perturbation_size);
      }
    }
  }

  bool too_ill(std::size_t j) const {
    return j >= condition_.size() ||
           std::max(condition_[j].time, condition_[j].state) > options_.largest_condition;
  }

  void compare_events() {
    std::size_t j = 0;
    for (const Event& event : trajectory_.events()) {
      if (event.kind == EventKind::settling) {
        while (j < run_.events.size() && run_.events[j].kind == EventKind::impact) ++j;
      }
      if (j < run_.events.size() ? too_ill(j) : j > condition_.size()) return cut_short(event.time);
      if (j >= run_.events.size()) {
        if (event.time > horizon_ * (1 - 1e-9L)) return;
        return fail_at(event, "not in the reference");
      }
      if (!compare_event(event, run_.events[j], condition_[j])) return;
      ++j;
    }
    const bool settling =
        !trajectory_.events().empty() && trajectory_.events().back().mode_after == Mode::settling;
    if (settling) return;  // what is left are the bounces that the library sums up
    if (j < run_.events.size() && !too_ill(j) && run_.events[j].time < horizon_ * (1 - 1e-9L)) {
      std::ostringstream text;
      text << "missed: " << name(run_.events[j].kind) << " at "
           << static_cast<double>(run_.events[j].time);
      report_.failure = text.str();
    }
  }

  void cut_short(double time) {
    report_.cut_short = true;
    horizon_ = std::min(horizon_, Extended(time));
    // Stay clear of the ill-conditioned event itself.
    for (const Event& event : trajectory_.events()) {
      if (event.time >= time) break;
      safe_time_ = event.time;
    }
    horizon_ = safe_time_;
  }

  bool compare_event(const Event& event, const ReferenceEvent& expected, const Deviation& limit) {
    // The library announces the end of a chain of bounces by a mode of its own.
    const Mode mode_after = event.mode_after == Mode::settling ? Mode::separated : event.mode_after;
    if (event.kind != expected.kind || event.face != expected.face ||
        mode_after != expected.mode_after) {
      std::ostringstream text;
      text << "the reference has " << name(expected.kind) << " at "
           << static_cast<double>(expected.time) << " on face "
           << (expected.face == Face::forward ? "forward" : "backward") << ", mode after "
           << static_cast<int>(expected.mode_after);
      fail_at(event, text.str());
      return false;
    }
    ++report_.events;
    if (event.kind == EventKind::settling) ++report_.settlings;
    const double time_error = static_cast<double>(std::abs(event.time - expected.time) / period);
    const Extended state_error =
        std::max(largest_difference(components(event.before), components(expected.before), scale_),
                 largest_difference(components(event.after), components(expected.after), scale_));
    report_.time_error = std::max(report_.time_error, time_error);
    return accept(time_error, limit.time, "time", event.time) &&
           accept_state(state_error, limit.state, event.time);
  }

  bool accept_state(Extended error, Extended condition, double time) {
    report_.state_error = std::max(report_.state_error, static_cast<double>(error));
    return accept(error, condition, "state", time);
  }

  bool accept(Extended error, Extended condition, const char* what, double time) {
    const Extended factor = std::max(Extended(1), condition);
    report_.condition = std::max(report_.condition, static_cast<double>(factor));
    report_.scaled_error = std::max(report_.scaled_error, static_cast<double>(error / factor));
    if (error <= options_.tolerance * factor) return true;  // false for NaN as well
    std::ostringstream text;
    text << what << " at " << time << " off by " << static_cast<double>(error) << ", condition "
         << static_cast<double>(condition);
    report_.failure = text.str();
    return false;
  }

  void fail_at(const Event& event, const std::string& why) {
    std::ostringstream text;
    text << "event " << name(event.kind) << " at " << event.time << " on face "
         << (event.face == Face::forward ? "forward" : "backward") << ", mode after "
         << static_cast<int>(event.mode_after) << ": " << why;
    report_.failure = text.str();
  }

  /// States at random times and at the turning points, whose spread gives the amplitude.
  void compare_between_events() {
    std::mt19937_64 random(12345);
    for (int i = 0; i < options_.random_times; ++i) {
      const double share = std::ldexp(static_cast<double>(random() >> 11), -53);
      const double time = static_cast<double>(horizon_) * share;
      if (near_event(time)) continue;
      if (!compare_at(time)) return;
    }
    compare_amplitude();
  }

  bool near_event(double time) const {
    constexpr double clearance = 1e-6;
    return std::any_of(run_.events.begin(), run_.events.end(), [&](const ReferenceEvent& event) {
      return std::abs(static_cast<double>(event.time) - time) < clearance;
    });
  }

  bool compare_at(double time) {
    const Components expected = components(reference_.at(time));
    const Components seen = components(trajectory_.at(time));
    Components scale = scale_;  // a state between events may be larger than any at an event
    for (std::size_t i = 0; i < 4; ++i) {
      const Extended offset = i % 2 == 0 ? Extended(drawn_.reference) : Extended(0);
      scale[i] = std::max(scale[i], std::abs(expected[i] - offset));
    }
    Extended condition = 0;
    for (Perturbed& other : perturbed_) {
      condition =
          std::max(condition, largest_difference(components(other.at(time)), expected, scale) /
                                  perturbation_size);
    }
    ++report_.states;
    return accept_state(largest_difference(seen, expected, scale), condition, time);
  }

  void compare_amplitude() {
    Extended high = drawn_.initial.load_position;
    Extended low = high;
    double seen_high = drawn_.initial.load_position;
    double seen_low = seen_high;
    for (const Extended time : run_.turning_times) {
      if (time > horizon_) break;
      const double rounded = static_cast<double>(time);
      if (!near_event(rounded) && !compare_at(rounded)) return;
      const Extended position = reference_.at(time).load_position;
      const double seen = trajectory_.at(rounded).load_position;
      high = std::max(high, position);
      low = std::min(low, position);
      seen_high = std::max(seen_high, seen);
      seen_low = std::min(seen_low, seen);
    }
    if (high == low) return;
    const Extended amplitude = (high - low) / 2;
    const Extended error = std::abs((seen_high - seen_low) / 2 - amplitude) / scale_[0];
    report_.amplitude_error = static_cast<double>(error);
    accept(error, report_.condition, "amplitude", static_cast<double>(horizon_));
  }

  const RandomCase& drawn_;
  const ComparisonOptions& options_;
  const Trajectory& trajectory_;
  CaseReport& report_;
  ReferenceSimulator<Propagator> reference_;
  std::vector<Perturbed> perturbed_;
  ReferenceRun run_;
  Components scale_{};
  std::vector<Deviation> condition_;
  Extended horizon_ = 0;
  Extended safe_time_ = 0;
};

/// How far apart the two references lie, scaled by the condition: what the oracle itself is worth.
double difference_of_references(const ReferenceRun& a, const ReferenceRun& b,
                                const Components& scale, const std::vector<Deviation>& conditions) {
  const std::vector<Deviation> seen = deviations(a, b, scale);
  Extended largest = 0;
  for (std::size_t j = 0; j < std::min(seen.size(), conditions.size()); ++j) {
    largest = std::max({largest, seen[j].time / std::max(Extended(1), conditions[j].time),
                        seen[j].state / std::max(Extended(1), conditions[j].state)});
  }
  return static_cast<double>(largest);
}

}  // namespace

CaseReport compare(const RandomCase& drawn, const ComparisonOptions& options) {
  CaseReport report;
  const Trajectory trajectory = simulate(
      drawn.servo, drawn.initial,
      {.until = options.until, .reference = drawn.reference, .event_limit = options.event_limit});
  const RawServo<Extended> raw = raw_servo<Extended>(drawn.servo);
  const ExponentialPropagator exponential(drawn.servo);
  Comparison<ExponentialPropagator> by_exponential(drawn, options, exponential, trajectory, report);
  if (raw.fastest_rate() > options.fastest_rate_for_odeint) {
    by_exponential.run();
    return report;
  }
  report.method = Method::odeint;
  Comparison<OdeintPropagator> by_odeint(drawn, options, OdeintPropagator(raw), trajectory, report);
  by_odeint.run();
  ReferenceSimulator<ExponentialPropagator> second(drawn.servo, exponential);
  report.reference_difference = difference_of_references(
      by_odeint.reference_run(), second.run(drawn.initial, by_odeint.reference_options()),
      by_odeint.scale(), by_odeint.conditions());
  return report;
}

}  // namespace gearlash::oracle
