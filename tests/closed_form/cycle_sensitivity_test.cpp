// Derivatives of the plastic cycle against central differences of its equations in seventy digits,
// written down afresh.
#include "closed_form/cycle_sensitivity.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "base/range_check.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "closed_form/limit_cycle.hpp"
#include "seventy_digits.hpp"

namespace gearlash::cycle_sensitivity_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// ---- the servo in seventy digits: straight exponentials, which seventy digits can afford
// -------------

struct Numbers {
  Real damping, inertia_ratio, friction_ratio;
};

class Servo {
 public:
  explicit Servo(const Numbers& p) : zeta_(p.damping) {
    motor_inertia_ = 1 / (1 + p.inertia_ratio);
    load_inertia_ = p.inertia_ratio / (1 + p.inertia_ratio);
    motor_friction_ = 2 * zeta_ * (1 - p.friction_ratio);
    c_ = motor_friction_ / motor_inertia_;
    d_ = 2 * zeta_ * p.friction_ratio / load_inertia_;
    start_ = d_ - 2 * zeta_;
  }

  struct Impact {
    Real position, common_speed, gap;
  };

  /// After a flight from (D − 2ζ, 1): J_M v̇ + F_M v + y = 0 by undetermined coefficients.
  Impact impact(const Real& t) const {
    const Real slow = exp(-d_ * t);
    const Real fast = exp(-c_ * t);
    const Real rest = start_ + 1 / d_;
    const Real constant = -rest / motor_friction_;
    const Real of_load = 1 / (d_ * (motor_friction_ - motor_inertia_ * d_));
    const Real free = 1 - constant - of_load;
    const Real moved = (1 - slow) / d_;
    const Real motor_moved = constant * t + of_load * moved + free * (1 - fast) / c_;
    const Real motor_speed = constant + of_load * slow + free * fast;
    return {start_ + moved, motor_inertia_ * motor_speed + load_inertia_ * slow,
            moved - motor_moved};
  }

  struct Engagement {
    Oscillation motion;
    std::optional<Real> duration;
    Real growth;  ///< speed at the next parting, as a share of the one before
  };

  Engagement engagement(const Real& position, const Real& common_speed) const {
    Engagement engaged{{zeta_, position, common_speed}, std::nullopt, 0};
    engaged.duration = engaged.motion.first_zero(-1, start_);
    if (engaged.duration) engaged.growth = -engaged.motion.at(*engaged.duration).speed;
    return engaged;
  }

  Real growth(const Real& t) const {
    const Impact at = impact(t);
    return engagement(at.position, at.common_speed).growth;
  }

  /// The load at −y∞ = −1, the motor creeping at 1/F_M; speed at the parting times y∞ of unit
  /// speed.
  Real growth_at_rest() const {
    const Engagement engaged = engagement(-1, motor_inertia_ / motor_friction_);
    if (!engaged.duration) return 0;
    return abs(engaged.growth * (start_ + 1 / d_));
  }

  /// The root of growth(t) = 1 by the secant method.
  Real balanced_flight_time(const Real& guess) const {
    Real last = guess * (1 + Real(1e-8));
    Real t = guess;
    Real last_value = log(growth(last));
    for (int i = 0; i < 25; ++i) {
      const Real value = log(growth(t));
      if (value == last_value) break;
      const Real next = t - value * (t - last) / (value - last_value);
      last = t;
      last_value = value;
      t = next;
      if (abs(t - last) < Real("1e-50") * t) break;
    }
    return t;
  }

  struct Cycle {
    Real growth_at_rest, amplitude, period, multiplier;  ///< of unit backlash
  };

