#include "segment_certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "closed_form/trajectory.hpp"
#include "raw_equations.hpp"

namespace gearlash::oracle {
namespace {

using Wide = long double;

constexpr Wide period = 6.283185307179586476925L;
constexpr Wide time_tolerance = 1e-11L * period;
constexpr Wide rounding = 1e-15L;  // of doubles that the segment starts from, with their sums

// --- motion from a given state, in closed form

/// exp[0, −x], without cancellation.
Wide decay_mean(Wide x) { return x == 0 ? Wide(1) : -std::expm1(-x) / x; }

/// Divided differences of exp at 0, 0, −x, −y.
struct ExponentialDifferences {
  Wide two_zeros_x;   ///< exp[0, 0, −x]
  Wide two_zeros_xy;  ///< exp[0, 0, −x, −y]
  Wide zero_x;        ///< exp[0, −x]
  Wide zero_xy;       ///< exp[0, −x, −y]
  Wide xy;            ///< exp[−x, −y]
};

/// Opitz: the differences are the entries of exp of the bidiagonal matrix of the nodes. Scaled
/// until the Taylor sum converges fast, then squared; all terms of a squaring are positive.
ExponentialDifferences by_opitz(Wide x, Wide y) {
  using Triangle = std::array<std::array<Wide, 4>, 4>;
  const std::array<Wide, 4> node = {0, 0, -x, -y};
  const int squarings = std::max(0, 2 + std::ilogb(std::max({Wide(1), x, y})));
  const Wide scale = std::ldexp(Wide(1), -squarings);
  Triangle power{};
  Triangle sum{};
  for (unsigned i = 0; i < 4; ++i) power[i][i] = sum[i][i] = 1;
  for (int n = 1; n <= 18; ++n) {
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = 3; j + 1 > i; --j) {
        const Wide diagonal = power[i][j] * node[j];
        const Wide beside = j > i ? power[i][j - 1] : Wide(0);
        power[i][j] = (diagonal + beside) * scale / n;
        sum[i][j] += power[i][j];
        if (j == 0) break;
      }
    }
  }
  for (int k = 0; k < squarings; ++k) {
    Triangle square{};
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = i; j < 4; ++j) {
        for (unsigned m = i; m <= j; ++m) square[i][j] += sum[i][m] * sum[m][j];
      }
    }
    sum = square;
  }
  return {sum[0][2], sum[0][3], sum[1][2], sum[1][3], sum[2][3]};
}

/// For a large rate the definition itself, which takes the farthest node out, loses no digits.
ExponentialDifferences exponential_differences(Wide x, Wide y) {
  constexpr Wide large = 16;
  const Wide fast = std::max(x, y);
  if (fast < large) return by_opitz(x, y);
  const Wide slow = std::min(x, y);
  const auto two_zeros = [](Wide z) {
    return z < 1 ? by_opitz(z, z).two_zeros_x : (1 - decay_mean(z)) / z;
  };
  ExponentialDifferences result{};
  result.zero_x = decay_mean(x);
  result.two_zeros_x = two_zeros(x);
  result.xy = std::exp(-slow) * decay_mean(fast - slow);
  result.zero_xy = (decay_mean(slow) - result.xy) / fast;
  result.two_zeros_xy = (two_zeros(slow) - result.zero_xy) / fast;
  return result;
}

/// Shafts apart, mirrored to the face of reference (raw_equations.hpp). From J_M ä + F_M a + … :
///   a_M(t) = a₀ e^{−ct} − (v₀/J_M) t exp[−ct, −Dt]   and its integrals.
class GapMotion {
 public:
  GapMotion(const RawServo<Wide>& servo, const State<Wide>& start) : servo_(servo), start_(start) {
    if (!servo_.massless_load()) load_rate_ = servo_.load_friction / servo_.load_inertia;
    if (servo_.massless_load()) {
      start_[opening_speed] -= start_[load_speed];
      start_[load_speed] = 0;
    }
    if (servo_.massless_motor()) {
      motor_speed_ = -start_[load_position] / servo_.motor_friction;
      start_[opening_speed] = start_[load_speed] - motor_speed_;
      motor_acceleration_ = 0;  // its motion is the load's, see below
    } else {
      motor_rate_ = servo_.motor_friction / servo_.motor_inertia;
      motor_speed_ = start_[load_speed] - start_[opening_speed];
      motor_acceleration_ =
          -(servo_.motor_friction * motor_speed_ + start_[load_position]) / servo_.motor_inertia;
    }
  }

