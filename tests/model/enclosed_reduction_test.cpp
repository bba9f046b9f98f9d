// The reduction in intervals against the same in 60 digits, where its sums cancel, and against
// formulas of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "base/bits_of_double.hpp"
#include "base/drive_count.hpp"
#include "base/number.hpp"
#include "base/seeded_draws.hpp"
#include "controllers.hpp"
#include "model/enclosed_drive.hpp"
#include "model/number_members.hpp"
#include "model/reduction.hpp"
#include "model/sampled_controller.hpp"

namespace gearlash::enclosed_reduction_test {
namespace {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                             boost::multiprecision::et_off>;

constexpr double half_turn = 3.14159265358979323846;

/// Numbers that may have been written where doubles were read: the same for the same double, one in
/// four at an end of what AsWritten permits.
struct Written {
  std::uint64_t seed = 0;

  Digits operator()(double value) const { return changed(value, AsWritten::units); }
  Digits converted(double value) const { return changed(value, 5.0 * AsWritten::units + 16.0); }
  static Digits pi() { return boost::math::constants::pi<Digits>(); }

 private:
  Digits changed(double value, double units) const {
    if (value == 0.0 || std::isinf(value)) return value;
    SeededDraws draws(seed ^ bits_of(value));
    const double share = draws.happens(0.25) ? draws.sign() : draws.uniform(-1.0, 1.0);
    return Digits(value) * (1 + Digits(share) * Digits(units) * Digits(0x1p-53));
  }
};

// ---- drives -------------------------------------------------------------------------------------

/// 1, or near it: where two terms of a sum cancel.
double nearly_one(SeededDraws& draws) {
  if (draws.happens(0.2)) return 1.0;
  return 1.0 + draws.either_sign(1e-16, 1e-2);
}

double one_in(SeededDraws& draws, double probability, double low, double high) {
  return draws.happens(probability) ? draws.log_uniform(low, high) : 0.0;
}

Motor drawn_motor(SeededDraws& draws) {
  Motor motor;
  const double kind = draws.uniform(0.0, 4.0);
  const double constant = draws.log_uniform(0.01, 10.0);
  const double resistance = draws.log_uniform(0.1, 100.0);
  if (kind < 1.0) {
    motor.kind = TorqueControl{constant};
  } else if (kind < 2.0) {
    motor.kind = ArmatureControl{constant, draws.log_uniform(0.01, 10.0), resistance,
                                 one_in(draws, 0.5, 1e-5, 1e-1)};
  } else if (kind < 3.0) {
    motor.kind = FieldControl{constant, resistance};
  } else {
    motor.kind = TwoPhase{constant, draws.log_uniform(1e-4, 1.0)};
  }
  motor.inertia = draws.log_uniform(1e-6, 1.0);
  motor.friction.viscous = one_in(draws, 0.7, 1e-6, 1.0);
  motor.friction.coulomb = one_in(draws, 0.5, 1e-4, 1.0);
  if (draws.happens(0.3)) motor.friction.breakaway = 2.0 * motor.friction.coulomb;
  if (draws.happens(0.5)) motor.limit = draws.log_uniform(0.1, 100.0);
  if (draws.happens(0.3)) motor.current_limit = draws.log_uniform(0.1, 100.0);
  if (draws.happens(0.3)) motor.no_load_current = draws.log_uniform(1e-3, 1.0);
  return motor;
}

/// numerator ≈ k · denominator: what is left of the canonical form's output cancels.
TransferFunctionController drawn_transfer(SeededDraws& draws, bool is_sampled) {
  TransferFunctionController function{.gain = draws.log_uniform(0.1, 100.0),
                                      .is_sampled = is_sampled};
  const auto order = static_cast<std::size_t>(draws.uniform(0.0, 5.0));
  const double factor = draws.either_sign(0.1, 10.0);
  for (std::size_t i = 0; i <= order; ++i) {
    const double coefficient = i == 0 ? draws.log_uniform(0.1, 10.0) : draws.either_sign(0.1, 1e3);
    function.denominator.push_back(coefficient);
    function.numerator.push_back(factor * coefficient * nearly_one(draws));
  }
  return function;
}

StateSpaceController drawn_system(SeededDraws& draws) {
  StateSpaceController system{.gain = draws.log_uniform(0.1, 100.0)};
  const auto order = static_cast<std::size_t>(draws.uniform(1.0, 5.0));
  const std::size_t columns = draws.happens(0.5) ? 1 : 3;
  const auto row = [&](std::size_t size) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < size; ++i) {
      numbers.push_back(draws.happens(0.3) ? 0.0 : draws.either_sign(0.01, 100.0));
    }
    if (size == 3 && draws.happens(0.7)) numbers[1] = -numbers[0] * nearly_one(draws);
    return numbers;
  };
  for (std::size_t i = 0; i < order; ++i) {
    system.A.push_back(row(order));
    system.B.push_back(row(columns));
  }
  system.C = row(order);
  system.D = row(columns);
  return system;
}

