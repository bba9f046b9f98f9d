// Cycles of dry friction, beside closed forms and independent arithmetic of 50 digits; and faces
// that give, as they become rigid.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "general/attractors/attractors.hpp"

namespace gearlash::drive::stick_slip_test {
namespace {

// ---- a mass on a belt ---------------------------------------------------------------------------

/// A mass on a spring, drawn at a steady speed, or held on a belt that moves at it.
struct Belt {
  double mass = 1.0;
  double spring = 1.0;
  double speed = 0.1;
  double breakaway = 0.5;
  double sliding = 0.3;

  double frequency() const { return std::sqrt(spring / mass); }
  /// Of the spring's length beyond that of steady sliding, at breakaway.
  double excess() const { return (breakaway - sliding) / spring; }

  // Sliding, z″ = −ω²(z − sliding/k) from z = breakaway/k, z′ = v to z′ = v again; then held.
  double size() const { return std::hypot(excess(), speed / frequency()); }
  double period() const {
    const double slide =
        2.0 / frequency() * (std::numbers::pi - std::atan(excess() * frequency() / speed));
    return slide + 2.0 * excess() / speed;
  }
};

/// x the mass's position, fast and slow side of friction never reversed.
hybrid::HybridSystem belt_system(const Belt& belt) {
  using hybrid::Direction;
  const double v = belt.speed;
  const double square = belt.spring / belt.mass;
  const hybrid::AffineMode held{
      .name = "held",
      .flow = {hybrid::Matrix::Zero(2, 2), hybrid::Vector{{v, 0.0}}},
      .transitions = {{.name = "breaks away",
                       .guard = {hybrid::Vector{{belt.spring, 0.0}}, -belt.breakaway},
                       .direction = Direction::rising,
                       .target = 1}}};
  const hybrid::AffineMode slides{
      .name = "slides",
      .flow = {hybrid::Matrix{{0.0, 1.0}, {-square, 0.0}},
               hybrid::Vector{{0.0, belt.sliding / belt.mass}}},
      .transitions = {{.name = "is caught",
                       .guard = {hybrid::Vector{{0.0, 1.0}}, -v},
                       .direction = Direction::rising,
                       .reset = {hybrid::Matrix{{1.0, 0.0}, {0.0, 0.0}}, hybrid::Vector{{0.0, v}}},
                       .target = 0}}};
  return {.state_names = {"position", "speed"}, .modes = {held, slides}};
}

/// The same seen from the ground: shafts that stay together, drawn by proportional control, the
/// friction on the load.
ReducedDrive belt_drive(const Belt& belt) {
  ReducedDrive drive;
  drive.motor.inertia = 0.9 * belt.mass;
  drive.load = {0.1 * belt.mass, {.coulomb = belt.sliding, .breakaway = belt.breakaway}};
  drive.backlash = 0.1;
  drive.contact = RigidContact{0.0};
  drive.controller = ProportionalDerivative{belt.spring, 0.0};
  drive.reference = Ramp{0.0, belt.speed, 0.0};
  return drive;
}

/// Each half swing takes 2 F/K off the amplitude; the shaft stays where the spring's torque is
/// below the breakaway as it stops, though above what friction is while it slides.
TEST(OracleStickSlip, AShaftThatStopsWithinItsBreakawayStaysThere) {
  ReducedDrive drive;
  drive.motor = {2.0, {.coulomb = 0.3, .breakaway = 0.5}};
  drive.load.inertia = 1.0;
  drive.backlash = 1e6;  // the motor is by itself
  drive.sensing.load_share_of_position = 0.0;
  drive.controller = ProportionalDerivative{1.0, 0.0};
  const DriveSystem built = drive_system(drive);
  for (const auto& [start, end] : {std::pair{1.0, -0.4}, std::pair{1.3, 0.1}, {-1.0, 0.4}}) {
    const auto motion = simulate(built.system, drive_start(drive, built, {.motor_position = start}),
                                 {.until = 99.0});
    EXPECT_NEAR(motion.end().numbers[motor_position], end, 1e-14) << start;
    EXPECT_EQ(motion.end().numbers[motor_speed], 0.0) << start;
  }
}

std::vector<Belt> random_belts() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Belt> belts = {Belt{}};
  for (int i = 0; i < 9; ++i) {
    Belt belt;
    belt.mass = 0.5 + share(random);
    belt.spring = 0.5 + share(random);
    belt.speed = 0.05 + 0.2 * share(random);
    belt.sliding = 0.3 + 0.2 * share(random);
    belt.breakaway = belt.sliding * (1.2 + 0.5 * share(random));
    belts.push_back(belt);
  }
  return belts;
}

TEST(OracleStickSlip, AMassOnABeltIsTheClosedForm) {
  for (const Belt& belt : random_belts()) {
    const hybrid::HybridSystem system = belt_system(belt);
    const auto motion =
        simulate(system, {0, hybrid::Vector{{0.0, belt.speed}}}, {.until = 8.0 * belt.period()});
    const auto orbit = closing_orbit(system, motion);
    ASSERT_TRUE(orbit);
    EXPECT_NEAR(orbit->period, belt.period(), 1e-12 * belt.period());
    EXPECT_LT(std::abs(orbit->multipliers.front()), 1e-12);  // each sticking forgets
  }
}

/// Without viscous friction the mass may also swing at its own frequency and never be caught: a
/// family of cycles, of any amplitude below v/ω, that share the period 2π/ω.
TEST(OracleStickSlip, SwingsThatAreNeverCaughtAreAFamily) {
  const Belt belt;
  const double center = -belt.sliding / belt.spring;
  AttractorOptions options;
  for (const double amplitude : {0.02, 0.05, 0.09}) {
    const double load = center + amplitude;
    options.starts.push_back({load + 0.05, belt.speed, load, belt.speed});
  }
  const AttractorSearch found = find_attractors(belt_drive(belt), options);
  ASSERT_EQ(found.cycles.size(), 1U);
  const FoundCycle& cycle = found.cycles.front();
  EXPECT_EQ(cycle.starts, 3U);
  EXPECT_EQ(cycle.stability, Stability::neutral);
  EXPECT_NEAR(cycle.period(), 2.0 * std::numbers::pi, 1e-10);
  EXPECT_NEAR(cycle.amplitudes.low, 0.02, 1e-10);
  EXPECT_NEAR(cycle.amplitudes.high, 0.09, 1e-10);
  EXPECT_NEAR(cycle.center, center, 1e-10);
}

/// A disturbance is forgotten in each sticking: what is left is rounding.
TEST(OracleStickSlip, ADriveThatDrawsALoadIsTheMassOnABelt) {
  for (const Belt& belt : random_belts()) {
    const AttractorSearch found = find_attractors(
        belt_drive(belt), {.starts = {{0.05, 0.0, 0.0, 0.0}, {-0.25, 0.0, -0.3, 0.0}}});
    EXPECT_EQ(found.coordinates, Coordinates::co_moving);
    ASSERT_EQ(found.cycles.size(), 1U);
    const FoundCycle& cycle = found.cycles.front();
    EXPECT_EQ(cycle.starts, 2U);
    EXPECT_NEAR(cycle.amplitude, belt.size(), 1e-12 * belt.size());
    EXPECT_NEAR(cycle.period(), belt.period(), 1e-12 * belt.period());
    EXPECT_NEAR(cycle.center, -belt.sliding / belt.spring, 1e-12);
    EXPECT_LT(cycle.multiplier, 1e-12);
  }
}

// ---- a PID drive that hunts by stiction ---------------------------------------------------------

using Digits50 = boost::multiprecision::cpp_dec_float_50;

/// Friction on the motor, sensor of position on the load, of speed on the motor, plastic faces.
struct StictionDrive {
  double motor_inertia = 1.0;
  double load_inertia = 0.25;
  double motor_friction = 0.25;
  double load_friction = 0.125;
  double sliding = 0.25;
  double breakaway = 0.375;
  double backlash = 0.03125;
  double proportional = 4.0;
  double integral = 1.0;
  double derivative = 2.0;