  struct Point {
    State<Wide> state;
    Wide motor_acceleration;
  };

  Point at(Wide t) const {
    const Wide y0 = start_[load_position];
    const Wide v0 = start_[load_speed];
    const ExponentialDifferences e = exponential_differences(motor_rate_ * t, load_rate_ * t);
    const Wide load_shift = v0 * t * decay_mean(load_rate_ * t);
    const Wide load_speed_now = v0 * std::exp(-load_rate_ * t);
    Point point{};
    Wide motor_shift;
    Wide motor_speed_now;
    if (servo_.massless_motor()) {  // v_M = −y_L/F_M
      const ExponentialDifferences load = exponential_differences(load_rate_ * t, load_rate_ * t);
      motor_speed_now = -(y0 + load_shift) / servo_.motor_friction;
      motor_shift = -(y0 * t + v0 * t * t * load.two_zeros_x) / servo_.motor_friction;
      point.motor_acceleration = -load_speed_now / servo_.motor_friction;
    } else {
      const Wide drive = v0 / servo_.motor_inertia;
      motor_shift = motor_speed_ * t + motor_acceleration_ * t * t * e.two_zeros_x -
                    drive * t * t * t * e.two_zeros_xy;
      motor_speed_now =
          motor_speed_ + motor_acceleration_ * t * e.zero_x - drive * t * t * e.zero_xy;
      point.motor_acceleration =
          motor_acceleration_ * std::exp(-motor_rate_ * t) - drive * t * e.xy;
    }
    point.state = {y0 + load_shift, load_speed_now, start_[distance] - (motor_shift - load_shift),
                   load_speed_now - motor_speed_now};
    return point;
  }

  /// Bound of |d̈| over h from a point, by |v_L| decreasing and a_M' = −c a_M − v_L/J_M.
  Wide curvature_bound(const Point& point, Wide h) const {
    const Wide load = std::abs(point.state[load_speed]);
    return std::abs(point.motor_acceleration) + forced_change(load, h) + load_rate_ * load;
  }

  /// How long the gap surely opens from d = ḋ = 0: while d̈ keeps the sign it begins with. 0 when
  /// it does not open at all.
  Wide opening_time(Wide duration, bool torque_free) const {
    const Wide v0 = start_[load_speed];
    if (torque_free && !servo_.massless_load() && !servo_.massless_motor()) {
      // d̈ = 0 at first; from then on d⃛ + c d̈ = d⃛(0) e^{−Dt}, so d̈ has the sign of d⃛(0).
      const Wide load_jerk = load_rate_ * load_rate_ * v0;
      const Wide motor_jerk = (servo_.motor_friction * load_rate_ - 1) * v0 / servo_.motor_inertia;
      return load_jerk - motor_jerk > 0 ? duration : Wide(0);
    }
    const Point start = at(0);
    const Wide curvature = -load_rate_ * v0 - start.motor_acceleration;
    if (!(curvature > 0)) return 0;
    const Wide speed = std::abs(v0);
    const Wide motor = std::abs(start.motor_acceleration) + forced_change(speed, duration);
    const Wide drive = servo_.massless_motor() ? load_rate_ * speed / servo_.motor_friction
                                               : speed / servo_.motor_inertia;
    const Wide jerk = motor_rate_ * motor + drive + load_rate_ * load_rate_ * speed;
    return jerk * duration < curvature ? duration : curvature / jerk;
  }

  Wide initial_opening_speed() const { return start_[opening_speed]; }

 private:
  Wide forced_change(Wide load_speed_bound, Wide h) const {
    if (servo_.massless_motor()) return 0;
    const Wide free = h * load_speed_bound / servo_.motor_inertia;
    if (servo_.motor_friction == 0) return free;
    return std::min(free, load_speed_bound / servo_.motor_friction);
  }

  RawServo<Wide> servo_;
  State<Wide> start_;
  Wide load_rate_ = 0;   // D
  Wide motor_rate_ = 0;  // c
  Wide motor_speed_ = 0;
  Wide motor_acceleration_ = 0;
};

