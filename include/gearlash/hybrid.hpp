// Piecewise-affine hybrid systems of any kind: their motions and periodic orbits. No gears here.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/fault.hpp"

namespace gearlash::hybrid {

using Row = std::vector<double>;

/// g(x) = normal · x + offset.
struct Form {
  Row normal{};
  double offset = 0.0;
};

/// x⁺ = matrix x + offset. No matrix: the identity; no offset: 0.
struct Reset {
  std::vector<Row> matrix{};
  Row offset{};
};

/// When an event happens.
enum class Direction : std::uint8_t {
  falling,  ///< g ≥ 0 in the mode; leaving that fires
  rising,   ///< g ≤ 0 in the mode; leaving that fires
  either    ///< every change of sign fires
};

/// A mode of the system that made it.
struct Mode {
  std::size_t index = 0;

  bool operator==(const Mode&) const = default;
};

/// A clock of the system that made it.
struct Timer {
  std::size_t index = 0;
};

struct HybridSystem;

/// States x of one size, a mode each, and the events that lead from one to another.
///
/// An event fires at the first time after which its guard is on the wrong side; one that is on the
/// wrong side as its mode begins fires at once. Of several at one instant those of timers come
/// first; the others follow in the order in which they were added. No event is lost, and none fires
/// twice for one reason (docs/explanation/hybrid.md). Every function that takes a system throws
/// InvalidInput with all its faults: shapes that do not agree, modes that are not there, numbers
/// that are not finite.
class System {
 public:
  explicit System(std::vector<std::string> state_names);

  /// In it x′ = matrix x + offset; no offset: 0.
  Mode mode(std::string name, const std::vector<Row>& matrix, Row offset = {});
  /// Ticks at first, first + period, … (s, or the unit of time chosen); period > 0.
  Timer timer(std::string name, double period, double first = 0.0);

  /// While in `from`: as the guard leaves its side, x is reset and the mode becomes `to`.
  System& on(Mode from, std::string event, const Form& guard, Mode to,
             Direction direction = Direction::falling, const Reset& reset = {});
  /// While in `from`: at each tick x is reset and the mode becomes `to`.
  System& on_tick(Mode from, std::string event, Timer timer, Mode to, const Reset& reset = {});
  /// Where ever faster firings of the event last added end, infinitely many in a finite time (a
  /// ball that bounces to rest). Without it the motion stops before their limit.
  System& settling(Mode to, const Reset& onto = {});

 private:
  friend const HybridSystem& assembled(const System& system);
  struct Definition;
  Definition& own();  ///< copies of a system share it until one of them is changed
  std::shared_ptr<Definition> definition_;
};

/// Why a motion ends.
enum class End : std::uint8_t {
  time,          ///< it was watched so long
  event_limit,   ///< more than a million events
  accumulation,  ///< ever faster events without a settling()
  chattering,    ///< events without end at one instant
  divergence     ///< numbers beyond 1e150
};

class Trajectory;

class Motion {
 public:
  struct Event {
    double time = 0.0;
    std::string name{};
    Mode mode{};  ///< before
    Mode mode_after{};
    Row before{};
    Row after{};
    bool is_limit = false;  ///< of infinitely many firings, of which 1e-10 is left at `time`
  };

  Motion(const System& system, Trajectory trajectory);

  [[nodiscard]] std::span<const Event> events() const noexcept { return events_; }
  [[nodiscard]] double end_time() const;
  [[nodiscard]] End end() const;
  /// The mode and the state at a time from 0 to end_time(); at an event, after it.
  [[nodiscard]] Mode mode_at(double time) const;
  [[nodiscard]] Row at(double time) const;

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  std::vector<Event> events_{};
};

/// The motion from a start at time 0. Steps are series with proved remainders: there is no step
/// size, and an event is a first crossing; docs/explanation/hybrid.md says what rounding leaves
/// open.
[[nodiscard]] Motion simulate(const System& system, Mode start, const Row& state, double until);

struct Orbit {
  Mode mode{};  ///< at its start, between two events
  Row start{};
  double start_time = 0.0;  ///< of a system with timers
  double period = 0.0;
  double residual = 0.0;  ///< mismatch of the state after one period, as a share
  bool stable = false;    ///< all multipliers lie within the unit circle
  /// Floquet's, by falling modulus, without that of a shift in time.
  std::vector<std::complex<double>> multipliers{};
};

/// The periodic orbit that the motion from `state` has come near by `until`, closed by Newton's
/// method with exact derivatives; nothing where events do not recur or the method fails.
[[nodiscard]] std::optional<Orbit> find_orbit(const System& system, Mode start, const Row& state,
                                              double until);

/// The extremes of a form over one period, between events too.
[[nodiscard]] Bounds extent(const System& system, const Orbit& orbit, const Form& form);

}  // namespace gearlash::hybrid