  ReducedDrive drive() const {
    ReducedDrive result;
    result.motor = {motor_inertia,
                    {.viscous = motor_friction, .coulomb = sliding, .breakaway = breakaway}};
    result.load = {load_inertia, {.viscous = load_friction}};
    result.backlash = backlash;
    result.contact = RigidContact{0.0};
    result.controller = ProportionalIntegralDerivative{.proportional = proportional,
                                                       .integral = integral,
                                                       .derivative = derivative,
                                                       .derivative_of_speed = true};
    return result;
  }
};

/// The same by hand, apart from Gearlash: Taylor steps of one length, events by bisection and
/// Newton's method on the series.
class StictionReference {
 public:
  explicit StictionReference(const StictionDrive& drive) : d_(drive) {
    // Pressed against the forward face, at rest, the error at its largest.
    x_[motor] = Digits50(0.5) + Digits50(d_.backlash) / 2;
    x_[load] = Digits50(0.5);
  }

  struct Turn {
    Digits50 time;
    Digits50 value;
  };
  /// Where the load turned or came to rest, moving backward before.
  const std::vector<Turn>& lows() const { return lows_; }
  const std::vector<Turn>& highs() const { return highs_; }

  void run(double until) {
    while (time_ < until) step();
  }

 private:
  enum Number { motor, motor_speed, load, load_speed, integral, numbers };
  using State = std::array<Digits50, numbers>;
  static constexpr int order = 34;
  static constexpr double length = 0.125;