/// `filter`: s, of which a computer's period is chosen.
void draw_law(SeededDraws& draws, Drive& drive, double filter) {
  auto& law = drive.controller.law;
  const double kind = draws.uniform(0.0, 7.0);
  const double derivative = draws.either_sign(0.01, 10.0);
  if (kind < 2.0) {
    PID pid{.terms = static_cast<PIDTerms>(static_cast<int>(draws.uniform(0.0, 4.0))),
            .proportional = -derivative / filter * nearly_one(draws),
            .integral = draws.either_sign(0.1, 100.0),
            .derivative = derivative,
            .filter = draws.happens(0.8) ? filter : 0.0,
            .tracking_time = one_in(draws, 0.5, 1e-3, 1.0),
            .derivative_of_speed = draws.happens(0.3)};
    law = pid;
  } else if (kind < 3.0) {
    law = CascadeController{draws.log_uniform(0.1, 100.0), draws.log_uniform(0.1, 100.0),
                            one_in(draws, 0.7, 0.1, 100.0), one_in(draws, 0.5, 1e-3, 1.0),
                            draws.happens(0.7) ? filter : 0.0};
  } else if (kind < 4.0) {
    const double pole = draws.happens(0.5) ? 1.0 / filter : draws.log_uniform(0.1, 1e3);
    const double zero = pole * nearly_one(draws);  // equal doubles may have been other numbers
    law = LeadLagController{draws.log_uniform(0.1, 100.0),
                            zero == pole ? std::nextafter(pole, infinity) : zero, pole};
  } else if (kind < 5.0) {
    law = drawn_transfer(draws, drive.sampling && draws.happens(0.3));
  } else if (kind < 6.0) {
    law = drawn_system(draws);
  } else {
    law = RelayController{draws.log_uniform(0.1, 10.0)};
  }
}

void draw_signals(SeededDraws& draws, Drive& drive) {
  drive.load.gravity = draws.happens(0.7) ? draws.either_sign(0.01, 100.0) : 0.0;
  const double at = draws.either_sign(1e-3, 10.0);
  const double quarters = std::floor(draws.uniform(-6.0, 7.0));
  const double angle =
      quarters == 0.0 ? nearly_one(draws) - 1.0 : 0.5 * half_turn * quarters * nearly_one(draws);
  drive.load.gravity_angle = draws.happens(0.7) ? angle - at : draws.uniform(-10.0, 10.0);
  drive.reference = at;
  if (draws.happens(0.3)) drive.reference = RampSignal{at, draws.either_sign(0.01, 10.0), 1.0};
  const double carried = drive.load.gravity * std::cos(drive.load.gravity_angle + at);
  const double torque = draws.happens(0.7) ? carried * nearly_one(draws) : 1.0;
  drive.load_torque = torque;
  if (draws.happens(0.3)) drive.load_torque = SineSignal{torque, 0.5, 3.0, 0.0};
}

void draw_sampling(SeededDraws& draws, Drive& drive, double filter) {
  Sampling sampling{
      .method = static_cast<Discretization>(static_cast<int>(draws.uniform(0.0, 3.0))),
      .speed_by_differences = draws.happens(0.5)};
  // Where the filter's state, advanced, becomes 0.
  const double cancelling = sampling.method == Discretization::tustin ? 2.0 * filter : filter;
  sampling.period =
      draws.happens(0.7) ? cancelling * nearly_one(draws) : draws.log_uniform(1e-5, 1e-1);
  if (draws.happens(0.2)) sampling.period = draws.one_of({0.001, 0.003, 1e-5, 0.25, 0.0007});
  const double periods = std::ceil(draws.uniform(-1.0, 5.0));
  sampling.delay = sampling.period * periods * (draws.happens(0.3) ? 1.0 : nearly_one(draws));
  if (draws.happens(0.3)) sampling.delay = sampling.period * draws.uniform(0.01, 3.0);
  drive.sampling = sampling;
}

