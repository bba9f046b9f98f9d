// A drive as the fixed-step simulator takes it: plain SI numbers at the load's shaft.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "gearlash/drive.hpp"
#include "plain_signal.hpp"

namespace gearlash::oracle {

struct PlainShaft {
  double inertia = 1.0;    ///< kg m², > 0
  double viscous = 0.0;    ///< N m s/rad
  double coulomb = 0.0;    ///< N m
  double breakaway = 0.0;  ///< N m, ≥ coulomb
  /// rad/s: up to here the dry torque of a moving shaft falls from breakaway to coulomb, in
  /// proportion.
  double stribeck_speed = 0.0;
};

enum class PlainContact { rigid, spring_damping_limited, spring_damping_full };

/// Numbers x of a law with x′ = A x + B (r, y, v) and the output C x + D (r, y, v); or from sample
/// to sample, with the next x instead of x′.
struct PlainSystem {
  std::vector<double> A{};                 ///< n × n, row by row
  std::vector<std::array<double, 3>> B{};  ///< n
  std::vector<double> C{};                 ///< n; N m
  std::array<double, 3> D{};               ///< N m/rad and N m s/rad
  bool is_sampled = false;                 ///< from sample to sample
};

/// How a law receives its error.
enum class PlainErrorRule {
  as_it_is,
  excess,          ///< 0 within ± width, e ∓ width beyond
  whole,           ///< 0 within the band, e beyond; it begins and ends at width ± hysteresis
  relay,           ///< −1, 0, 1 by the same band; −1, 1 without a width
  relay_of_speed,  ///< the same, of −v
  take_up          ///< e + half_gap sat(e/width)
};

/// What the controller computes, with e = r − y of the position read and v the speed read:
///   PID:     proportional e + integral ∫e dt − derivative v, or, with a `filter`, with the
///            derivative passed through 1/(filter s + 1): of the speed, or of the error;
///   cascade: proportional (w − f) + integral ∫(w − f) dt, where w = position e + speed_share ṙ
///            within ± speed_limit, worked out at every position_ticks-th sample, and f is v,
///            passed through 1/(filter s + 1);
///   system:  PlainSystem.
/// It adds friction sat(ṙ/friction_speed) + inertia r̈. r is the reference and reference_half_gap on
/// the side of its last motion, with a lag.
enum class PlainLaw { PID, cascade, system };

struct PlainController {
  PlainLaw law = PlainLaw::PID;
  double position = 0.0;       ///< 1/s, cascade
  double proportional = 0.0;   ///< N m/rad; of a cascade the speed gain, N m s/rad
  double integral = 0.0;       ///< N m/(rad s); of a cascade N m/rad
  double derivative = 0.0;     ///< N m s/rad
  double filter = 0.0;         ///< s
  double tracking_time = 0.0;  ///< s; 0: the integral winds up
  bool derivative_of_speed = false;
  PlainSystem system{};
  PlainErrorRule rule = PlainErrorRule::as_it_is;
  double width = 0.0;               ///< rad; rad/s of a relay of the speed
  double hysteresis = 0.0;          ///< likewise
  double half_gap = 0.0;            ///< rad, taken up with the error
  double reference_half_gap = 0.0;  ///< rad, taken up with the reference's motion ...
  double take_up_time = 0.0;        ///< s, ... with this time constant
  double friction = 0.0;            ///< N m
  double friction_speed = 0.0;      ///< rad/s; 0: by the sign of ṙ
  double inertia = 0.0;             ///< N m s²/rad
  double speed_share = 0.0;         ///< 0 … 1
  double speed_limit = std::numeric_limits<double>::infinity();  ///< rad/s
  int position_ticks = 1;
};

struct PlainDrive {
  PlainShaft motor{};
  PlainShaft load{};
  double backlash = 0.0;  ///< rad, face to face
  PlainContact contact = PlainContact::rigid;
  double restitution = 0.0;
  double stiffness = 0.0;       ///< N m/rad, of compliant faces
  double damping = 0.0;         ///< N m s/rad, of compliant faces
  bool reads_load = true;       ///< position; else the motor's
  bool speed_of_load = true;    ///< else the motor's
  double step = 0.0;            ///< rad, of the position's encoder; 0: exact
  double speed_step = 0.0;      ///< rad, of the encoder whose differences are the speed
  bool has_tachometer = false;  ///< the speed is exact, no difference of positions
  PlainController controller{};
  double limit = std::numeric_limits<double>::infinity();  ///< N m, of the motor's torque
  /// 1/s: the torque tends to the one that is asked for at this rate; 0: it is that.
  double current_rate = 0.0;
  /// s; 0: a continuous controller. One that needs a computer is sampled as fast as the simulator
  /// steps.
  double period = 0.0;
  double delay = 0.0;  ///< s, ≥ 0
  double blend = 0.5;  ///< share of the new value in an integration step: 1/2 trapezoidal (Tustin),
                       ///< 1 backward, 0 forward
  double reference = 0.0;            ///< rad; see PlainSignal of one that moves
  double load_torque = 0.0;          ///< N m, forward; likewise
  double gravity_stiffness = 0.0;    ///< N m/rad, of the load about the reference
  PlainCourse reference_course{};    ///< rad, beside the constant
  PlainCourse load_torque_course{};  ///< N m, beside the constant

  /// Whether the torque is more than stiffness and damping about the reference.
  [[nodiscard]] bool needs_computer() const;
  [[nodiscard]] double reference_at(double time) const {
    return reference + reference_course.at(time);
  }
  /// rad: the smallest of backlash, 1e-3 without one, and encoder steps.
  [[nodiscard]] double small_length() const;
};

/// Referred to the load's shaft by formulas of its own. Throws std::invalid_argument for what the
/// simulator does not know: a normal form, a motor that is not torque-controlled, and a firmware's
/// registers.
[[nodiscard]] PlainDrive plain_drive(const Drive& drive);

/// With the final course of its signals, as a search for motion has them.
[[nodiscard]] PlainDrive settled(PlainDrive drive);

}  // namespace gearlash::oracle