  Digits50 torque(const State& x) const {
    return d_.integral * x[integral] - d_.proportional * x[load] - d_.derivative * x[motor_speed];
  }

  /// Of the k-th term of the series; what is constant counts in the first alone.
  State slope(const State& x, bool is_first) const {
    State dx;
    dx[motor] = x[motor_speed];
    dx[load] = x[load_speed];
    dx[integral] = -x[load];
    const Digits50 friction = is_first ? Digits50(way_ * d_.sliding) : Digits50(0);
    if (face_ == 0) {
      dx[motor_speed] = 0;
      if (way_ != 0) {
        dx[motor_speed] =
            (torque(x) - d_.motor_friction * x[motor_speed] - friction) / d_.motor_inertia;
      }
      dx[load_speed] = -d_.load_friction * x[load_speed] / d_.load_inertia;
    } else {
      dx[motor_speed] = 0;
      if (way_ != 0) {
        dx[motor_speed] =
            (torque(x) - (d_.motor_friction + d_.load_friction) * x[motor_speed] - friction) /
            (d_.motor_inertia + d_.load_inertia);
      }
      dx[load_speed] = dx[motor_speed];
    }
    return dx;
  }

  /// What must not fall below 0 in a mode.
  enum Guard { meets_forward, meets_backward, stops, breaks_forward, breaks_backward, parts };
  std::vector<Guard> guards() const {
    std::vector<Guard> all;
    if (face_ == 0) all = {meets_forward, meets_backward};
    if (way_ != 0) all.push_back(stops);
    if (way_ == 0) all.insert(all.end(), {breaks_forward, breaks_backward});
    if (face_ != 0 && way_ != 0) all.push_back(parts);
    return all;
  }
  Digits50 at(Guard guard, const State& x) const {
    switch (guard) {
      case meets_forward:
        return Digits50(d_.backlash) / 2 - (x[motor] - x[load]);
      case meets_backward:
        return Digits50(d_.backlash) / 2 + (x[motor] - x[load]);
      case stops:
        return way_ * x[motor_speed];
      case breaks_forward:
        return d_.breakaway - torque(x);
      case breaks_backward:
        return d_.breakaway + torque(x);
      case parts:
        break;
    }
    return face_ *
           (d_.load_inertia * slope(x, true)[load_speed] + d_.load_friction * x[load_speed]);
  }

  State value(const std::vector<State>& terms, const Digits50& share) const {
    State sum = terms.back();
    for (std::size_t k = terms.size() - 1; k-- > 0;) {
      for (std::size_t i = 0; i < numbers; ++i) sum[i] = sum[i] * share + terms[k][i];
    }
    return sum;
  }