Drive drawn_drive(SeededDraws& draws) {
  Drive drive;
  if (draws.happens(0.1)) {
    const double friction_ratio = std::min(1.0, nearly_one(draws));
    drive =
        normal_form(draws.log_uniform(1e-3, 10.0),
                    draws.happens(0.2) ? infinity : draws.log_uniform(1e-9, 1e9), friction_ratio);
    if (draws.happens(0.5)) drive.servo->natural_frequency = draws.log_uniform(0.1, 1e3);
    return drive;
  }
  drive.motor = drawn_motor(draws);
  drive.gearbox = {.ratio = draws.log_uniform(0.1, 1e3),
                   .backlash = draws.log_uniform(1e-5, 1.0),
                   .inertia = one_in(draws, 0.5, 1e-6, 1.0)};
  drive.load.inertia = draws.log_uniform(1e-4, 10.0);
  drive.load.friction = {one_in(draws, 0.5, 1e-4, 10.0), one_in(draws, 0.5, 1e-4, 10.0)};
  if (draws.happens(0.5)) {
    drive.contact = CompliantContact{draws.log_uniform(1.0, 1e6), one_in(draws, 0.5, 1e-3, 10.0)};
  }
  drive.sensor.position = static_cast<SensorPlace>(static_cast<int>(draws.uniform(0.0, 3.0)));
  if (draws.happens(0.5)) drive.sensor.encoder.counts_per_turn = 4096.0;
  const double filter = draws.log_uniform(1e-4, 1e-1);
  if (draws.happens(0.6)) draw_sampling(draws, drive, filter);
  draw_law(draws, drive, filter);
  drive.controller.shaft = static_cast<GainShaft>(static_cast<int>(draws.uniform(0.0, 3.0)));
  if (draws.happens(0.3)) drive.controller.dead_band.width = draws.log_uniform(1e-4, 1e-1);
  if (draws.happens(0.3)) {
    drive.controller.compensation = {.friction = 0.1, .backlash = 0.01, .take_up_angle = 0.01};
  }
  draw_signals(draws, drive);
  return drive;
}

// ---- comparison ---------------------------------------------------------------------------------

class Comparison {
 public:
  void operator()(const std::string& kind, const Digits& exact, const Interval& enclosed) {
    ++numbers_;
    const Digits rounding = Digits(1e-50);  // of the 60 digits themselves, where they cancel to 0
    const bool holds =
        Digits(enclosed.low) - rounding <= exact && exact <= Digits(enclosed.high) + rounding;
    if (!holds) ++violations_;
    EXPECT_TRUE(holds) << kind << ": " << enclosed.low << " … " << enclosed.high << " without "
                       << exact << ", drive " << drive_;
    const auto size = static_cast<double>(abs(exact));
    if (size > 0.0 && std::isfinite(size)) {
      widths_[kind].push_back((enclosed.high - enclosed.low) / size);
    }
  }
  template <class Exact, class Enclosed>
  void all(const std::string& kind, const Exact& exact, Enclosed enclosed) {
    set_numbers([&](const Digits& a, Interval& b) { (*this)(kind, a, b); }, exact, enclosed);
  }
  void controller(const std::string& kind, const drive::LinearControllerOf<Digits>& exact,
                  const drive::LinearControllerOf<Interval>& enclosed) {
    ASSERT_EQ(exact.order(), enclosed.order()) << kind << ", drive " << drive_;
    all(kind + " state", exact.state_matrix, enclosed.state_matrix);
    all(kind + " input", exact.input_matrix, enclosed.input_matrix);
    all(kind + " output", exact.output, enclosed.output);
    all(kind + " direct", exact.direct, enclosed.direct);
    all(kind + " anti-windup", exact.anti_windup, enclosed.anti_windup);
  }
  void begin(int drive) { drive_ = drive; }
  std::size_t violations() const { return violations_; }

  void print() {
    std::cout << numbers_ << " numbers, " << violations_ << " outside\n";
    for (auto& [kind, widths] : widths_) {
      const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
      std::nth_element(widths.begin(), middle, widths.end());
      std::cout << kind << ": relative width " << *middle << " (median of " << widths.size()
                << "), at most " << *std::max_element(middle, widths.end()) << '\n';
    }
  }

 private:
  int drive_ = 0;
  std::size_t numbers_ = 0;
  std::size_t violations_ = 0;
  std::map<std::string, std::vector<double>> widths_;
};

