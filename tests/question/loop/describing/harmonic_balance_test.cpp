// Predicted cycles against published numbers, closed forms, and brute force on random loops.
#include "question/loop/describing/harmonic_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/correct_digits.hpp"
#include "base/references.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/limit_cycle.hpp"
#include "question/loop/describing/servo_estimate.hpp"

namespace gearlash::harmonic_balance_test {
namespace {

using Complex = std::complex<double>;

constexpr double pi = 3.14159265358979323846;

/// s² T + s, as of K/(s(Ts + 1)), T = 1.
TransferFunction type_one_servo(double gain) { return {{gain}, {1.0, 1.0, 0.0}}; }

HarmonicBalance harmonic_balance(const Nonlinearity& nonlinearity, const TransferFunction& loop) {
  return gearlash::harmonic_balance(nonlinearity, loop, natural_frequency_range(loop));
}

// ---- Published numbers

TEST(HarmonicBalanceOracle, TypeOneServoOfGainFive) {
  const HarmonicBalance balance =
      harmonic_balance(FrictionControlledBacklash{2.0}, type_one_servo(5.0));
  ASSERT_EQ(balance.cycles.size(), 2U);
  EXPECT_TRUE(balance.unresolved.empty());
  const PredictedCycle& small = balance.cycles[0];
  const PredictedCycle& large = balance.cycles[1];
  // The published numbers have themselves residuals of 1.7e-5 and 1e-6.
  expect_digits("small_amplitude", small.amplitude, 1.055693, 5.6);
  expect_digits("small_frequency", small.frequency, 0.318136, 4.6);
  expect_digits("large_amplitude", large.amplitude, 2.020631, 6.1);
  expect_digits("large_frequency", large.frequency, 1.591382, 6.0);
  EXPECT_FALSE(small.stable);
  EXPECT_TRUE(large.stable);
  EXPECT_LT(small.residual, 10.0 * epsilon);
  EXPECT_LT(large.residual, 10.0 * epsilon);
  EXPECT_EQ(large.period, 2.0 * pi / large.frequency);
}

/// The textbooks' form of N in many digits.
TEST(HarmonicBalanceOracle, TypeOneServoKeepsItsDigits) {
  const HarmonicBalance balance =
      harmonic_balance(FrictionControlledBacklash{2.0}, type_one_servo(5.0));
  auto cycle = balance.cycles.begin();
  for (const Reference& exact : References("question", "type_one_cycles")) {
    ASSERT_NE(cycle, balance.cycles.end());
    EXPECT_LT(epsilons_off(cycle->amplitude, exact["amplitude"]), 32);
    EXPECT_LT(epsilons_off(cycle->frequency, exact["frequency"]), 32);
    ++cycle;
  }
}

/// Cycles begin at KT = 3.416581, at ωT = 0.757500 and A/h = 1.289590.
TEST(HarmonicBalanceOracle, TypeOneServoStartsToHuntAtThePublishedGain) {
  const FrictionControlledBacklash backlash{2.0};
  double none = 3.4165;
  double some = 3.4166;
  while (some - none > 1e-12) {
    const double gain = 0.5 * (none + some);
    const bool hunts = !harmonic_balance(backlash, type_one_servo(gain)).cycles.empty();
    (hunts ? some : none) = gain;
  }
  expect_digits("least_gain", some, 3.416581, 7.5);
  const HarmonicBalance balance = harmonic_balance(backlash, type_one_servo(some));
  ASSERT_EQ(balance.cycles.size(), 2U);
  // The two are 1e-6 apart here and merge at 0.7574973, which the published number misses
  // by 2.7e-6: KT has its least value there and says little of where.
  for (const PredictedCycle& cycle : balance.cycles) {
    EXPECT_NEAR(cycle.frequency, 0.757500, 5e-6);
    EXPECT_NEAR(cycle.amplitude, 1.289590, 2e-6);
  }
  EXPECT_NEAR(0.5 * (balance.cycles[0].frequency + balance.cycles[1].frequency), 0.7574973, 1e-7);
}

/// A delay of 5 as Padé's fraction of order 4.
TransferFunction plant_of_python_control() {
  const std::vector<double> pade{625.0, 2500.0, 4500.0, 4200.0, 1680.0};
  const std::vector<double> plant{1.0, 2.0, 2.0, 1.0};
  TransferFunction transfer;
  for (std::size_t i = 0; i < pade.size(); ++i) {
    transfer.numerator.push_back(4.0 * (i % 2 == 0 ? pade[i] : -pade[i]));
  }
  transfer.denominator.assign(pade.size() + plant.size() - 1, 0.0);
  for (std::size_t i = 0; i < pade.size(); ++i) {
    for (std::size_t k = 0; k < plant.size(); ++k)
      transfer.denominator[i + k] += pade[i] * plant[k];
  }
  return transfer;
}

/// python-control's notebook on describing functions (examples/describing_functions.ipynb) prints
/// what its minimization of |1 + NG|² ends at.
TEST(HarmonicBalanceOracle, BacklashOfPythonControl) {
  const HarmonicBalance balance =
      harmonic_balance(FrictionControlledBacklash{1.0}, plant_of_python_control());
  ASSERT_EQ(balance.cycles.size(), 2U);
  EXPECT_TRUE(balance.unresolved.empty());
  expect_digits("small_amplitude", balance.cycles[0].amplitude, 0.6260158833531679, 7.6);
  expect_digits("small_frequency", balance.cycles[0].frequency, 0.31026194979692245, 6.9);
  expect_digits("large_amplitude", balance.cycles[1].amplitude, 0.8741930326842812, 6.1);
  expect_digits("large_frequency", balance.cycles[1].frequency, 1.215641094477062, 7.9);
  for (const PredictedCycle& cycle : balance.cycles) EXPECT_LT(cycle.residual, 20.0 * epsilon);
}

/// The example of describing_function_plot() in python-control's reference: 8/(s³ + 2s² + 2s + 1)
/// with a unit saturation. Version 0.9.0 prints 3.344008947853124 at 1.414213099755523, 0.10.0
/// prints 3.343844998258643 at 1.4142293090899216. Exact: ω = √2, where G = −8/3 and N = 3/8.
TEST(HarmonicBalanceOracle, SaturationOfPythonControl) {
  const std::vector<double> denominator{1.0, 2.0, 2.0, 1.0};
  const HarmonicBalance balance = harmonic_balance(Saturation{1.0, 1.0}, {{8.0}, denominator});
  ASSERT_EQ(balance.cycles.size(), 1U);
  EXPECT_TRUE(balance.unresolved.empty());
  const PredictedCycle& cycle = balance.cycles[0];
  EXPECT_TRUE(cycle.stable);
  expect_digits("amplitude", cycle.amplitude, 3.344008947853124, 5.5);
  expect_digits("frequency", cycle.frequency, 1.414213099755523, 6.4);
  expect_digits("later_amplitude", cycle.amplitude, 3.343844998258643, 4.3);
  expect_digits("later_frequency", cycle.frequency, 1.4142293090899216, 4.9);
  expect_digits("exact_frequency", cycle.frequency, std::sqrt(2.0), 15.0);
  const double angle = std::asin(1.0 / cycle.amplitude);
  expect_digits("exact_gain", (2.0 * angle + std::sin(2.0 * angle)) / pi, 0.375, 15.0);
  // The same loop with a gain of 1 meets no saturation's −1/N.
  EXPECT_TRUE(harmonic_balance(Saturation{1.0, 1.0}, {{1.0}, denominator}).cycles.empty());
}

TEST(HarmonicBalanceOracle, RelayAndSaturationAtThePhaseCrossover) {
  const TransferFunction loop{{9.0}, {1.0, 10.0, 9.0, 0.0}};  // −1/10 at ω = 3
  const HarmonicBalance relay = harmonic_balance(CoulombFriction{1.0}, loop);
  ASSERT_EQ(relay.cycles.size(), 1U);
  EXPECT_TRUE(relay.unresolved.empty());
  EXPECT_GT(correct_digits(relay.cycles[0].frequency, 3.0), 15.0);
  EXPECT_GT(correct_digits(relay.cycles[0].amplitude, 2.0 / (5.0 * pi)), 15.0);
  EXPECT_TRUE(relay.cycles[0].stable);

  EXPECT_TRUE(harmonic_balance(Saturation{1.0, 9.9}, loop).cycles.empty());
  const HarmonicBalance saturation = harmonic_balance(Saturation{1.0, 20.0}, loop);
  ASSERT_EQ(saturation.cycles.size(), 1U);
  EXPECT_TRUE(saturation.cycles[0].stable);
  const HarmonicBalance dead_zone = harmonic_balance(DeadZone{1.0, 20.0}, loop);
  ASSERT_EQ(dead_zone.cycles.size(), 1U);
  EXPECT_FALSE(dead_zone.cycles[0].stable);
  // Half of the slope: S(ρ) = 1/2 for both.
  EXPECT_GT(correct_digits(saturation.cycles[0].amplitude * 20.0, dead_zone.cycles[0].amplitude),
            14.5);
}

/// K e^{−sτ}/s: ω = (π/2 + 2πk)/τ, A = 4K/(πω).
TEST(HarmonicBalanceOracle, RelayWithADelayHasACycleAtEveryTurn) {
  const HarmonicBalance balance =
      harmonic_balance(CoulombFriction{1.0}, {{3.0}, {1.0, 0.0}, 0.2}, {1e-3, 1e3});
  EXPECT_TRUE(balance.unresolved.empty());
  ASSERT_EQ(balance.cycles.size(), 32U);  // (π/2 + 2π·31)/0.2 = 981.7
  for (std::size_t i = 0; i < balance.cycles.size(); ++i) {
    const double turns = static_cast<double>(balance.cycles.size() - 1 - i);
    const double frequency = (0.5 + 2.0 * turns) * pi / 0.2;
    EXPECT_GT(correct_digits(balance.cycles[i].frequency, frequency), 14.5);
    EXPECT_GT(correct_digits(balance.cycles[i].amplitude, 12.0 / (pi * frequency)), 14.5);
    EXPECT_TRUE(balance.cycles[i].stable);
  }
}

/// −1/N = −(π/4M)(√(A² − δ²) + jδ), so Im G = −πδ/4M, here with G = 1/(s(s + 1)): ω(ω² + 1) =
/// 4M/πδ.
TEST(HarmonicBalanceOracle, RelayWithHysteresis) {
  const HarmonicBalance balance =
      harmonic_balance(RelayWithHysteresis{2.5 * pi, 1.0}, type_one_servo(1.0));
  ASSERT_EQ(balance.cycles.size(), 1U);
  EXPECT_TRUE(balance.unresolved.empty());
  EXPECT_TRUE(balance.cycles[0].stable);
  EXPECT_GT(correct_digits(balance.cycles[0].frequency, 2.0), 15.0);
  // √(A² − 1) = 10/(ω² + 1) = 2.
  EXPECT_GT(correct_digits(balance.cycles[0].amplitude, std::sqrt(5.0)), 15.0);
}

// ---- Brute force

/// Poles and zeros at random, some at the origin or to the right, some pairs of little damping.
TransferFunction random_loop(SeededDraws& draws) {
  const auto multiply = [](std::vector<double>& polynomial, const std::vector<double>& factor) {
    std::vector<double> product(polynomial.size() + factor.size() - 1, 0.0);
    for (std::size_t i = 0; i < polynomial.size(); ++i) {
      for (std::size_t k = 0; k < factor.size(); ++k) product[i + k] += polynomial[i] * factor[k];
    }
    polynomial = product;
  };
  const auto pair = [&] {
    const double frequency = draws.log_uniform(0.1, 10.0);
    return std::vector<double>{1.0, 2.0 * draws.log_uniform(0.02, 1.0) * frequency,
                               frequency * frequency};
  };
  TransferFunction loop{{draws.log_uniform(0.3, 100.0)}, {1.0}};
  if (draws.happens(0.7)) multiply(loop.denominator, {1.0, 0.0});
  multiply(loop.denominator, pair());
  if (draws.happens(0.5)) multiply(loop.denominator, {1.0, draws.log_uniform(0.1, 10.0)});
  if (draws.happens(0.5)) multiply(loop.denominator, pair());
  if (draws.happens(0.3)) multiply(loop.numerator, pair());
  if (draws.happens(0.3)) multiply(loop.numerator, {1.0, draws.either_sign(0.1, 10.0)});
  if (draws.happens(0.3)) loop.delay = draws.log_uniform(0.01, 1.0);
  return loop;
}

Nonlinearity random_lagging_nonlinearity(SeededDraws& draws) {
  const double kind = draws.uniform(0.0, 3.0);
  if (kind < 1.0) return FrictionControlledBacklash{2.0};
  if (kind < 2.0) return InertiaControlledBacklash{2.0};
  return RelayWithHysteresis{draws.log_uniform(0.3, 3.0), 1.0};
}

/// A grid of 1 + NG by amplitude and frequency, both logarithmic.
struct Grid {
  static constexpr int rows = 160;
  static constexpr int columns = 500;
  static constexpr double low = 0.02;
  static constexpr double high = 50.0;