  Cycle cycle(double guess) const {
    Cycle cycle;
    cycle.growth_at_rest = growth_at_rest();
    if (!(guess > 0.0)) return cycle;
    const Real t = balanced_flight_time(guess);
    const Impact at = impact(t);
    const Engagement engaged = engagement(at.position, at.common_speed);
    cycle.period = 2 * (t + *engaged.duration);
    Real amplitude = std::max<Real>(abs(start_), abs(at.position));
    const auto turning = engaged.motion.first_zero(0, 1);
    if (turning && *turning < *engaged.duration) {
      amplitude = std::max<Real>(amplitude, abs(engaged.motion.at(*turning).position));
    }
    cycle.amplitude = amplitude / at.gap;
    // R(σ) = σ ρ(t), σ gap(t) = b.
    const Real h = t * Real("1e-13");
    const Real growth_slope = (growth(t + h) - growth(t - h)) / (2 * h);
    const Real gap_slope = (impact(t + h).gap - impact(t - h).gap) / (2 * h);
    const Real half_slope = 1 - growth_slope * at.gap / gap_slope;
    cycle.multiplier = half_slope * half_slope;
    return cycle;
  }

 private:
  Real zeta_, motor_inertia_, load_inertia_, motor_friction_, c_, d_, start_;
};

std::string describe(const NormalizedServo& s) {
  return "damping " + exact_text(s.damping) + " inertia_ratio " + exact_text(s.inertia_ratio) +
         " friction_ratio " + exact_text(s.friction_ratio) + " backlash " + exact_text(s.backlash);
}

/// The derivatives by one number: central differences; of relative step 1e-20 they are good to
/// 1e-18 or better next to the boundary.
struct Differences {
  Servo::Cycle value, slope;
};

Differences differences(const Numbers& here, Real Numbers::*number, double flight_time,
                        const Real& relative_step = Real("1e-20")) {
  Numbers low = here;
  Numbers high = here;
  const Real step = here.*number * relative_step;
  low.*number -= step;
  high.*number += step;
  const Servo::Cycle at_low = Servo(low).cycle(flight_time);
  const Servo::Cycle at_high = Servo(high).cycle(flight_time);
  const auto of = [&](Real Servo::Cycle::*quantity) -> Real {
    return (at_high.*quantity - at_low.*quantity) / (2 * step);
  };
  return {Servo(here).cycle(flight_time),
          {of(&Servo::Cycle::growth_at_rest), of(&Servo::Cycle::amplitude),
           of(&Servo::Cycle::period), of(&Servo::Cycle::multiplier)}};
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
     &ServoGradient::friction_ratio}};

/// Of errors, as shares of max(|derivative|, |value/parameter|).
constexpr double growth_tolerance = 64.0 * epsilon;
constexpr double cycle_tolerance = 512.0 * epsilon;

/// The largest error met, by quantity, as a share of its tolerance.
struct Worst {
  double growth = 0.0, amplitude = 0.0, period = 0.0, multiplier = 0.0;
};

double error_of(const SensitiveValue& found, const Field& field, double present, const Real& value,
                const Real& slope) {
  const Real scale = std::max<Real>(abs(slope), abs(value / present));
  if (scale == 0) return std::abs(found.slope.*field.slope);
  return static_cast<double>(abs(found.slope.*field.slope - slope) / scale);
}

void compare(const NormalizedServo& servo, Worst& worst, double allowance = 1.0) {
  const CycleSensitivity found = cycle_sensitivity(servo);
  double flight_time = 0.0;
  if (found.available()) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    flight_time = 0.5 * analysis.cycles.at(0).separated_time;
    EXPECT_EQ(found.amplitude.value, analysis.cycles[0].amplitude);
    EXPECT_EQ(found.period.value, analysis.cycles[0].period);
    EXPECT_EQ(found.multiplier.value, analysis.cycles[0].multiplier);
    EXPECT_EQ(found.amplitude.slope.backlash, found.amplitude.value / servo.backlash);
  }
  for (const Field& field : fields) {
    const double present = servo.*field.present;
    const Differences exact = differences(
        {servo.damping, servo.inertia_ratio, servo.friction_ratio}, field.number, flight_time);
    const auto expect_near = [&](const char* quantity, double error, double tolerance,
                                 double& largest) {
      EXPECT_LE(error, tolerance) << describe(servo) << ": " << quantity << " by " << field.name;
      largest = std::max(largest, error / tolerance);
    };
    const double growth = error_of(found.growth_at_rest, field, present, exact.value.growth_at_rest,
                                   exact.slope.growth_at_rest);
    expect_near("growth", growth, growth_tolerance, worst.growth);
    if (!found.available()) continue;
    const double tolerance = allowance * cycle_tolerance;
    const double amplitude =
        error_of(found.amplitude, field, present, exact.value.amplitude * servo.backlash,
                 exact.slope.amplitude * servo.backlash);
    const double period =
        error_of(found.period, field, present, exact.value.period, exact.slope.period);
    const double multiplier =
        error_of(found.multiplier, field, present, exact.value.multiplier, exact.slope.multiplier);
    expect_near("amplitude", amplitude, tolerance, worst.amplitude);
    expect_near("period", period, tolerance, worst.period);
    expect_near("multiplier", multiplier, tolerance, worst.multiplier);
  }
}

