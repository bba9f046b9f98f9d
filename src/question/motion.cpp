#include "question/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/decimal_multiples.hpp"
#include "base/names.hpp"
#include "base/range_check.hpp"
#include "closed_form/trajectory.hpp"
#include "general/assemble/time_scale.hpp"
#include "general/attractors/search_setting.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "model/signal.hpp"

namespace gearlash {
namespace {

// ---- closed form --------------------------------------------------------------------------------

const char* text_of(Mode mode) {
  constexpr Names<Mode::no_gap> names("forward", "backward", "apart", "bouncing to rest",
                                      "together, no gap");
  return names[mode];
}

const char* text_of(const Event& event) {
  if (event.kind == EventKind::separation) return "faces part";
  const bool is_forward = event.face == Face::forward;
  if (event.kind == EventKind::impact) {
    return is_forward ? "impact forward" : "impact backward";
  }
  return is_forward ? "impact forward (settled)" : "impact backward (settled)";
}

/// The trajectory's unit of time is 1/ω_n.
class ServoMotion : public Motion::Source {
 public:
  ServoMotion(const ProportionalServo& servo, const drive::ReducedDrive& reduced,
              Trajectory trajectory)
      : trajectory_(std::move(trajectory)),
        rate_(servo.natural_frequency),
        stiffness_(reduced.controller.direct[0]),
        speed_gain_(reduced.controller.direct[2]),
        load_share_of_speed_(reduced.sensing.load_share_of_speed),
        reference_(std::get<double>(reduced.reference)) {
    for (const Event& event : trajectory_.events()) {
      const bool is_lossy = event.kind != EventKind::separation;
      events.push_back(
          {.time = event.time / rate_,
           .what = text_of(event),
           .mode_after = text_of(event.mode_after),
           .energy_lost = is_lossy ? std::optional(event.energy_lost * stiffness_) : std::nullopt,
           .before = shafts_of(event.before),
           .after = shafts_of(event.after)});
    }
    for (const Touch& touch : trajectory_.touches()) {
      touches.push_back({touch.time / rate_,
                         touch.face == Face::forward ? "impact forward" : "impact backward",
                         std::nullopt});
    }
    end_time = trajectory_.end_time() / rate_;
    if (trajectory_.stop_reason() == StopReason::event_limit) {
      stop = MotionStop::event_limit;
      stop_text = "after " + std::to_string(trajectory_.events().size()) + " events";
    }
    engine = Engine::closed_form;
  }

  MotionSample at(double time) const override {
    const double normalized = time * rate_;
    const Mode mode = trajectory_.mode_at(normalized);
    MotionSample sample{.time = time,
                        .shafts = shafts_of(trajectory_.at(normalized)),
                        .reference = reference_,
                        .mode = text_of(mode),
                        .is_apart = mode == Mode::separated};
    const Shafts& shafts = sample.shafts;
    const double speed = load_share_of_speed_ * shafts.load_speed +
                         (1.0 - load_share_of_speed_) * shafts.motor_speed;
    sample.motor_torque = stiffness_ * (reference_ - shafts.load_position) + speed_gain_ * speed;
    return sample;
  }

  /// An impact at time 0 is among the losses, so the energy at the start includes it.
  std::optional<EnergyBooks> energy() const override {
    const EnergyAccount from = trajectory_.energy_at(0.0);
    const EnergyAccount to = trajectory_.energy_at(trajectory_.end_time());
    return EnergyBooks{.stored_at_start = (from.stored() + from.impacts) * stiffness_,
                       .supplied = to.supplied * stiffness_,
                       .stored = to.stored() * stiffness_,
                       .motor_friction = to.motor_friction * stiffness_,
                       .load_friction = to.load_friction * stiffness_,
                       .impacts = to.impacts * stiffness_};
  }

 private:
  Shafts shafts_of(const ServoState& state) const {
    return {state.load_position, state.load_speed * rate_, state.motor_position,
            state.motor_speed * rate_};
  }

