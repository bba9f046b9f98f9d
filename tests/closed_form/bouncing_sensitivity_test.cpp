// Derivatives of cycles with bounces against central differences of their equations in seventy
// digits, written down afresh; bounces that accumulate are followed until they are 1e-20 as fast.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/range_check.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/cycle_sensitivity.hpp"
#include "closed_form/limit_cycle.hpp"
#include "closed_form/return_map.hpp"
#include "closed_form/trajectory.hpp"
#include "seventy_digits.hpp"

namespace gearlash::bouncing_sensitivity_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;  // by columns

struct Numbers {
  Real damping, inertia_ratio, friction_ratio, restitution;
};

Real determinant(const Matrix& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[2][1] * a[1][2]) -
         a[1][0] * (a[0][1] * a[2][2] - a[2][1] * a[0][2]) +
         a[2][0] * (a[0][1] * a[1][2] - a[1][1] * a[0][2]);
}

/// Of Ax = b, by Cramer's rule.
Vector solution(const Matrix& a, const Vector& b) {
  const Real whole = determinant(a);
  Vector x;
  for (std::size_t i = 0; i < 3; ++i) {
    Matrix replaced = a;
    replaced[i] = b;
    x[i] = determinant(replaced) / whole;
  }
  return x;
}

/// What happens over a period, as the simulator tells it: seventy digits follow.
std::vector<Event> events_of_period(const NormalizedServo& servo, const LimitCycle& cycle) {
  const double near = 1e-6 * cycle.period;
  const Trajectory motion =
      simulate(servo, cycle.start, {.until = cycle.period + near, .reference = 0.0});
  std::vector<Event> events;
  for (const Event& event : motion.events()) {
    if (event.time < near) continue;
    events.push_back(event);
    if (event.kind == EventKind::impact && std::abs(event.time - cycle.period) < near) break;
  }
  return events;
}

/// From the arrival (y, P, u̇) at the forward face that a period begins with to the one that ends
/// it.
class Period {
 public:
  Period(const Numbers& p, const Real& backlash, const std::vector<Event>& events,
         const Vector& arrival)
      : zeta_(p.damping),
        motor_inertia_(1 / (1 + p.inertia_ratio)),
        load_inertia_(p.inertia_ratio / (1 + p.inertia_ratio)),
        motor_friction_(2 * zeta_ * (1 - p.friction_ratio)),
        load_friction_(2 * zeta_ * p.friction_ratio),
        restitution_(p.restitution),
        half_gap_(backlash / 2) {
    now_ = {arrival[0], arrival[1] - motor_inertia_ * arrival[2], half_gap_, arrival[2]};
    largest_ = smallest_ = now_.position;
    impact();
    double last_time = 0.0;
    for (std::size_t i = 0; i < events.size(); ++i) {
      const Event& event = events[i];
      const double guess = event.time - last_time;
      last_time = event.time;
      if (event.kind == EventKind::impact) {
        fly_to(event.face == Face::forward ? half_gap_ : Real(-half_gap_), guess);
        if (i + 1 < events.size()) impact();
      } else if (event.kind == EventKind::settling) {
        bounce_out();
      } else {
        engage();
      }
    }
  }

  Vector arrival() const { return {now_.position, momentum(), now_.gap_speed}; }
  const Real& duration() const { return duration_; }
  Real amplitude() const { return (largest_ - smallest_) / 2; }

 private:
  struct State {
    Real position, speed, gap, gap_speed;  // of the load, and of the gap
  };

  Real momentum() const { return now_.speed + motor_inertia_ * now_.gap_speed; }

  /// By undetermined coefficients: J_M v̇ + F_M v + y = 0.
  State after_flight(const Real& t) const {
    const Real c = motor_friction_ / motor_inertia_;
    const Real d = load_friction_ / load_inertia_;
    const Real slow = exp(-d * t);
    const Real fast = exp(-c * t);
    const Real constant = -(now_.position + now_.speed / d) / motor_friction_;
    const Real of_load = now_.speed / d / (motor_friction_ - motor_inertia_ * d);
    const Real free = now_.speed + now_.gap_speed - constant - of_load;
    const Real way = (1 - slow) / d;
    const Real motor_moved = constant * t + of_load * way + free * (1 - fast) / c;
    return {now_.position + now_.speed * way, now_.speed * slow,
            now_.gap + motor_moved - now_.speed * way,
            constant + of_load * slow + free * fast - now_.speed * slow};
  }