/// In any numbers, from the definition: result k is held from k period + delay on.
struct Hold {
  Digits from;
  Digits until;
  std::size_t age;
};
std::vector<Hold> holds_of(const Digits& period, const Digits& delay) {
  const auto newest = static_cast<std::size_t>(floor(delay / period));
  const Digits change = delay - newest * period;
  std::vector<Hold> holds;
  if (change > 0) holds.push_back({0, change, newest + 1});
  holds.push_back({change, period, newest});
  return holds;
}

/// Each true hold is among those enclosed, and none of the others needs to last.
void compare_holds(const Digits& period, const Digits& delay,
                   const std::vector<HeldTorqueOf<Interval>>& enclosed, const std::string& what,
                   Comparison& compare) {
  const std::vector<Hold> holds = holds_of(period, delay);
  std::size_t found = 0;
  for (const HeldTorqueOf<Interval>& one : enclosed) {
    const auto hold =
        std::find_if(holds.begin(), holds.end(), [&](const Hold& h) { return h.age == one.age; });
    if (hold == holds.end()) {
      EXPECT_LE(one.until.low, one.from.high) << what << ", age " << one.age;
      continue;
    }
    ++found;
    compare("held torque", hold->from, one.from);
    compare("held torque", hold->until, one.until);
  }
  EXPECT_EQ(found, holds.size()) << what;
}

TEST(PropertyEnclosedReduction, ContainsSixtyDigitsWhereSumsCancel) {
  constexpr std::uint64_t seed = 4401;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  Comparison compare;
  int assumed = 0;  // delays written as a multiple of the period
  const int count = test::drive_count(300);
  for (int i = 0; i < count; ++i) {
    compare.begin(i);
    const Drive drive = drawn_drive(draws);
    const EnclosedDrive enclosed(drive);
    const Written written{seed + static_cast<std::uint64_t>(i)};
    drive::ReducedDriveOf<Digits> exact = reduced(drive, written);
    const CourseOf<Digits> course = Reduction<Written>(drive, written).course();
    // A share of friction above 1 is none of a drive.
    exact.motor.friction.viscous = std::max(exact.motor.friction.viscous, Digits(0));
    if (std::holds_alternative<double>(enclosed.form().reference)) exact.feedforward = {};
    exact.reference = enclosed.form().reference;
    exact.load_torque = enclosed.form().load_torque;
    compare.all("shaft", exact.motor, enclosed.numbers().motor);
    compare.all("shaft", exact.load, enclosed.numbers().load);
    compare.all("weight", exact.gravity, enclosed.numbers().gravity);
    compare.all("signal", course, enclosed.course());
    compare.all("other", exact, enclosed.numbers());
    const std::string kind = exact.sampling ? "sampled" : "continuous";
    if (exact.sampling) {
      const Digits period = written(exact.sampling->period);
      Digits delay = written(exact.sampling->delay);
      exact.controller = drive::forms::sampled(exact.controller, period, exact.sampling->method);
      const auto& held = enclosed.held_torques();
      const bool is_multiple = held.size() == 1 && drive.sampling->delay > 0.0;
      if (is_multiple) {
        ++assumed;
        delay = period * static_cast<double>(held.front().age);
      }
      compare_holds(period, delay, held, "drive " + std::to_string(i), compare);
    }
    compare.controller(kind, exact.controller, enclosed.controller());
  }
  compare.print();
  std::cout << assumed << " delays written as a multiple of the period\n";
  EXPECT_EQ(compare.violations(), 0U);
  EXPECT_GT(assumed, 0);
}

// ---- formulas of their own ----------------------------------------------------------------------

void expect_contains(const Interval& enclosed, const Digits& exact, const char* what) {
  EXPECT_TRUE(Digits(enclosed.low) <= exact && exact <= Digits(enclosed.high))
      << what << ": " << enclosed.low << " … " << enclosed.high << " without " << exact;
  EXPECT_LT(enclosed.high - enclosed.low, 1e-10 * std::max(1.0, std::abs(enclosed.high))) << what;
}