/// Shafts together: (y, v) by the matrix exponential of the raw 2 × 2 system.
class EngagedMotion {
 public:
  EngagedMotion(const RawServo<Wide>& servo, const State<Wide>& start)
      : servo_(servo), start_(start) {}

  State<Wide> at(Wide t) const {
    const Wide friction = servo_.motor_friction + servo_.load_friction;
    const int squarings = std::max(0, 2 + std::ilogb((1 + friction) * (t + 1e-300L)));
    const Wide h = std::ldexp(t, -squarings);
    using Square = std::array<Wide, 4>;  // by rows
    Square power = {1, 0, 0, 1};
    Square sum = power;
    for (int n = 1; n <= 18; ++n) {  // power · [[0, 1], [−1, −F]] · h/n
      power = {-power[1] * h / n, (power[0] - friction * power[1]) * h / n, -power[3] * h / n,
               (power[2] - friction * power[3]) * h / n};
      for (unsigned i = 0; i < 4; ++i) sum[i] += power[i];
    }
    for (int k = 0; k < squarings; ++k) {
      sum = {sum[0] * sum[0] + sum[1] * sum[2], sum[0] * sum[1] + sum[1] * sum[3],
             sum[2] * sum[0] + sum[3] * sum[2], sum[2] * sum[1] + sum[3] * sum[3]};
    }
    return {sum[0] * start_[load_position] + sum[1] * start_[load_speed],
            sum[2] * start_[load_position] + sum[3] * start_[load_speed], Wide(0), Wide(0)};
  }

 private:
  RawServo<Wide> servo_;
  State<Wide> start_;
};

// --- functions that must stay positive

struct Sample {
  Wide value;
  Wide slope;
};

struct TorqueWatch {
  const RawServo<Wide>& servo;
  const EngagedMotion& motion;

  Sample at(Wide t) const {
    const State<Wide> z = motion.at(t);
    return {engaged_torque(servo, z), engaged_torque(servo, engaged_derivative(servo, z))};
  }
  /// N obeys the engaged equation itself, along which N² + Ṅ² does not grow.
  Wide curvature_bound(Wide t, Wide) const {
    const Sample sample = at(t);
    return (1 + servo.motor_friction + servo.load_friction) *
           std::hypot(sample.value, sample.slope);
  }
};

struct DistanceWatch {
  const GapMotion& motion;
  Wide backlash;
  bool far;

  Sample at(Wide t) const {
    const State<Wide> z = motion.at(t).state;
    if (far) return {backlash - z[distance], -z[opening_speed]};
    return {z[distance], z[opening_speed]};
  }
  Wide curvature_bound(Wide t, Wide h) const { return motion.curvature_bound(motion.at(t), h); }
};

/// A certificate for one function over one segment, added to the counts.
template <class Watch>
class Certifier {
 public:
  /// `from_zero`: the function is exactly zero at the start, so that its rounding errors, which
  /// stem from its slope, grow with time.
  Certifier(const Watch& watch, Wide duration, Wide scale, bool from_zero,
            CertificateCounts& counts)
      : watch_(watch), duration_(duration), scale_(scale), from_zero_(from_zero), counts_(counts) {}

  /// `begin` is where a cell at the start already proved f > 0; false: f is negative somewhere.
  bool run(Wide begin, bool zero_at_end) {
    const Wide end = zero_at_end ? duration_ - last_cell(begin) : duration_;
    Wide t = begin;
    Wide h = end - t;
    Wide over = 0;
    while (t < end) {
      h = std::min(h, end - t);
      if (positive_within(t, h)) {
        ++counts_.cells;
        t += h;
        h *= 2;
        continue;
      }
      h /= 2;
      constexpr Wide narrowest = 1e-9L;
      if (h >= narrowest * std::min(Wide(1), duration_)) continue;
      if (!near_zero(t)) return false;
      over = std::max(2 * over, 4 * narrowest * std::min(Wide(1), duration_));
      t += over;  // what cannot be told
      h = over;
    }
    return true;
  }

  /// Cell next to a zero at the start, left with positive slope.
  Wide first_cell(Wide slope) const {
    Wide h = duration_;
    while (h > 0 && watch_.curvature_bound(0, h) * h > safety * 2 * slope) h /= 2;
    return h;
  }

 private:
  static constexpr Wide safety = 0.98L;