  void fly_to(const Real& face, const Real& guess) {
    Real t = guess;
    for (int i = 0; i < 20; ++i) {
      const State at = after_flight(t);
      const Real step = (face - at.gap) / at.gap_speed;
      t += step;
      if (abs(step) < Real("1e-40") * t) break;
    }
    now_ = after_flight(t);
    now_.gap = face;
    duration_ += t;
    include(now_.position);
  }

  void impact() {
    now_.speed += motor_inertia_ * (1 + restitution_) * now_.gap_speed;
    now_.gap_speed *= -restitution_;
  }

  void bounce_out() {
    const Real first = abs(now_.gap_speed);
    while (abs(now_.gap_speed) > Real("1e-20") * first) {
      const Real acceleration = -motor_friction_ / motor_inertia_ * (now_.speed + now_.gap_speed) -
                                now_.position / motor_inertia_ +
                                load_friction_ / load_inertia_ * now_.speed;
      fly_to(now_.gap, -2 * now_.gap_speed / acceleration);
      impact();
    }
  }

  /// The faces move as one until F_L v + J_L v̇ = 0.
  void engage() {
    const Oscillation motion{zeta_, now_.position, momentum()};
    const Real duration = *motion.first_zero(
        -load_inertia_, load_friction_ * motor_inertia_ - motor_friction_ * load_inertia_);
    const auto turning = motion.first_zero(0, 1);
    if (turning && *turning < duration) include(motion.at(*turning).position);
    const Oscillation parting = motion.at(duration);
    now_ = {parting.position, parting.speed, now_.gap, 0};
    duration_ += duration;
  }

  void include(const Real& position) {
    if (position > largest_) largest_ = position;
    if (position < smallest_) smallest_ = position;
  }

  Real zeta_, motor_inertia_, load_inertia_, motor_friction_, load_friction_, restitution_;
  Real half_gap_;
  State now_;
  Real duration_ = 0, largest_, smallest_;
};

struct Cycle {
  Real amplitude, period, multiplier;
};

/// Of the eigenvalue of largest modulus, refined in seventy digits; of a pair, the modulus.
Real multiplier_of(const Matrix& m) {
  Eigen::Matrix3d rough;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      rough(i, j) =
          static_cast<double>(m[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)]);
    }
  }
  const Eigen::Vector3cd eigenvalues = rough.eigenvalues();
  Eigen::Index largest = 0;
  eigenvalues.cwiseAbs().maxCoeff(&largest);
  const bool is_real = eigenvalues(largest).imag() == 0.0;
  Eigen::Index real = largest;
  if (!is_real) eigenvalues.imag().cwiseAbs().minCoeff(&real);

  const Real trace = m[0][0] + m[1][1] + m[2][2];
  const Real minors = m[0][0] * m[1][1] - m[0][1] * m[1][0] + m[0][0] * m[2][2] -
                      m[0][2] * m[2][0] + m[1][1] * m[2][2] - m[1][2] * m[2][1];
  const Real whole = determinant(m);
  Real root = eigenvalues(real).real();
  for (int i = 0; i < 6; ++i) {
    root -= (((root - trace) * root + minors) * root - whole) /
            ((3 * root - 2 * trace) * root + minors);
  }
  return is_real ? root : Real(sqrt(minors - root * (trace - root)));
}