  explicit Grid(const Nonlinearity& nonlinearity, const TransferFunction& loop) {
    const double least = nonlinearity.index() == 1 ? 2.0 / pi : 1.0;  // gap 2, half_width 1
    for (int row = 0; row <= rows; ++row) {
      amplitudes.push_back(least * (1.0 + 1e-3 * std::pow(1e7, row / double{rows})));
      gains.push_back(describing_gain(nonlinearity, amplitudes.back()));
    }
    for (int column = 0; column <= columns; ++column) {
      frequencies.push_back(low * std::pow(high / low, column / double{columns}));
      responses.push_back(frequency_response(loop, frequencies.back()).value);
    }
  }

  Complex at(int row, int column) const {
    return 1.0 + gains[static_cast<std::size_t>(row)] * responses[static_cast<std::size_t>(column)];
  }
  bool holds(double amplitude, double frequency) const {
    return amplitude > amplitudes.front() && amplitude < amplitudes.back() &&
           frequency > frequencies.front() && frequency < frequencies.back();
  }

  std::vector<double> amplitudes;
  std::vector<Complex> gains;
  std::vector<double> frequencies;
  std::vector<Complex> responses;
};

/// Whether 0 is in the triangle.
bool holds_zero(const Complex& a, const Complex& b, const Complex& c) {
  const auto side = [](const Complex& from, const Complex& to) {
    return (from * std::conj(to)).imag() > 0.0;
  };
  return side(a, b) == side(b, c) && side(b, c) == side(c, a);
}

/// Whether 1 + NG, interpolated linearly on both halves of the cell, has a zero there.
bool has_zero(const Grid& grid, int row, int column) {
  const Complex low = grid.at(row, column);
  const Complex high = grid.at(row + 1, column + 1);
  return holds_zero(low, grid.at(row, column + 1), high) ||
         holds_zero(low, grid.at(row + 1, column), high);
}

bool is_listed(const HarmonicBalance& balance, const Grid& grid, int row, int column) {
  const auto at = [](const std::vector<double>& values, int index) {
    return values[static_cast<std::size_t>(
        std::clamp(index, 0, static_cast<int>(values.size()) - 1))];
  };
  return std::any_of(balance.cycles.begin(), balance.cycles.end(),
                     [&](const PredictedCycle& cycle) {
                       return cycle.amplitude >= at(grid.amplitudes, row - 1) &&
                              cycle.amplitude <= at(grid.amplitudes, row + 2) &&
                              cycle.frequency >= at(grid.frequencies, column - 1) &&
                              cycle.frequency <= at(grid.frequencies, column + 2);
                     });
}

TEST(HarmonicBalanceProperty, RandomLoopsHaveNoOtherSolution) {
  SeededDraws draws(1951);
  std::size_t solutions = 0;
  std::size_t seen = 0;
  for (int count = 0; count < 300; ++count) {
    const TransferFunction loop = random_loop(draws);
    const Nonlinearity nonlinearity = random_lagging_nonlinearity(draws);
    const Grid grid(nonlinearity, loop);
    const HarmonicBalance balance =
        harmonic_balance(nonlinearity, loop, {0.9 * Grid::low, 1.1 * Grid::high});
    EXPECT_TRUE(balance.unresolved.empty()) << count;
    for (const PredictedCycle& cycle : balance.cycles) {
      EXPECT_LT(cycle.residual, 1e-13) << count;
      if (grid.holds(cycle.amplitude, cycle.frequency)) ++solutions;
    }
    for (int row = 0; row < Grid::rows; ++row) {
      for (int column = 0; column < Grid::columns; ++column) {
        if (!has_zero(grid, row, column)) continue;
        ++seen;
        EXPECT_TRUE(is_listed(balance, grid, row, column))
            << "loop " << count << " A " << grid.amplitudes[static_cast<std::size_t>(row)] << " w "
            << grid.frequencies[static_cast<std::size_t>(column)];
      }
    }
  }
  EXPECT_EQ(seen, solutions);
  EXPECT_GT(solutions, 80U);
}

/// Loeb's criterion with the gain's own slope and a difference of G.
TEST(HarmonicBalanceProperty, StabilityIsLoebs) {
  SeededDraws draws(1952);
  int stable = 0;
  int unstable = 0;
  for (int count = 0; count < 200; ++count) {
    const TransferFunction loop = random_loop(draws);
    const Nonlinearity nonlinearity = random_lagging_nonlinearity(draws);
    for (const PredictedCycle& cycle : harmonic_balance(nonlinearity, loop, {0.01, 100.0}).cycles) {
      const Complex by_amplitude =
          describing_gain_slope(nonlinearity, cycle.amplitude) / cycle.gain;
      const double step = 1e-6 * cycle.frequency;
      const Complex by_frequency = frequency_response(loop, cycle.frequency + step).value /
                                       frequency_response(loop, cycle.frequency - step).value -
                                   1.0;
      const double criterion = (by_amplitude * std::conj(by_frequency)).imag();
      const double scale = std::abs(by_amplitude) * std::abs(by_frequency);
      if (std::abs(criterion) < 1e-5 * scale) continue;
      EXPECT_EQ(cycle.stable, criterion < 0.0) << count;
      ++(cycle.stable ? stable : unstable);
    }
  }
  EXPECT_GT(stable, 50);
  EXPECT_GT(unstable, 20);
}

/// Without lag: as many as there are changes of the sign of Im G with Re G < 0 on a fine grid.
TEST(HarmonicBalanceProperty, RelaysHaveACycleAtEveryPhaseCrossover) {
  SeededDraws draws(1953);
  std::size_t total = 0;
  for (int count = 0; count < 100; ++count) {
    const TransferFunction loop = random_loop(draws);
    const HarmonicBalance balance = harmonic_balance(CoulombFriction{1.0}, loop, {0.02, 50.0});
    EXPECT_TRUE(balance.unresolved.empty()) << count;
    for (const PredictedCycle& cycle : balance.cycles) {
      EXPECT_LT(cycle.residual, 1e-12) << count;
      EXPECT_GT(correct_digits(describing_gain(CoulombFriction{1.0}, cycle.amplitude).real(),
                               cycle.gain.real()),
                15);
    }
    std::size_t crossings = 0;
    constexpr int steps = 5'000;
    Complex last = frequency_response(loop, 0.02).value;
    for (int i = 1; i <= steps; ++i) {
      const Complex next =
          frequency_response(loop, 0.02 * std::pow(2500.0, i / double{steps})).value;
      if ((next.imag() > 0.0) != (last.imag() > 0.0) && next.real() < 0.0) ++crossings;
      last = next;
    }
    EXPECT_EQ(balance.cycles.size(), crossings) << count;
    total += crossings;
  }
  EXPECT_GT(total, 80U);
}

// ---- Edges

TEST(HarmonicBalanceEdge, UndampedModesAreSteps) {
  // 1/((s² + 1)(s + 1)): −π is passed in the step at ω = 1 only, where |G| is infinite.
  EXPECT_TRUE(harmonic_balance(CoulombFriction{1.0}, {{1.0}, {1.0, 1.0, 1.0, 1.0}}).cycles.empty());
  // Beyond it −G leads by artan ω: no lag.
  const TransferFunction lag{{1.0}, {1.0, 1.0, 1.0, 1.0}};
  EXPECT_TRUE(harmonic_balance(FrictionControlledBacklash{1.0}, lag).cycles.empty());
  // With a zero at −1 and a pole at −3 it lags by artan ω − artan ω/3 while |G| falls from
  // infinity.
  const TransferFunction lead{{1.0, 1.0}, {1.0, 3.0, 1.0, 3.0}};
  EXPECT_EQ(harmonic_balance(InertiaControlledBacklash{1.0}, lead).cycles.size(), 1U);
}

TEST(HarmonicBalanceEdge, PhaseThatStaysAtHalfATurnIsNotResolved) {
  const HarmonicBalance relay = harmonic_balance(CoulombFriction{1.0}, {{1.0}, {1.0, 0.0, 0.0}});
  EXPECT_TRUE(relay.cycles.empty());
  ASSERT_EQ(relay.unresolved.size(), 1U);
  EXPECT_EQ(relay.unresolved[0], natural_frequency_range({{1.0}, {1.0, 0.0, 0.0}}));
  const HarmonicBalance play =
      harmonic_balance(FrictionControlledBacklash{1.0}, {{1.0}, {1.0, 0.0, 0.0}});
  EXPECT_TRUE(play.cycles.empty());
  EXPECT_TRUE(play.unresolved.empty());
}

TEST(HarmonicBalanceEdge, NoGapHasNoCycle) {
  EXPECT_TRUE(harmonic_balance(FrictionControlledBacklash{}, type_one_servo(5.0)).cycles.empty());
}

TEST(HarmonicBalanceEdge, EveryFaultIsNamed) {
  EXPECT_THROW(harmonic_balance(CoulombFriction{}, {{1.0}, {}}), InvalidInput);
  EXPECT_THROW(describing_function_estimate({.damping = -1.0}), InvalidInput);
}

TEST(HarmonicBalanceEdge, NaturalFrequencyRange) {
  const Bounds range = natural_frequency_range({{9.0}, {1.0, 10.0, 9.0, 0.0}});
  EXPECT_NEAR(range.low, 1e-6, 1e-20);
  EXPECT_NEAR(range.high, 9e6, 1e-7);
  EXPECT_NEAR(natural_frequency_range({{1.0}, {1.0, 0.0}, 2.0}).high, 100.0 * pi, 1e-10);
  EXPECT_EQ(natural_frequency_range({{4.0}, {1.0, 0.0, 0.0}}), (Bounds{2e-6, 2e6}));
}

// ---- The servo

/// The numbers of docs/explanation/describing-functions.md.
TEST(HarmonicBalanceOracle, EstimateBesideTheExactCycle) {
  struct Row {
    double damping, inertia_ratio, friction_ratio;
    double exact_amplitude, exact_period, held_amplitude, held_period, coasting_amplitude,
        coasting_period;
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const Row& row : {Row{0.19, 2.0, 0.1, 0.2416, 6.456, 0.2332, 7.872, 0.5715, 5.908},
                         Row{0.2, 4.0, 0.25, 0.1605, 6.792, 0.2071, 8.103, 0.5511, 5.916},
                         Row{0.1, 1.0, 0.2, 0.4971, 6.056, 0.6862, 6.705, 0.8936, 5.918},
                         Row{0.1, 0.25, 0.2, 0.7915, 6.060, 0.6862, 6.705, 0.8936, 5.918},
                         Row{0.05, 0.2, 0.9, 1.5578, 6.161, 1.6358, 6.414, 1.4807, 6.009},
                         Row{0.3, 2.0, 0.1, 0.1851, 7.184, none, none, 0.4097, 6.073}}) {
    const NormalizedServo servo{row.damping, row.inertia_ratio, row.friction_ratio, 0.3};
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
    ASSERT_NE(largest_stable(analysis), nullptr);
    EXPECT_NEAR(largest_stable(analysis)->amplitude, row.exact_amplitude, 5.1e-5);
    EXPECT_NEAR(largest_stable(analysis)->period, row.exact_period, 5.1e-4);
    std::size_t held = 0;
    for (const DescribedCycle& cycle : describing_function_estimate(servo)) {
      if (!cycle.stable) continue;
      const bool is_held = cycle.load == LoadInGap::held_by_friction;
      held += is_held ? 1 : 0;
      EXPECT_NEAR(cycle.amplitude, is_held ? row.held_amplitude : row.coasting_amplitude, 5.1e-5);
      EXPECT_NEAR(cycle.period, is_held ? row.held_period : row.coasting_period, 5.1e-4);
    }
    EXPECT_EQ(held, std::isnan(row.held_amplitude) ? 0U : 1U);
  }
}

TEST(HarmonicBalanceProperty, EstimateHasTheCyclesThatTheHeaderStates) {
  SeededDraws draws(1960);
  for (int count = 0; count < 200; ++count) {
    const double damping = draws.log_uniform(1e-6, 1e3);
    const NormalizedServo servo{damping, draws.log_uniform(0.1, 10.0), draws.uniform(0.0, 1.0),
                                draws.log_uniform(1e-3, 1.0)};
    const std::vector<DescribedCycle> estimate = describing_function_estimate(servo);
    const bool has_held = damping < 0.270504;
    ASSERT_EQ(estimate.size(), has_held ? 3U : 1U) << damping;
    for (const DescribedCycle& cycle : estimate) {
      EXPECT_LT(cycle.residual, 1e-10) << damping;  // of relative errors of gains of either size
      EXPECT_GT(cycle.amplitude, 0.0);
    }
    EXPECT_TRUE(estimate.back().stable);
    EXPECT_EQ(estimate.back().load, LoadInGap::coasting);
    if (has_held) {
      EXPECT_FALSE(estimate[0].stable);
      EXPECT_TRUE(estimate[1].stable);
      EXPECT_LT(estimate[0].amplitude, estimate[1].amplitude);
      EXPECT_EQ(estimate[1].load, LoadInGap::held_by_friction);
    }
    NormalizedServo wider = servo;
    wider.backlash *= 2.0;
    EXPECT_NEAR(describing_function_estimate(wider).back().amplitude,
                2.0 * estimate.back().amplitude, 100.0 * epsilon * estimate.back().amplitude);
  }
}

TEST(HarmonicBalanceEdge, EstimateOfServosWithoutFrictionOrBacklashIsEmpty) {
  EXPECT_TRUE(describing_function_estimate({.damping = 0.0, .backlash = 0.1}).empty());
  EXPECT_TRUE(describing_function_estimate({.damping = 0.1, .backlash = 0.0}).empty());
}

}  // namespace
}  // namespace gearlash::harmonic_balance_test