/// For the record of the test, and so that the tolerances stay near the errors.
void record(const Worst& worst) {
  testing::Test::RecordProperty("worst_growth", exact_text(worst.growth));
  testing::Test::RecordProperty("worst_amplitude", exact_text(worst.amplitude));
  testing::Test::RecordProperty("worst_period", exact_text(worst.period));
  testing::Test::RecordProperty("worst_multiplier", exact_text(worst.multiplier));
}

NormalizedServo drawn_servo(SeededDraws& draws) {
  return {.damping = draws.log_uniform(0.01, 3.0),
          .inertia_ratio = draws.log_uniform(1e-3, 1e3),
          .friction_ratio = draws.uniform(0.01, 0.99),
          .backlash = draws.log_uniform(1e-3, 1.0)};
}

double growth_of(const NormalizedServo& servo) { return growth_at_rest(servo_dynamics(servo)); }

TEST(OracleCycleSensitivity, DerivativesOfThousandServosInSeventyDigits) {
  constexpr std::uint64_t seed = 2101;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Worst worst;
  int hunting = 0;
  for (int i = 0; i < 1000; ++i) {
    NormalizedServo servo = drawn_servo(draws);
    // Two in three hunt; the others have their growth at rest alone.
    while (i % 3 != 0 && !(growth_of(servo) > 1.0 + 1e-6)) servo = drawn_servo(draws);
    hunting += growth_of(servo) > 1.0;
    compare(servo, worst);
  }
  EXPECT_GE(hunting, 667);
  record(worst);
}

/// The friction ratio at which growth at rest is `growth`, between two that have it between theirs.
std::optional<NormalizedServo> with_growth(NormalizedServo servo, double growth) {
  double low = servo.friction_ratio;
  double high = low < 0.5 ? 1e-4 : 1.0 - 1e-4;  // where it hunts
  servo.friction_ratio = high;
  if (!(growth_of(servo) > growth)) return std::nullopt;
  servo.friction_ratio = low;
  if (!(growth_of(servo) < growth)) return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    servo.friction_ratio = 0.5 * (low + high);
    (growth_of(servo) < growth ? low : high) = servo.friction_ratio;
  }
  return servo;
}

/// The derivatives, as 1/ln μ₀ there, are asked for to 1e-9; what is allowed is below 1e-12. The
/// farther a rate, or the share of a friction, is from the other's, the more of it is needed.
TEST(OracleCycleSensitivity, DerivativesNextToTheBoundaryInSeventyDigits) {
  constexpr std::uint64_t seed = 2102;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Worst worst;
  int compared = 0;
  while (compared < 200) {
    const double excess = draws.log_uniform(1e-10, 1e-1);
    const auto servo = with_growth(drawn_servo(draws), 1.0 + excess);
    if (!servo) continue;
    ++compared;
    compare(*servo, worst, 8.0);
  }
  record(worst);
}