  Trajectory trajectory_;
  double rate_;  ///< ω_n
  double stiffness_;
  double speed_gain_;
  double load_share_of_speed_;
  double reference_;
};

// ---- general engine -----------------------------------------------------------------------------

Shafts shafts_of(const drive::ShaftStates& state) {
  return {state.load_position, state.load_speed, state.motor_position, state.motor_speed};
}

/// The reasons are the same ones, in the same order.
MotionStop stop_of(hybrid::StopReason reason) {
  static_assert(static_cast<int>(MotionStop::reached_end) ==
                    static_cast<int>(hybrid::StopReason::reached_end) &&
                static_cast<int>(MotionStop::zeno) == static_cast<int>(hybrid::StopReason::zeno) &&
                static_cast<int>(MotionStop::stopped) ==
                    static_cast<int>(hybrid::StopReason::stopped));
  return static_cast<MotionStop>(reason);
}

std::string stop_text_of(const hybrid::Trajectory& trajectory) {
  const std::string at =
      " at " + exact_text(trajectory.end_time()) + " s by \"" + trajectory.culprit() + "\"";
  switch (trajectory.stop_reason()) {
    case hybrid::StopReason::reached_end:
      return {};
    case hybrid::StopReason::event_limit:
      return "after " + std::to_string(trajectory.events().size()) + " events";
    case hybrid::StopReason::step_limit:
      return "after " + std::to_string(trajectory.steps()) + " steps";
    case hybrid::StopReason::zeno:
      return "events accumulate" + at;
    case hybrid::StopReason::chattering:
      return "endless events" + at;
    case hybrid::StopReason::diverged:
      return "the numbers grow without bound at " + exact_text(trajectory.end_time()) + " s";
    case hybrid::StopReason::stopped:
      return "by a limit";
  }
  return {};
}

class GeneralMotion : public Motion::Source {
 public:
  GeneralMotion(drive::DriveSystem system, hybrid::Trajectory trajectory)
      : system_(std::move(system)), trajectory_(std::move(trajectory)) {
    for (const hybrid::Event& event : trajectory_.events()) {
      if (event.kind == hybrid::EventKind::timed && event.mode == event.mode_after) continue;
      events.push_back(
          {.time = event.time - trajectory_.start_time(),
           .what = kept(text_of(event)),
           .mode_after = mode_name(event.mode_after),
           .before = gearlash::shafts_of(drive::shafts_of({event.mode, event.before})),
           .after = gearlash::shafts_of(drive::shafts_of({event.mode_after, event.after}))});
    }
    for (const hybrid::Touch& touch : trajectory_.touches()) {
      touches.push_back({touch.time - trajectory_.start_time(),
                         system_.system.mode(touch.mode).transitions[touch.transition].name,
                         touch.within});
    }
    end_time = trajectory_.end_time() - trajectory_.start_time();
    stop = stop_of(trajectory_.stop_reason());
    stop_text = stop_text_of(trajectory_);
    engine = Engine::general;
  }

  MotionSample at(double time) const override {
    thread_local hybrid::State state;
    trajectory_.at(trajectory_.start_time() + time, state);
    const auto value = [&](const hybrid::AffineForm& form) {
      return form.normal.size() == state.numbers.size() ? form.at(state.numbers) : 0.0;
    };
    return {.time = time,
            .shafts = gearlash::shafts_of(drive::shafts_of(state)),
            .motor_torque = value(system_.motor_torque(state.mode)),
            .reference = value(system_.reference),
            .load_torque = value(system_.load_torque),
            .mode = mode_name(state.mode),
            .is_apart = system_.modes.mode(state.mode).contact == drive::ContactState::apart};
  }

 private:
  std::string_view mode_name(std::size_t mode) const { return system_.system.mode(mode).name; }

  std::string text_of(const hybrid::Event& event) const {
    const std::string& name = event.name(system_.system);
    return event.kind == hybrid::EventKind::settling ? name + " (settled)" : name;
  }

  std::string_view kept(std::string text) { return *texts_.insert(std::move(text)).first; }