/// d s/(F s + 1) by s = (2/T)(z − 1)/(z + 1): at once 2 d/(2 F + T), with the pole
/// (2 F − T)/(2 F + T).
TEST(EnclosedReduction, TustinsFilterIsThatOfTheBook) {
  const AsWritten datum;
  for (const double closeness : {0.0, 1e-16, 1e-12, -1e-8, 0.5}) {
    const double filter = 0.003;
    const double period = 2.0 * filter * (1.0 + closeness);
    const double derivative = 0.7;
    const double proportional = -2.0 * derivative / (2.0 * filter + period);
    const auto found =
        drive::sampled_controller(drive::forms::linear(PID{.terms = PIDTerms::PD,
                                                           .proportional = proportional,
                                                           .derivative = derivative,
                                                           .filter = filter},
                                                       datum, Interval(1.0)),
                                  datum(period), Discretization::tustin);
    const Digits F = filter;
    const Digits T = period;
    ASSERT_EQ(found.order(), 1U);
    expect_contains(found.state_matrix[0][0], (2 * F - T) / (2 * F + T), "pole");
    expect_contains(found.direct[0], proportional + 2 * Digits(derivative) / (2 * F + T),
                    "at once");
    EXPECT_EQ(drive::sum_of_both(found.direct).low, 0.0);
    EXPECT_EQ(drive::sum_of_both(found.direct).high, 0.0);
  }
}

/// k (s/z + 1)/(s/p + 1) = k p/z + k (1 − p/z) p/(s + p).
TEST(EnclosedReduction, LeadLagIsItsPartialFraction) {
  const AsWritten datum;
  for (const double closeness : {0.0, 1e-15, -1e-9, 0.3}) {
    const double pole = 17.0;
    const double zero = pole * (1.0 + closeness);
    const auto found =
        drive::forms::linear(LeadLagController{3.0, zero, pole}, datum, Interval(1.0));
    ASSERT_EQ(found.order(), 1U) << "the decimals may differ";
    const Digits ratio = Digits(pole) / Digits(zero);
    expect_contains(found.state_matrix[0][0], -pole, "pole");
    expect_contains(found.direct[0], 3 * ratio, "at once");
    expect_contains(found.output[0], 3 * (1 - ratio) * pole, "through the state");
  }
  EXPECT_EQ(at_load(LeadLagController{3.0, 17.0, 17.0}).order(), 0U);
}

/// p + i/s by backward differences: at once p + i T.
TEST(EnclosedReduction, BackwardIntegralAddsItsPeriodAtOnce) {
  const AsWritten datum;
  const auto found = drive::sampled_controller(
      drive::forms::linear(PID{.terms = PIDTerms::PI, .proportional = -0.02, .integral = 20.0},
                           datum, Interval(1.0)),
      datum(0.001), Discretization::backward);
  expect_contains(found.direct[0], Digits(-0.02) + Digits(20.0) * Digits(0.001), "at once");
  expect_contains(found.state_matrix[0][0], 1, "integrator");
}

TEST(EnclosedReduction, TheWeightHangsAtQuarterTurns) {
  Drive drive;
  drive.motor.inertia = drive.load.inertia = 1.0;
  drive.load.gravity = 2.0;
  drive.load.gravity_angle = 0.5 * half_turn;
  const auto upright = EnclosedDrive(drive).numbers().gravity;
  expect_contains(upright.torque, 0, "torque upright");
  expect_contains(upright.stiffness, -2, "stiffness upright");
  EXPECT_LT(upright.torque.high - upright.torque.low, 1e-13);
  drive.load.gravity_angle = 0.0;
  const auto level = EnclosedDrive(drive).numbers().gravity;
  EXPECT_TRUE(is_exactly(level.stiffness, 0.0));
  expect_contains(level.torque, -2, "torque level");
}

TEST(EnclosedReduction, ADelayNearAMultipleOfThePeriodHoldsItsNeighboursToo) {
  Drive drive;
  drive.motor.inertia = drive.load.inertia = 1.0;
  drive.sampling = Sampling{.period = 0.001, .delay = 0.003};
  const auto ages = [&] {
    const EnclosedDrive enclosed(drive);
    std::vector<std::size_t> result;
    for (const auto& held : enclosed.held_torques()) result.push_back(held.age);
    return result;
  };
  EXPECT_EQ(ages(), (std::vector<std::size_t>{3}));
  drive.sampling->delay = std::nextafter(0.003, 1.0);
  EXPECT_EQ(ages(), (std::vector<std::size_t>{4, 3, 2}));
  drive.sampling->delay = 0.003 * (1.0 + 1e-13);
  EXPECT_EQ(ages(), (std::vector<std::size_t>{4, 3}));
  drive.sampling->delay = 0.003 * (1.0 - 1e-13);
  EXPECT_EQ(ages(), (std::vector<std::size_t>{3, 2}));
  drive.sampling->delay = 0.0031;
  EXPECT_EQ(ages(), (std::vector<std::size_t>{4, 3}));
  drive.sampling->delay = 0.0;
  EXPECT_EQ(ages(), (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace gearlash::enclosed_reduction_test