/// The cycle next to an arrival, by Newton's method.
Cycle cycle_near(const Numbers& numbers, const Real& backlash, const std::vector<Event>& events,
                 Vector arrival) {
  const auto period_from = [&](const Vector& start) {
    return Period(numbers, backlash, events, start);
  };
  const Real h = Real("1e-22") * backlash;
  Matrix slope;
  for (int step = 0;; ++step) {
    for (std::size_t column = 0; column < 3; ++column) {
      Vector above = arrival;
      Vector below = arrival;
      above[column] += h;
      below[column] -= h;
      const Vector up = period_from(above).arrival();
      const Vector down = period_from(below).arrival();
      for (std::size_t row = 0; row < 3; ++row)
        slope[column][row] = (up[row] - down[row]) / (2 * h);
    }
    const Vector end = period_from(arrival).arrival();
    Matrix mismatch_slope = slope;
    Vector mismatch;
    Real largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      mismatch_slope[i][i] -= 1;
      mismatch[i] = arrival[i] - end[i];
      largest = std::max<Real>(largest, abs(mismatch[i]));
    }
    if (largest < Real("1e-38") * backlash || step == 8) break;
    const Vector change = solution(mismatch_slope, mismatch);
    for (std::size_t i = 0; i < 3; ++i) arrival[i] += change[i];
  }
  const Period there = period_from(arrival);
  return {there.amplitude(), there.duration(), multiplier_of(slope)};
}

struct Field {
  const char* name;
  Real Numbers::*number;
  double NormalizedServo::*present;
  double ServoGradient::*slope;
};
const Field fields[] = {
    {"damping", &Numbers::damping, &NormalizedServo::damping, &ServoGradient::damping},
    {"inertia_ratio", &Numbers::inertia_ratio, &NormalizedServo::inertia_ratio,
     &ServoGradient::inertia_ratio},
    {"friction_ratio", &Numbers::friction_ratio, &NormalizedServo::friction_ratio,
     &ServoGradient::friction_ratio},
    {"restitution", &Numbers::restitution, &NormalizedServo::restitution,
     &ServoGradient::restitution}};

std::string describe(const NormalizedServo& s) {
  return "damping " + exact_text(s.damping) + " inertia_ratio " + exact_text(s.inertia_ratio) +
         " friction_ratio " + exact_text(s.friction_ratio) + " backlash " + exact_text(s.backlash) +
         " restitution " + exact_text(s.restitution);
}

/// Of drawn servos whose bounces settle or go on, of a pair of multipliers, of opposite ones of
/// half a period (it turns one disturbance round, and a whole period has two nearly equal ones), of
/// an asymmetric cycle that is weakly stable (the less a cycle resists, the more its derivatives
/// have of the map's second ones), and of a subharmonic one. Errors are shares of max(|derivative|,
/// |value/parameter|). The arrival that the cycle starts from is known to some epsilons/(1 − λ),
/// and hence are its derivatives.
TEST(OracleBouncingSensitivity, IsThatOfTheEquationsInManyDigits) {
  for (const Reference& exact : References("closed_form", "bouncing_slopes")) {
    const NormalizedServo servo{.damping = exact.input("damping"),
                                .inertia_ratio = exact.input("inertia_ratio"),
                                .friction_ratio = exact.input("friction_ratio"),
                                .backlash = exact.input("backlash"),
                                .restitution = exact.input("restitution")};
    SCOPED_TRACE(testing::Message() << exact.kind() << " " << servo.damping);
    const CycleSensitivity found = cycle_sensitivity(servo);
    ASSERT_TRUE(found.available());
    const double tolerance = 2048.0 * epsilon / (1.0 - std::abs(exact.input("multiplier")));
    compare(servo, found.amplitude, "amplitude", tolerance, exact);
    compare(servo, found.period, "period", tolerance, exact);
    compare(servo, found.multiplier, "multiplier", tolerance, exact);
  }
  return worst;
}

TEST(OracleBouncingSensitivity, DerivativesInSeventyDigits) {
  constexpr std::uint64_t seed = 2201;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  int settling = 0;
  int bouncing_on = 0;
  double worst = 0.0;
  while (settling + bouncing_on < 10) {
    const NormalizedServo servo{.damping = draws.uniform(0.05, 0.5),
                                .inertia_ratio = draws.log_uniform(0.2, 5.0),
                                .friction_ratio = draws.uniform(0.1, 0.9),
                                .backlash = draws.log_uniform(0.01, 1.0),
                                .restitution = draws.uniform(0.1, 0.9)};
    SCOPED_TRACE(describe(servo));
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    const LimitCycle* cycle = largest_stable(analysis);
    if (cycle == nullptr) continue;
    ++(cycle->settles ? settling : bouncing_on);
    worst = std::max(worst, compare(servo, *cycle));
  }
  EXPECT_GE(settling, 3);
  EXPECT_GE(bouncing_on, 3);
  RecordProperty("worst", exact_text(worst));
}