  drive::DriveSystem system_;
  hybrid::Trajectory trajectory_;
  std::set<std::string> texts_;
};

// ---- the request --------------------------------------------------------------------------------

/// Replaces a reference that is constant from 0 on by its final value, as the closed form needs it.
Drive with_constant_signals(Drive drive) {
  const auto simplify = [](std::optional<Signal>& signal) {
    if (!signal || drive::settling_time(*signal) > 0.0) return;
    const Signal settled = drive::settled(*signal);
    if (std::holds_alternative<double>(settled)) signal = settled;
  };
  simplify(drive.reference);
  simplify(drive.load_torque);
  return drive;
}

/// Moves a gap that misses a face by rounding onto that face.
double gap_of(const Start& start, const drive::ReducedDrive& reduced, RangeCheck& check) {
  constexpr double rounding = 1e-12;
  const double half = 0.5 * reduced.backlash;
  const double pulled = drive::value_at(reduced.reference, 0.0) < start.load_position ? -1.0 : 1.0;
  const double gap = start.gap.value_or(pulled * half);
  if (!std::holds_alternative<drive::RigidContact>(reduced.contact)) return gap;
  if (!(std::abs(gap) <= half * (1.0 + rounding))) {
    check.refuse("start.gap", exact_text(gap),
                 "must be from -" + exact_text(half) + " to " + exact_text(half) +
                     " rad, half the backlash each way");
  }
  return std::clamp(gap, -half, half);
}

void check_span(const Span& span, const Start& start, double longest, RangeCheck& check) {
  constexpr double largest = 1e100;  // squares and cubes stay finite
  check.within("start.load_position", start.load_position, -largest, largest);
  check.within("start.load_speed", start.load_speed, -largest, largest);
  check.within("start.gap_speed", start.gap_speed, -largest, largest);
  if (!(span.until >= 0.0 && span.until <= longest)) {
    check.refuse("until", exact_text(span.until),
                 "must be at most " + exact_text(longest) + " s, and not negative");
  }
}

std::shared_ptr<Motion::Source> servo_motion(const ProportionalServo& servo,
                                             const drive::ReducedDrive& reduced, const Span& span,
                                             const Start& start, double gap) {
  const double rate = servo.natural_frequency;
  ServoState state{.motor_position = start.load_position + gap,
                   .load_position = start.load_position,
                   .load_speed = start.load_speed / rate};
  state.set_gap_speed(start.gap_speed / rate);
  Trajectory trajectory = simulate(servo.servo, state,
                                   {.until = span.until * rate,
                                    .reference = std::get<double>(reduced.reference),
                                    .event_limit = span.most_events});
  return std::make_shared<ServoMotion>(servo, reduced, std::move(trajectory));
}

std::shared_ptr<Motion::Source> general_motion(const drive::ReducedDrive& reduced, const Span& span,
                                               const Start& start, double gap, Progress& progress) {
  drive::DriveSystem system = drive::drive_system(reduced);
  const drive::ShaftStates shafts{.motor_position = start.load_position + gap,
                                  .motor_speed = start.load_speed + start.gap_speed,
                                  .load_position = start.load_position,
                                  .load_speed = start.load_speed};
  hybrid::Trajectory trajectory =
      hybrid::simulate(system.system, drive::drive_start(reduced, system, shafts),
                       {.until = span.until,
                        .event_limit = span.most_events,
                        .step_limit = most_steps_of_a_motion,
                        .progress = &progress});
  return std::make_shared<GeneralMotion>(std::move(system), std::move(trajectory));
}

const std::shared_ptr<const Motion::Source>& nothing() {
  class Nothing : public Motion::Source {
    MotionSample at(double) const override { return {}; }
  };
  static const std::shared_ptr<const Motion::Source> source = [] {
    auto made = std::make_shared<Nothing>();
    made->stop = MotionStop::stopped;
    made->stop_text = "before it began";
    return made;
  }();
  return source;
}

}  // namespace

double period_of_loop(const Drive& drive) {
  Drive at_rest = drive;
  at_rest.reference.reset();
  at_rest.load_torque.reset();
  const std::optional<ProportionalServo> servo = proportional_servo(at_rest);
  return servo ? 2.0 * std::numbers::pi / servo->natural_frequency
               : drive::time_scales(reduce(drive)).swing;
}

double usual_step(const Drive& drive) {
  const drive::ReducedDrive reduced = reduce(drive);
  const double step = std::max({5.0 * reduced.backlash, 20.0 * reduced.sensing.resolution,
                                3.0 * drive::held_length(reduced)});
  return step > 0.0 && std::isfinite(step) ? step : 1.0;
}

double usual_time(const Drive& drive) {
  constexpr double periods = 10.0;
  const auto time_of = [](const std::optional<Signal>& signal) {
    return signal ? drive::settling_time(*signal) : 0.0;
  };
  return 2.0 * std::max(time_of(drive.reference), time_of(drive.load_torque)) +
         periods * period_of_loop(drive);
}

Motion motion_of(drive::DriveSystem system, hybrid::Trajectory trajectory, double until) {
  auto source = std::make_shared<GeneralMotion>(std::move(system), std::move(trajectory));
  source->asked_until = std::min(until, source->end_time);
  return Motion(std::move(source));
}

Motion simulate(const Drive& drive, const Span& span, Progress& progress) {
  require_none(faults(drive));
  if (!progress.go_on(0.0)) return {};
  const Drive simple = with_constant_signals(drive);
  const drive::ReducedDrive reduced = reduce(simple);
  const std::optional<ProportionalServo> servo = proportional_servo(simple);
  const Start start = span.start.value_or(Start{});
  RangeCheck check;
  const double gap = gap_of(start, reduced, check);
  check_span(
      span, start,
      servo ? longest_simulation / servo->natural_frequency : std::numeric_limits<double>::max(),
      check);
  require_none(check.faults());
  std::shared_ptr<Motion::Source> source =
      servo ? servo_motion(*servo, reduced, span, start, gap)
            : general_motion(reduced, span, start, gap, progress);
  source->asked_until =
      source->stop == MotionStop::reached_end ? span.until : std::min(span.until, source->end_time);
  return Motion(std::move(source));
}

Motion::Motion() : source_(nothing()) {}

MotionSample Motion::at(double time) const {
  return source_->at(std::clamp(time, 0.0, source_->asked_until));
}

std::size_t Motion::sample_count(double every) const {
  if (!(every > 0.0)) {
    throw InvalidInput({{"every", exact_text(every), "must be positive, in s"}});
  }
  return count_of_samples(source_->asked_until, every);
}

namespace {

/// The samples of a motion at time_of(0), time_of(1), ….
template <class TimeOf>
Samples samples_of(const Motion& motion, std::size_t count, const TimeOf& time_of,
                   Progress& progress) {
  Samples samples;
  for (std::vector<double>* column :
       {&samples.time, &samples.load_position, &samples.load_speed, &samples.motor_position,
        &samples.motor_speed, &samples.motor_torque, &samples.reference, &samples.load_torque}) {
    column->reserve(count);
  }
  constexpr std::size_t at_a_time = 4096;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % at_a_time == 0 &&
        !progress.go_on(static_cast<double>(i) / static_cast<double>(count))) {
      break;
    }
    const MotionSample sample = motion.at(time_of(i));
    samples.time.push_back(time_of(i));
    samples.load_position.push_back(sample.shafts.load_position);
    samples.load_speed.push_back(sample.shafts.load_speed);
    samples.motor_position.push_back(sample.shafts.motor_position);
    samples.motor_speed.push_back(sample.shafts.motor_speed);
    samples.motor_torque.push_back(sample.motor_torque);
    samples.reference.push_back(sample.reference);
    samples.load_torque.push_back(sample.load_torque);
  }
  return samples;
}

}  // namespace

