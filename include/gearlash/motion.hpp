// The exact motion of a drive: its state at any time, and its events. SI units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/progress.hpp"

namespace gearlash {

// Positions, speeds and torques of the motor are referred to the load's shaft: the motor's own
// position is divided by the gear ratio, its own torque multiplied by it. A normal form has
// J_M + J_L = 1 kg m², and ω_n = 1 rad/s where it has no natural frequency.

/// How a motion begins, at time 0.
struct Start {
  double load_position = 0.0;  ///< rad
  double load_speed = 0.0;     ///< rad/s
  std::optional<double>
      gap{};               ///< rad, motor less load, −b/2 … b/2 with rigid faces (to rounding);
                           ///< default: on the face that the reference pulls towards
  double gap_speed = 0.0;  ///< rad/s, motor less load

  bool operator==(const Start&) const = default;
};

struct Span {
  double until = 0.0;                   ///< s, ≥ 0; closed form: at most 1e9/ω_n
  std::optional<Start> start{};         ///< default: at rest at 0
  std::size_t most_events = 1'000'000;  ///< the motion stops after this many, clock ticks included
};

/// Positions rad, speeds rad/s.
struct Shafts {
  double load_position = 0.0;   ///< rad
  double load_speed = 0.0;      ///< rad/s
  double motor_position = 0.0;  ///< rad, at the load's shaft
  double motor_speed = 0.0;     ///< rad/s, at the load's shaft
};

/// An event of the motion. Clock ticks (a computer's sample, a point of a table) are not events.
/// Texts live as long as the Motion and its copies.
struct MotionEvent {
  double time = 0.0;                    ///< s
  std::string_view what{};              ///< "faces part", "impact forward", "motor stops", …
  std::string_view mode_after{};        ///< "apart", "forward; motor sticks", …
  std::optional<double> energy_lost{};  ///< J, at an impact; closed form only
  Shafts before{};                      ///< just before it
  Shafts after{};                       ///< just after it
};

/// A moment at which rounding decides whether an event occurs; events() has one of the two
/// outcomes.
struct MotionTouch {
  double time = 0.0;               ///< s
  std::string_view what{};         ///< the event in question
  std::optional<double> within{};  ///< how far beyond its guard, in its unit; general engine only
};

/// J, from the start: stored_at_start + supplied = stored + motor_friction + load_friction +
/// impacts.
struct EnergyBooks {
  double stored_at_start = 0.0;  ///< kinetic, and in the loop's virtual spring
  double supplied = 0.0;         ///< by the loop while the faces are apart
  double stored = 0.0;           ///< kinetic, and in the loop's virtual spring
  double motor_friction = 0.0;   ///< lost there
  double load_friction = 0.0;    ///< lost there
  double impacts = 0.0;          ///< lost at them
};

enum class MotionStop : std::uint8_t {
  reached_end,  ///< Span::until
  event_limit,  ///< Span::most_events
  step_limit,   ///< four million steps of the general engine, half a gigabyte
  zeno,         ///< events accumulate towards an instant
  chattering,   ///< unlimited events at one instant
  diverged,     ///< the state grows without bound
  stopped       ///< by Progress
};

struct MotionSample {
  double time = 0.0;          ///< s
  Shafts shafts{};            ///< positions and speeds
  double motor_torque = 0.0;  ///< N m, of the motor, excluding its winding's friction
  double reference = 0.0;     ///< rad
  double load_torque = 0.0;   ///< N m
  std::string_view mode{};    ///< as MotionEvent::mode_after
  bool is_apart = false;      ///< the faces do not touch
};

/// Columns of equal length.
struct Samples {
  std::vector<double> time{};            ///< s
  std::vector<double> load_position{};   ///< rad
  std::vector<double> load_speed{};      ///< rad/s
  std::vector<double> motor_position{};  ///< rad
  std::vector<double> motor_speed{};     ///< rad/s
  std::vector<double> motor_torque{};    ///< N m
  std::vector<double> reference{};       ///< rad
  std::vector<double> load_torque{};     ///< N m
};

/// The result of simulate(). Copies share it.
class Motion {
 public:
  class Source;  // what an engine computed
  /// A motion of zero duration. simulate() makes others.
  Motion();
  explicit Motion(std::shared_ptr<const Source> source) : source_(std::move(source)) {}

  /// Samples at 0, every, 2 every, … up to the end. A short decimal step gives short decimal times.
  /// Throws InvalidInput unless `every` is positive and gives at most a hundred million samples, 64
  /// bytes each. Progress that stops leaves the samples up to then.
  [[nodiscard]] Samples sampled(double every, Progress& progress = no_progress()) const;
  /// The number of those samples. Throws InvalidInput unless `every` is positive.
  [[nodiscard]] std::size_t sample_count(double every) const;
  /// Samples at any times, in any order. Throws InvalidInput for a time outside 0 … end_time().
  [[nodiscard]] Samples at(std::span<const double> times, Progress& progress = no_progress()) const;
  /// The state at any time from 0 to end_time(); other times are clamped. At an event: the state
  /// after it. Nothing is allocated after a thread's first call.
  [[nodiscard]] MotionSample at(double time) const;

  [[nodiscard]] std::span<const MotionEvent> events() const noexcept;
  [[nodiscard]] std::span<const MotionTouch> touches() const noexcept;
  [[nodiscard]] double end_time() const noexcept;  ///< s
  [[nodiscard]] MotionStop stop() const noexcept;
  /// Why the motion ended early, in words; empty if it did not.
  [[nodiscard]] const std::string& stop_text() const noexcept;
  [[nodiscard]] Engine engine() const noexcept;
  /// Closed form only.
  [[nodiscard]] std::optional<EnergyBooks> energy() const;

 private:
  std::shared_ptr<const Source> source_;
};

/// The motion under the drive's own reference and load torque. There is no step size. The closed
/// form answers for the servo of 1960 with a reference that is constant from 0 on. The general
/// engine answers for every other drive, from event to event and exact except for rounding
/// (docs/explanation/hybrid.md). Throws InvalidInput for an unsound drive and for faults of the
/// span: "until", "start.gap", ….
[[nodiscard]] Motion simulate(const Drive& drive, const Span& span,
                              Progress& progress = no_progress());

/// s, the period of the undamped loop in closed form, else the slowest swing of the linear loop.
/// Precondition: a sound drive.
[[nodiscard]] double period_of_loop(const Drive& drive);

/// rad, a step of the reference that shows hunting: five backlashes, at least twenty encoder
/// counts, and three times the error that friction holds. Precondition: as before.
[[nodiscard]] double usual_step(const Drive& drive);
/// s, a time that shows it: ten periods of the loop, and twice the settling time of the signals.
/// Precondition: as before.
[[nodiscard]] double usual_time(const Drive& drive);

/// The enumerator's name: "reached_end", "event_limit", …
[[nodiscard]] const char* name_of(MotionStop stop);

}  // namespace gearlash