  /// Width of the cell next to the zero at the end.
  Wide last_cell(Wide begin) const {
    const Wide slope = -watch_.at(duration_).slope;
    if (!(slope > 0)) return 0;
    const Wide most = duration_ - begin;
    Wide h = most;
    while (h > most * 1e-15L && watch_.curvature_bound(duration_ - h, h) * h > safety * 2 * slope) {
      h /= 2;
    }
    return h;
  }

  bool positive_within(Wide t, Wide h) const {
    const Wide least = std::min(watch_.at(t).value, watch_.at(t + h).value);
    const Wide noise = rounding * scale_ * (from_zero_ ? std::min(t, Wide(1)) : Wide(1));
    return least > noise && least - noise > watch_.curvature_bound(t, h) * h * h / 8;
  }

  /// Too close to zero to tell; counted once a segment and function.
  bool near_zero(Wide t) {
    const Wide value = watch_.at(t).value;
    constexpr Wide grazing = 1e-11L;
    if (!(value > -grazing * scale_)) return false;
    if (value > grazing * scale_) return false;  // a bound so weak would be a fault of this program
    if (!counted_) ++counts_.undecidable;
    counted_ = true;
    counts_.closest_grazing =
        std::max(counts_.closest_grazing, static_cast<double>(std::abs(value) / scale_));
    return true;
  }

  const Watch& watch_;
  Wide duration_;
  Wide scale_;
  bool from_zero_;
  CertificateCounts& counts_;
  bool counted_ = false;
};

// --- one trajectory

Wide side(Face face) { return face == Face::forward ? 1 : -1; }

bool engaged(Mode mode) { return mode == Mode::engaged_forward || mode == Mode::engaged_backward; }

class TrajectoryCertificate {
 public:
  TrajectoryCertificate(const RandomCase& drawn, const Trajectory& trajectory,
                        CertificateCounts& counts)
      : drawn_(drawn),
        servo_(raw_servo<Wide>(drawn.servo)),
        trajectory_(trajectory),
        counts_(counts) {}

  void run() {
    if (drawn_.servo.backlash == 0.0) return;
    const auto& segments = trajectory_.segments();
    const auto& events = trajectory_.events();
    // At the limit of events the last segment ends at an event that is not listed.
    const bool limited = trajectory_.stop_reason() == StopReason::event_limit;
    const std::size_t count = limited ? segments.size() - 1 : segments.size();
    for (std::size_t i = 0; i < count && failure_.empty(); ++i) {
      const Event* begin = i == 0 ? nullptr : &events[i - 1];
      const Event* end = i < events.size() ? &events[i] : nullptr;
      ++counts_.segments;
      if (end != nullptr) ++counts_.events;
      certify_segment(begin, end, segments[i]);
      if (end != nullptr && failure_.empty()) check_law(*end);
    }
    if (failure_.empty()) return;
    ++counts_.faults;
    counts_.first_fault = failure_;
  }

 private:
  void fail(const std::string& what, double time, Wide amount) {
    if (!failure_.empty()) return;
    std::ostringstream text;
    text << what << " at " << time << ": " << static_cast<double>(amount);
    failure_ = text.str();
  }

  State<Wide> mirrored(const ServoState& state, Face face, bool touching) const {
    const Wide sign = side(face);
    const Wide gap = Wide(state.motor_position) - state.load_position;
    return {sign * (Wide(state.load_position) - drawn_.reference), sign * Wide(state.load_speed),
            touching ? Wide(0) : servo_.backlash / 2 - sign * gap,
            -sign * (Wide(state.motor_speed) - state.load_speed + state.motor_speed_remainder)};
  }

  void certify_segment(const Event* begin, const Event* end, const Segment& segment) {
    const ServoState& start = begin != nullptr ? begin->after : drawn_.initial;
    const Wide duration = Wide(segment.end) - segment.start;
    const Wide gap = Wide(start.motor_position) - start.load_position;
    const bool touching = begin != nullptr || std::abs(gap) == servo_.backlash / 2;
    const Face face = begin != nullptr ? begin->face : (gap < 0 ? Face::backward : Face::forward);
    State<Wide> z = mirrored(start, face, touching);
    scale_ = std::abs(z[load_position]) + std::abs(z[load_speed]) + servo_.backlash;
    // Asked of the event, not of the time: a settling may take less time than a double resolves.
    const Mode mode = begin != nullptr ? begin->mode_after : trajectory_.mode_at(0.0);
    if (mode == Mode::settling) {
      ++counts_.settlings;
      certify_settling(z, end, duration, segment.start);
    } else if (engaged(mode)) {
      certify_engaged(z, end, duration, segment.start);
    } else {
      const bool torque_free = begin != nullptr && begin->kind == EventKind::separation;
      if (torque_free) put_on_torque_free_line(z);
      certify_gap(z, face, {touching, torque_free}, end, duration, segment.start);
    }
  }