// ---- multipliers of every kind ------------------------------------------------------------------

constexpr NormalizedServo elastic{.damping = 0.34,
                                  .inertia_ratio = 0.94,
                                  .friction_ratio = 0.48,
                                  .backlash = 1.0,
                                  .restitution = 0.9};

NormalizedServo with_restitution(NormalizedServo servo, double restitution) {
  servo.restitution = restitution;
  return servo;
}

/// Of the map from arrival to arrival, of a symmetric cycle.
Eigen::Vector3cd eigenvalues_of(const NormalizedServo& servo) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle& cycle = analysis.cycles.at(0);
  EXPECT_EQ(cycle.kind, CycleKind::symmetric);
  return traverse(servo_dynamics(servo), arrival_of(servo, cycle)).slope.eigenvalues();
}

bool is_pair(const Eigen::Vector3cd& eigenvalues) { return !eigenvalues.imag().isZero(0.0); }

void compare_first_cycle(const NormalizedServo& servo, CycleKind kind) {
  SCOPED_TRACE(describe(servo));
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle& cycle = *largest_stable(analysis);
  EXPECT_EQ(cycle.kind, kind);
  const double worst = compare(servo, cycle);
  testing::Test::RecordProperty("worst", exact_text(worst));
}

TEST(OracleBouncingSensitivity, OfAPairOfMultipliers) {
  EXPECT_TRUE(is_pair(eigenvalues_of(elastic)));
  compare_first_cycle(elastic, CycleKind::symmetric);
}

/// Half a period turns one disturbance round; a whole one has two nearly equal multipliers.
TEST(OracleBouncingSensitivity, OfOppositeMultipliersOfHalfAPeriod) {
  const NormalizedServo servo = with_restitution(elastic, 0.472);
  const Eigen::Vector3cd eigenvalues = eigenvalues_of(servo);
  const double largest = eigenvalues.real().maxCoeff();
  EXPECT_NEAR(eigenvalues.real().minCoeff(), -largest, 0.02 * largest);
  compare_first_cycle(servo, CycleKind::symmetric);
}

/// The less a cycle resists, the more its derivatives have of the map's second ones.
TEST(OracleBouncingSensitivity, OfAWeaklyStableAsymmetricCycle) {
  const NormalizedServo servo{.damping = 0.19,
                              .inertia_ratio = 2.0,
                              .friction_ratio = 0.1,
                              .backlash = 0.3,
                              .restitution = 0.6};
  compare_first_cycle(servo, CycleKind::asymmetric);
}

TEST(OracleBouncingSensitivity, OfASubharmonicCycle) {
  const NormalizedServo servo{.damping = 0.121354,
                              .inertia_ratio = 1.80297,
                              .friction_ratio = 0.686046,
                              .backlash = 0.170371,
                              .restitution = 0.602605};
  compare_first_cycle(servo, CycleKind::subharmonic);
}

/// Where a pair comes together its modulus has no derivative; beside, and of all else, there is.
TEST(EdgeBouncingSensitivity, ADoubleMultiplierHasNoDerivative) {
  double apart = 0.8;
  double pair = 0.85;
  ASSERT_FALSE(is_pair(eigenvalues_of(with_restitution(elastic, apart))));
  ASSERT_TRUE(is_pair(eigenvalues_of(with_restitution(elastic, pair))));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (apart + pair);
    (is_pair(eigenvalues_of(with_restitution(elastic, middle))) ? pair : apart) = middle;
  }
  const CycleSensitivity found = cycle_sensitivity(with_restitution(elastic, pair));
  ASSERT_TRUE(found.available());
  EXPECT_TRUE(std::isfinite(found.amplitude.slope.damping));
  EXPECT_TRUE(std::isfinite(found.period.slope.restitution));
  EXPECT_TRUE(std::isnan(found.multiplier.slope.damping));
  EXPECT_TRUE(std::isnan(found.multiplier.slope.restitution));
  const CycleSensitivity beside = cycle_sensitivity(with_restitution(elastic, pair + 1e-3));
  EXPECT_TRUE(std::isfinite(beside.multiplier.slope.damping));
}

}  // namespace
}  // namespace gearlash::bouncing_sensitivity_test