  /// The first share of the step at which a form is 0 that is negative at `end` and not before.
  template <class Form>
  Digits50 zero(const std::vector<State>& terms, Form&& form, Digits50 end) const {
    Digits50 low = 0;
    Digits50 high = end;
    Digits50 at_low = form(value(terms, low));
    Digits50 at_high = form(value(terms, high));
    for (int i = 0; i < 200 && high - low > Digits50("1e-45"); ++i) {
      // Regula falsi (Illinois), with a halving now and then.
      Digits50 middle = i % 3 == 2 || at_low == at_high
                            ? Digits50((low + high) / 2)
                            : Digits50((low * at_high - high * at_low) / (at_high - at_low));
      if (!(middle > low && middle < high)) middle = (low + high) / 2;
      const Digits50 here = form(value(terms, middle));
      (here < 0 ? high : low) = middle;
      (here < 0 ? at_high : at_low) = here;
    }
    return high;
  }

  void step() {
    std::vector<State> terms = {x_};
    const Digits50 h = length;
    for (int k = 1; k <= order; ++k) {
      State term = slope(terms.back(), k == 1);
      for (Digits50& number : term) number *= h / k;
      terms.push_back(std::move(term));
    }
    const State end = value(terms, 1);
    Digits50 share = 1;
    bool fires = false;
    Guard which = stops;
    for (const Guard guard : guards()) {
      if (!(at(guard, fires ? value(terms, share) : end) < 0)) continue;
      if (fired_now_ && guard == fired_ && at(guard, x_) <= 0) continue;
      share = zero(
          terms, [&](const State& x) { return at(guard, x); }, share);
      fires = true;
      which = guard;
    }
    const State next = fires ? value(terms, share) : end;
    note_turn(terms, next, share);
    x_ = next;
    time_ += share * h;
    fired_now_ = false;
    if (fires) fire(which);
  }

  void note_turn(const std::vector<State>& terms, const State& next, const Digits50& share) {
    const Digits50 before = x_[load_speed];
    const Digits50 after = next[load_speed];
    if (before * after >= 0) return;
    const double sign = before > 0 ? 1.0 : -1.0;
    const Digits50 at_turn = zero(
        terms, [&](const State& x) { return Digits50(sign * x[load_speed]); }, share);
    note(time_ + at_turn * length, value(terms, at_turn)[load], sign > 0.0);
  }

  void note(const Digits50& time, const Digits50& where, bool is_high) {
    (is_high ? highs_ : lows_).push_back({time, where});
  }

  void fire(Guard guard) {
    fired_ = guard;
    fired_now_ = true;
    if (guard == meets_forward || guard == meets_backward) {
      const Digits50 before = x_[load_speed];
      const Digits50 common = (d_.motor_inertia * x_[motor_speed] + d_.load_inertia * before) /
                              (d_.motor_inertia + d_.load_inertia);
      x_[motor_speed] = x_[load_speed] = common;
      if (before * common < 0) note(time_, x_[load], before > 0);
      face_ = guard == meets_forward ? 1 : -1;
      way_ = common > 0 ? 1 : -1;
    } else if (guard == stops) {
      if (face_ != 0 && x_[load_speed] != 0) note(time_, x_[load], way_ > 0);
      x_[motor_speed] = 0;
      if (face_ != 0) x_[load_speed] = 0;
      way_ = 0;
    } else if (guard == parts) {
      face_ = 0;
    } else {
      way_ = guard == breaks_forward ? 1 : -1;
      if (face_ != 0 && way_ != face_) face_ = 0;
    }
  }