/// ∂ ln ρ, of order ζ, is a sum of terms of order t₂ ~ (8πζ)^¼: some digits go, not many.
TEST(OracleCycleSensitivity, LightDampingKeepsItsDigits) {
  constexpr std::uint64_t seed = 2103;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Worst worst;
  for (int i = 0; i < 100; ++i) {
    NormalizedServo servo = drawn_servo(draws);
    servo.damping = draws.log_uniform(1e-6, 1e-2);
    compare(servo, worst, 8.0);
  }
  record(worst);
}

TEST(OracleCycleSensitivity, CriticalDampingIsAnOrdinaryPoint) {
  constexpr std::uint64_t seed = 2104;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Worst worst;
  for (int i = 0; i < 100; ++i) {
    NormalizedServo servo;
    do {  // far below 1 growth at rest dies as exp(−π/√(1−ζ²)), and none can keep its digits
      servo = drawn_servo(draws);
      servo.damping = 1.0 + draws.either_sign(1e-12, 1e-2);
    } while (growth_of(servo) < 0.1);
    compare(servo, worst);
  }
  record(worst);
}

// ---- a massless side ----------------------------------------------------------------------------

/// A side of this share of the inertia is as good as massless; of what it changes seventy digits,
/// a dozen of them lost in the multiplier's own difference, leave enough.
const Real hardly_any("1e-14");
const Real massless_step("1e-10");

struct MasslessErrors {
  double by_damping_and_friction = 0.0;
  double by_inertia = 0.0;
};

/// Of derivatives, as shares of max(|derivative|, |value|), or by the inertia max(|derivative|,
/// |value|/F): what a light side does it does by J/F.
void compare_massless(const NormalizedServo& servo, MasslessErrors& worst) {
  const bool is_motor = std::isinf(servo.inertia_ratio);
  const CycleSensitivity found = cycle_sensitivity(servo);
  ASSERT_TRUE(found.available() || found.outcome == SensitivityOutcome::no_cycle);
  double flight_time = 0.0;
  if (found.available()) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    flight_time = 0.5 * analysis.cycles.at(0).separated_time;
    EXPECT_EQ(found.amplitude.value, analysis.cycles[0].amplitude);
    EXPECT_EQ(found.amplitude.slope.backlash, found.amplitude.value / servo.backlash);
  }
  const Numbers here{servo.damping, is_motor ? Real(1 / hardly_any) : hardly_any,
                     servo.friction_ratio};
  const Real light_friction =
      2.0 * servo.damping * (is_motor ? 1.0 - servo.friction_ratio : servo.friction_ratio);
  const auto expect_near = [&](const SensitiveValue& quantity, double ServoGradient::*number,
                               const Real& least_scale, const Real& slope, double& largest) {
    const double tolerance = number == &ServoGradient::load_share ? 1e-9 : 1e-11;
    const Real scale = std::max<Real>(abs(slope), least_scale);
    const double error = static_cast<double>(abs(quantity.slope.*number - slope) / scale);
    EXPECT_LE(error, tolerance) << describe(servo);
    largest = std::max(largest, error);
  };
  const auto compare_by = [&](Real Numbers::*number, double ServoGradient::*slope, const Real& rate,
                              double& largest) {
    const Real per = rate == 1 ? Real(1) : light_friction;
    const Differences exact = differences(here, number, flight_time, massless_step);
    const auto near = [&](const SensitiveValue& quantity, Real Servo::Cycle::*of,
                          const Real& unit) {
      expect_near(quantity, slope, abs(exact.value.*of * unit) / per, exact.slope.*of * unit * rate,
                  largest);
    };
    near(found.growth_at_rest, &Servo::Cycle::growth_at_rest, 1);
    if (!found.available()) return;
    near(found.amplitude, &Servo::Cycle::amplitude, servo.backlash);
    near(found.period, &Servo::Cycle::period, 1);
    near(found.multiplier, &Servo::Cycle::multiplier, 1);
  };
  compare_by(&Numbers::damping, &ServoGradient::damping, 1, worst.by_damping_and_friction);
  compare_by(&Numbers::friction_ratio, &ServoGradient::friction_ratio, 1,
             worst.by_damping_and_friction);
  const Real whole = 1 + here.inertia_ratio;
  compare_by(&Numbers::inertia_ratio, &ServoGradient::load_share, whole * whole, worst.by_inertia);
}