  /// Of N = (F_L − 2ζJ_L) v − J_L y.
  Wide torque_scale() const {
    const Wide friction = servo_.motor_friction + servo_.load_friction;
    return (servo_.load_friction + (1 + friction) * servo_.load_inertia) * scale_;
  }

  /// The library's state just after a separation satisfies N = 0 to rounding; exactly here.
  void put_on_torque_free_line(State<Wide>& z) {
    const Wide by_position = engaged_torque(servo_, {1, 0, 0, 0});
    const Wide by_speed = engaged_torque(servo_, {0, 1, 0, 0});
    const Wide excess =
        engaged_torque(servo_, z) / (by_position * by_position + by_speed * by_speed);
    if (std::abs(excess * by_position) + std::abs(excess * by_speed) > 1e-11L * scale_) {
      fail("separation off the line of zero mesh torque", 0, excess);
    }
    z[load_position] -= excess * by_position;
    z[load_speed] -= excess * by_speed;
    z[opening_speed] = 0;
  }

  /// Bounces accumulate because the faces are pressed all the while, in about the geometric time.
  void certify_settling(State<Wide> z, const Event* end, Wide duration, double time) {
    const Wide approach = -gap_derivative(servo_, z)[opening_speed];
    const Wide rebound = z[opening_speed];
    const Wide geometric = 2 * rebound / (approach * (1 - servo_.restitution));
    z[load_speed] -= servo_.motor_inertia * rebound;
    const EngagedMotion motion(servo_, z);
    const TorqueWatch watch{servo_, motion};
    if (!Certifier(watch, duration, torque_scale(), false, counts_).run(0, false)) {
      return fail("settling although the faces are not pressed", time, watch.at(0).value);
    }
    if (end == nullptr) return;
    if (end->kind != EventKind::settling) return fail("a settling ends otherwise", time, 0);
    constexpr Wide first_order = 1e-3L;
    const Wide slack = 1e-15L * (1 + Wide(end->time));
    if (!(std::abs(duration - geometric) <= first_order * geometric + slack)) {
      fail("time of settling", time, duration - geometric);
    }
  }

  void certify_engaged(const State<Wide>& z, const Event* end, Wide duration, double time) {
    const EngagedMotion motion(servo_, z);
    const TorqueWatch watch{servo_, motion};
    Certifier certifier(watch, duration, torque_scale(), false, counts_);
    const Sample start = watch.at(0);
    const bool from_zero = std::abs(start.value) <= rounding * torque_scale() && start.slope > 0;
    const Wide begin = from_zero ? certifier.first_cell(start.slope) : Wide(0);
    if (!certifier.run(begin, end != nullptr)) {
      return fail("mesh torque changes sign unnoticed after", time, watch.at(duration / 2).value);
    }
    if (end == nullptr) return;
    if (end->kind != EventKind::separation) return fail("engagement ends otherwise", time, 0);
    check_zero(watch.at(duration), torque_scale(), end->time,
               "separation where the mesh torque is");
  }

  struct Opening {
    bool touching;
    bool torque_free;
  };