Samples Motion::sampled(double every, Progress& progress) const {
  constexpr double most_samples = 1e8;
  const auto count = sample_count(every);
  if (static_cast<double>(count) > most_samples) {
    throw InvalidInput(
        {{"every", exact_text(every) + " s", "must give at most 100,000,000 samples"}});
  }
  return samples_of(*this, count, DecimalMultiples(every), progress);
}

Samples Motion::at(std::span<const double> times, Progress& progress) const {
  const double last = std::max(end_time(), source_->asked_until);  // they differ by rounding
  for (const double time : times) {
    if (time >= 0.0 && time <= last) continue;
    throw InvalidInput({{"times", exact_text(time) + " s",
                         "must be from 0 to the end of the motion, " + exact_text(last) + " s"}});
  }
  return samples_of(
      *this, times.size(), [&](std::size_t i) { return times[i]; }, progress);
}

std::span<const MotionEvent> Motion::events() const noexcept { return source_->events; }
std::span<const MotionTouch> Motion::touches() const noexcept { return source_->touches; }
double Motion::end_time() const noexcept { return source_->end_time; }
MotionStop Motion::stop() const noexcept { return source_->stop; }
const std::string& Motion::stop_text() const noexcept { return source_->stop_text; }
Engine Motion::engine() const noexcept { return source_->engine; }
std::optional<EnergyBooks> Motion::energy() const { return source_->energy(); }

const char* name_of(MotionStop stop) {
  constexpr Names<MotionStop::stopped> names("reached_end", "event_limit", "step_limit", "zeno",
                                             "chattering", "diverged", "stopped");
  return names[stop];
}

}  // namespace gearlash