TEST(OracleCycleSensitivity, MasslessSidesInSeventyDigits) {
  constexpr std::uint64_t seed = 2105;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  MasslessErrors worst;
  for (int i = 0; i < 200; ++i) {
    NormalizedServo servo;
    do {
      servo = drawn_servo(draws);
      servo.inertia_ratio = i % 2 == 0 ? 0.0 : std::numeric_limits<double>::infinity();
    } while (growth_of(servo) < (i % 4 < 2 ? 0.1 : 1.0 + 1e-6));
    compare_massless(servo, worst);
  }
  RecordProperty("worst", exact_text(worst.by_damping_and_friction));
  RecordProperty("worst_by_inertia", exact_text(worst.by_inertia));
}

// ---- edges --------------------------------------------------------------------------------------

constexpr NormalizedServo sample{
    .damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3};

/// By Richardson's extrapolation of central differences, good to some 1e-9 of value/parameter.
double numerical_slope(const NormalizedServo& servo, double NormalizedServo::*number, double step,
                       double LimitCycle::*quantity) {
  const auto at = [&](double shift) {
    NormalizedServo changed = servo;
    changed.*number += shift;
    return analyse_limit_cycles(changed).cycles.at(0).*quantity;
  };
  const auto difference = [&](double h) { return (at(h) - at(-h)) / (2.0 * h); };
  return (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
}

TEST(EdgeCycleSensitivity, EqualRatesAndExactlyCriticalDamping) {
  // c = D where the shares of friction and inertia agree.
  for (const NormalizedServo& servo :
       {NormalizedServo{0.1, 1.0, 0.5, 1.0}, NormalizedServo{0.1, 3.0, 0.75, 1.0},
        NormalizedServo{1.0, 100.0, 0.02, 1.0}, NormalizedServo{1.0, 0.01, 0.98, 1.0}}) {
    SCOPED_TRACE(describe(servo));
    const CycleSensitivity found = cycle_sensitivity(servo);
    ASSERT_TRUE(found.available());
    for (const Field& field : fields) {
      const double step = 1e-3 * std::min(servo.*field.present, 1.0 - servo.friction_ratio);
      const auto expect_near = [&](const SensitiveValue& value, double LimitCycle::*quantity) {
        EXPECT_NEAR(
            value.slope.*field.slope, numerical_slope(servo, field.present, step, quantity),
            1e-8 * (std::abs(value.slope.*field.slope) + value.value / servo.*field.present))
            << field.name;
      };
      expect_near(found.amplitude, &LimitCycle::amplitude);
      expect_near(found.period, &LimitCycle::period);
      expect_near(found.multiplier, &LimitCycle::multiplier);
    }
  }
}

TEST(EdgeCycleSensitivity, FrictionOnOneSideAloneHasACycleAndNoGrowthToDifferentiate) {
  for (const double friction_ratio : {0.0, 1.0}) {
    NormalizedServo servo = sample;
    servo.friction_ratio = friction_ratio;
    const CycleSensitivity found = cycle_sensitivity(servo);
    ASSERT_TRUE(found.available());
    EXPECT_TRUE(std::isinf(found.growth_at_rest.value));
    EXPECT_TRUE(std::isnan(found.growth_at_rest.slope.damping));
    EXPECT_NEAR(found.amplitude.slope.damping,
                numerical_slope(servo, &NormalizedServo::damping, 1e-3, &LimitCycle::amplitude),
                1e-8);
    EXPECT_TRUE(std::isfinite(found.amplitude.slope.friction_ratio));
  }
}

TEST(EdgeCycleSensitivity, WithoutACycleTheGrowthAloneHasDerivatives) {
  NormalizedServo servo = sample;
  servo.damping = 0.9;
  servo.friction_ratio = 0.5;
  CycleSensitivity found = cycle_sensitivity(servo);
  EXPECT_EQ(found.outcome, SensitivityOutcome::no_cycle);
  EXPECT_LT(found.growth_at_rest.value, 1.0);
  EXPECT_LT(found.growth_at_rest.slope.damping, 0.0);
  EXPECT_TRUE(std::isnan(found.amplitude.value));
  EXPECT_TRUE(std::isnan(found.amplitude.slope.damping));
  servo = sample;
  servo.backlash = 0.0;
  found = cycle_sensitivity(servo);
  EXPECT_EQ(found.outcome, SensitivityOutcome::no_cycle);
  EXPECT_GT(found.growth_at_rest.value, 1.0);
}

TEST(EdgeCycleSensitivity, WhatIsNotWorkedOutSaysSo) {
  NormalizedServo servo = sample;
  servo.damping = 0.0;
  EXPECT_EQ(cycle_sensitivity(servo).outcome, SensitivityOutcome::undamped);
  servo.damping = -1.0;
  EXPECT_THROW(cycle_sensitivity(servo), InvalidInput);
}

/// Size, period, multiplier and growth at rest go back to those of e = 0 as e³, so that the
/// derivative from above is 0: with half the restitution an eighth is left.
TEST(PropertyCycleSensitivity, SmallRestitutionActsToThirdOrder) {
  for (const NormalizedServo& servo :
       {sample, NormalizedServo{0.3, 2.0, 0.3, 0.3}, NormalizedServo{0.1, 1.0, 0.2, 1.0}}) {
    SCOPED_TRACE(describe(servo));
    EXPECT_EQ(cycle_sensitivity(servo).amplitude.slope.restitution, 0.0);
    const LimitCycleAnalysis plastic = analyse_limit_cycles(servo);
    const auto with_bounces = [&](double restitution) {
      NormalizedServo bouncing = servo;
      bouncing.restitution = restitution;
      return analyse_limit_cycles(bouncing);
    };
    const LimitCycleAnalysis coarse = with_bounces(0.01);
    const LimitCycleAnalysis fine = with_bounces(0.005);
    const auto expect_third_order = [](double at_zero, double at_fine, double at_coarse) {
      EXPECT_LE(std::abs(at_fine - at_zero), 0.15 * std::abs(at_coarse - at_zero) + 1e-9 * at_zero);
      EXPECT_LE(std::abs(at_coarse - at_zero), 1e-4 * at_zero);
    };
    const LimitCycle& rest = plastic.cycles.at(0);
    const LimitCycle& near = *largest_stable(fine);
    const LimitCycle& far = *largest_stable(coarse);
    expect_third_order(rest.amplitude, near.amplitude, far.amplitude);
    expect_third_order(rest.period, near.period, far.period);
    expect_third_order(rest.multiplier, near.multiplier, far.multiplier);
    expect_third_order(plastic.growth_at_rest, fine.growth_at_rest, coarse.growth_at_rest);
  }
}

// ---- with bounces -------------------------------------------------------------------------------

const Field restitution_field = {"restitution", nullptr, &NormalizedServo::restitution,
                                 &ServoGradient::restitution};

/// Differences of analyse_limit_cycles(), extrapolated once, where its neighbours have a cycle of
/// the same kind.
void expect_agrees_with_differences(const NormalizedServo& servo, const Field& field,
                                    const CycleSensitivity& found) {
  const double present = servo.*field.present;
  const double step = 1e-4 * std::min(present, 1.0 - servo.friction_ratio);
  std::array<LimitCycleAnalysis, 4> neighbours;
  const LimitCycleAnalysis here = analyse_limit_cycles(servo);
  for (std::size_t i = 0; i < 4; ++i) {
    NormalizedServo changed = servo;
    changed.*field.present += std::array{-step, -0.5 * step, 0.5 * step, step}[i];
    neighbours[i] = analyse_limit_cycles(changed);
  }
  const auto slope_of = [&](const auto& quantity) {
    const double whole = (quantity(neighbours[3]) - quantity(neighbours[0])) / (2.0 * step);
    const double half = (quantity(neighbours[2]) - quantity(neighbours[1])) / step;
    return (4.0 * half - whole) / 3.0;
  };
  const auto expect_near = [&](const SensitiveValue& value, const auto& quantity) {
    const double exact = slope_of(quantity);
    EXPECT_NEAR(value.slope.*field.slope, exact,
                1e-7 * (std::abs(exact) + std::abs(value.value) / present))
        << field.name;
  };
  expect_near(found.growth_at_rest,
              [](const LimitCycleAnalysis& analysis) { return analysis.growth_at_rest; });
  if (!found.available()) return;
  for (const LimitCycleAnalysis& neighbour : neighbours) {
    const LimitCycle* cycle = largest_stable(neighbour);
    if (cycle == nullptr || cycle->impacts_per_period != largest_stable(here)->impacts_per_period) {
      return;
    }
  }
  const auto of_cycle = [](double LimitCycle::*quantity) {
    return [quantity](const LimitCycleAnalysis& analysis) {
      return largest_stable(analysis)->*quantity;
    };
  };
  expect_near(found.amplitude, of_cycle(&LimitCycle::amplitude));
  expect_near(found.period, of_cycle(&LimitCycle::period));
  expect_near(found.multiplier, of_cycle(&LimitCycle::multiplier));
}

TEST(PropertyCycleSensitivity, WithBouncesAgreesWithDifferences) {
  constexpr std::uint64_t seed = 2105;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  int available = 0;
  for (int i = 0; i < 25; ++i) {
    const NormalizedServo servo{.damping = draws.uniform(0.05, 0.5),
                                .inertia_ratio = draws.log_uniform(0.2, 5.0),
                                .friction_ratio = draws.uniform(0.1, 0.9),
                                .backlash = draws.log_uniform(0.01, 1.0),
                                .restitution = draws.uniform(0.02, 0.8)};
    SCOPED_TRACE(describe(servo) + " restitution " + exact_text(servo.restitution));
    const CycleSensitivity found = cycle_sensitivity(servo);
    EXPECT_NE(found.outcome, SensitivityOutcome::bounces);
    available += found.available();
    for (const Field& field : fields) expect_agrees_with_differences(servo, field, found);
    expect_agrees_with_differences(servo, restitution_field, found);
    if (!found.available()) continue;
    EXPECT_EQ(found.amplitude.slope.backlash, found.amplitude.value / servo.backlash);
    EXPECT_TRUE(std::isfinite(found.multiplier.slope.damping));
  }
  EXPECT_GE(available, 12);
}

TEST(CycleSensitivity, OfAnAsymmetricCycleWhoseBouncesDoNotSettle) {
  NormalizedServo servo = sample;
  servo.restitution = 0.6;
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  const LimitCycle& cycle = *largest_stable(analysis);
  ASSERT_EQ(cycle.kind, CycleKind::asymmetric);
  ASSERT_FALSE(cycle.settles);
  const CycleSensitivity found = cycle_sensitivity(servo);
  ASSERT_TRUE(found.available());
  EXPECT_EQ(found.amplitude.value, cycle.amplitude);
  // It begins as a fork next by: a short step, and so a rough difference.
  const double slope = numerical_slope(servo, &NormalizedServo::damping, 1e-7, &LimitCycle::period);
  EXPECT_NEAR(found.period.slope.damping, slope, 1e-4 * std::abs(slope));
}

TEST(EdgeCycleSensitivity, AnIrregularMotionHasTheGrowthAlone) {
  NormalizedServo servo = sample;
  servo.restitution = 0.9;
  const CycleSensitivity found = cycle_sensitivity(servo);
  EXPECT_EQ(found.outcome, SensitivityOutcome::no_cycle);
  EXPECT_TRUE(std::isnan(found.amplitude.value));
  EXPECT_TRUE(std::isfinite(found.growth_at_rest.slope.restitution));
}

}  // namespace
}  // namespace gearlash::cycle_sensitivity_test