  void certify_gap(const State<Wide>& z, Face face, Opening opening, const Event* end,
                   Wide duration, double time) {
    const GapMotion motion(servo_, z);
    const DistanceWatch near{motion, servo_.backlash, false};
    const DistanceWatch far{motion, servo_.backlash, true};
    if (end != nullptr && end->kind != EventKind::impact) {
      return fail("a flight ends otherwise", time, 0);
    }
    const bool ends_near = end != nullptr && end->face == face;
    const bool ends_far = end != nullptr && end->face != face;
    Certifier near_certifier(near, duration, scale_, opening.touching, counts_);
    Wide begin = 0;
    if (opening.touching) {
      const Wide speed = motion.initial_opening_speed();
      begin = speed > 0 && !opening.torque_free
                  ? near_certifier.first_cell(speed)
                  : motion.opening_time(duration, opening.torque_free);
      if (!(begin > 0)) return fail("the gap does not open", time, speed);
    }
    if (!near_certifier.run(std::min(begin, duration), ends_near)) {
      return fail("near face reached unnoticed after", time, duration);
    }
    if (!Certifier(far, duration, scale_, false, counts_).run(0, ends_far)) {
      return fail("far face reached unnoticed after", time, duration);
    }
    if (end == nullptr) return;
    check_zero((ends_near ? near : far).at(duration), scale_, end->time,
               "impact where the distance is");
  }

  /// A real, falling zero: its value is explained by an error in time within the tolerance.
  void check_zero(const Sample& sample, Wide scale, double time, const char* what) {
    if (sample.slope > rounding * scale) return fail("an event on the way out", time, sample.slope);
    const Wide slope = std::abs(sample.slope);
    const Wide allowance = rounding * scale * 8;
    const Wide excess = std::max(Wide(0), std::abs(sample.value) - allowance);
    if (slope > 0) {
      counts_.worst_event_time =
          std::max(counts_.worst_event_time, static_cast<double>(excess / (slope * period)));
    }
    if (!(excess <= slope * time_tolerance)) fail(what, time, sample.value);
  }

  void check_law(const Event& event) {
    const State<Wide> before = mirrored(event.before, event.face, true);
    const State<Wide> after = mirrored(event.after, event.face, true);
    const Wide speeds = std::abs(before[load_speed]) + std::abs(before[opening_speed]) + scale_;
    const auto momentum = [&](const State<Wide>& z) {
      return servo_.motor_inertia * (z[load_speed] - z[opening_speed]) +
             servo_.load_inertia * z[load_speed];
    };
    const Wide tolerance = 16 * rounding * speeds;
    const bool massless = servo_.massless_load() || servo_.massless_motor();
    const bool parting = event.mode_after == Mode::separated && massless;
    if (!parting && std::abs(momentum(after) - momentum(before)) > tolerance) {
      return fail("momentum lost", event.time, momentum(after) - momentum(before));
    }
    if (event.kind != EventKind::impact) return;
    const Wide restitution = servo_.plastic() ? Wide(0) : servo_.restitution;
    const Wide expected = -restitution * before[opening_speed];
    if (std::abs(after[opening_speed] - expected) > tolerance) {
      return fail("restitution", event.time, after[opening_speed] - expected);
    }
    if (restitution > 0) return;
    const Wide torque = engaged_torque(servo_, after);
    const bool decided = std::abs(torque) > rounding * torque_scale();
    if (decided && engaged(event.mode_after) != (torque > 0)) {
      fail("the faces should part, or stay together, after the impact", event.time, torque);
    }
  }

  const RandomCase& drawn_;
  RawServo<Wide> servo_;
  const Trajectory& trajectory_;
  CertificateCounts& counts_;
  Wide scale_ = 1;
  std::string failure_;
};

}  // namespace

void CertificateCounts::add(const CertificateCounts& other) {
  servos += other.servos;
  segments += other.segments;
  events += other.events;
  cells += other.cells;
  settlings += other.settlings;
  undecidable += other.undecidable;
  faults += other.faults;
  closest_grazing = std::max(closest_grazing, other.closest_grazing);
  worst_event_time = std::max(worst_event_time, other.worst_event_time);
  const bool earlier = first_fault.empty() || other.first_fault_servo < first_fault_servo;
  if (!other.first_fault.empty() && earlier) {
    first_fault = other.first_fault;
    first_fault_servo = other.first_fault_servo;
  }
}

CertificateCounts certify(const RandomCase& drawn, const Trajectory& trajectory) {
  CertificateCounts counts;
  counts.servos = 1;
  TrajectoryCertificate(drawn, trajectory, counts).run();
  return counts;
}

CertificateCounts certify(const RandomCase& drawn, double until, std::size_t event_limit) {
  return certify(
      drawn, simulate(drawn.servo, drawn.initial,
                      {.until = until, .reference = drawn.reference, .event_limit = event_limit}));
}

}  // namespace gearlash::oracle