  StictionDrive d_;
  State x_{};
  Digits50 time_ = 0;
  int face_ = 1;
  int way_ = 0;
  Guard fired_ = stops;
  bool fired_now_ = false;
  std::vector<Turn> lows_;
  std::vector<Turn> highs_;
};

TEST(OracleStickSlip, APidDriveWithStictionHuntsAsIn50Digits) {
  const StictionDrive parameters;
  const AttractorSearch found = find_attractors(
      parameters.drive(),
      {.starts = {{0.515625, 0.0, 0.5, 0.0}, {0.0, 0.0, 0.01, 0.0}, {5.0, 0.0, 5.0, 0.0}}});
  ASSERT_EQ(found.cycles.size(), 1U);
  const FoundCycle& cycle = found.cycles.front();
  EXPECT_EQ(cycle.starts, 3U);
  EXPECT_EQ(cycle.stability, Stability::stable);

  StictionReference reference(parameters);
  reference.run(40.0 * cycle.period());
  const auto& lows = reference.lows();
  const auto& highs = reference.highs();
  ASSERT_GT(lows.size(), 20U);
  // The deepest low of the last period, and the highest high; the period from low to like low.
  const auto deepest = [&](const std::vector<StictionReference::Turn>& turns, double from,
                           double to, double sign) {
    const StictionReference::Turn* best = nullptr;
    for (const auto& turn : turns) {
      if (turn.time < from || turn.time >= to) continue;
      if (best == nullptr || sign * turn.value > sign * best->value) best = &turn;
    }
    return *best;
  };
  const double period = cycle.period();
  const double end = 40.0 * period;
  const auto high = deepest(highs, end - 1.1 * period, end, 1.0);
  const auto low = deepest(lows, end - 1.1 * period, end, -1.0);
  const double amplitude = static_cast<double>((high.value - low.value) / 2);
  EXPECT_NEAR(cycle.amplitude, amplitude, 1e-10 * amplitude);
  const double time = static_cast<double>(high.time);
  const auto earlier = deepest(highs, time - 1.25 * period, time - 0.75 * period, 1.0);
  const double measured = static_cast<double>(high.time - earlier.time);
  EXPECT_NEAR(period, measured, 1e-10 * measured);
}

// ---- faces that give, as they become rigid ------------------------------------------------------

/// The thesis's servo with ω_n = 1.
ReducedDrive thesis_servo(const Contact& contact) {
  ReducedDrive drive;
  drive.motor = {1.0 / 3.0, {.viscous = 0.38 * 0.9}};
  drive.load = {2.0 / 3.0, {.viscous = 0.38 * 0.1}};
  drive.backlash = 0.3;
  drive.contact = contact;
  drive.controller = ProportionalDerivative{1.0, 0.0};
  return drive;
}

double hunting_amplitude(const Contact& contact) {
  const AttractorSearch found =
      find_attractors(thesis_servo(contact), {.starts = {{0.45, 0.0, 0.3, 0.0}}});
  return found.cycles.empty() ? std::nan("") : found.cycles.front().amplitude;
}

/// Mean slopes of log error over log stiffness, from decade to decade.
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
    result.push_back(std::log10(std::abs(errors[i + 1] / errors[i])));
  }
  return result;
}

/// Damping in proportion to stiffness: at contact the relative speed is used up in a time μ/c and a
/// way of v μ/c, and what the spring then gives back is e ≈ μ k/c²; all go as 1/stiffness.
TEST(OracleCompliantToRigid, WithDampingAsStiffnessContactBecomesPlastic) {
  const double rigid = hunting_amplitude(RigidContact{0.0});
  std::vector<double> errors;
  for (const double stiffness : {1e3, 1e4, 1e5}) {
    errors.push_back(
        hunting_amplitude(CompliantContact{stiffness, 0.1 * stiffness, ContactDamping::full}) -
        rigid);
  }
  for (const double order : orders(errors)) EXPECT_NEAR(order, -1.0, 0.1);
  EXPECT_LT(std::abs(errors.back()), 1e-5);
}

/// Critical damping: a contact of k δ + c δ′ that never pulls lasts until ω t = 2 and gives back
/// e⁻² of the relative speed. So it tends to rigid faces of that restitution, by the time and way
/// of a contact, 1/ω.
TEST(OracleCompliantToRigid, WithCriticalDampingRestitutionIsExpMinus2) {
  const double rigid = hunting_amplitude(RigidContact{std::exp(-2.0)});
  constexpr double reduced_inertia = 2.0 / 9.0;
  std::vector<double> errors;
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    const double critical = 2.0 * std::sqrt(stiffness * reduced_inertia);
    errors.push_back(
        hunting_amplitude(CompliantContact{stiffness, critical, ContactDamping::full}) - rigid);
  }
  for (const double order : orders(errors)) EXPECT_NEAR(order, -0.5, 0.05);
}

}  // namespace
}  // namespace gearlash::drive::stick_slip_test
