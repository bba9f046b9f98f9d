// Gains against published numbers, many digits, and quadrature of the waveforms themselves.
#include "question/loop/describing/describing_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "base/correct_digits.hpp"
#include "base/references.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::describing_function_test {
namespace {

using Complex = std::complex<double>;

constexpr double pi = boost::math::constants::pi<double>();

// ---- Waveforms over half a period; the other half is the mirror image.

struct Waveform {
  double start;               ///< of the half period, in radians of the input A sin τ
  std::vector<double> kinks;  ///< within it
  std::function<double(double)> output;
};

/// N = (2j/πA) ∫ y e^{−jτ} dτ over the half period.
Complex gain_by_quadrature(const Waveform& waveform, double amplitude) {
  std::vector<double> ends{waveform.start};
  ends.insert(ends.end(), waveform.kinks.begin(), waveform.kinks.end());
  ends.push_back(waveform.start + pi);
  std::sort(ends.begin(), ends.end());
  Complex integral = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const auto part = [&](auto turned) {
      return boost::math::quadrature::gauss<double, 30>::integrate(
          [&](double angle) { return waveform.output(angle) * turned(angle); }, ends[i],
          ends[i + 1]);
    };
    integral += Complex{part([](double angle) { return std::cos(angle); }),
                        -part([](double angle) { return std::sin(angle); })};
  }
  return Complex{0.0, 2.0 / (pi * amplitude)} * integral;
}

/// By bisection: `crossed` is false at `low` and true at `high`.
double first_angle(const std::function<bool(double)>& crossed, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (crossed(middle) ? high : low) = middle;
  }
  return high;
}

/// From the crest of the input on: held at A − h until the other face comes, then pulled down.
Waveform waveform_of(const FrictionControlledBacklash& backlash, double amplitude) {
  const double half_gap = 0.5 * backlash.gap;
  const double held = amplitude - half_gap;
  const auto input = [=](double angle) { return amplitude * std::sin(angle); };
  const double contact = first_angle([&](double angle) { return input(angle) + half_gap <= held; },
                                     0.5 * pi, 1.5 * pi);
  return {0.5 * pi, {contact}, [=](double angle) {
            return angle < contact ? held : input(angle) + half_gap;
          }};
}

/// From where the input is fastest on: at that speed until the other face comes.
Waveform waveform_of(const InertiaControlledBacklash& backlash, double amplitude) {
  const double half_gap = 0.5 * backlash.gap;
  const auto coasting = [=](double angle) { return amplitude * angle - half_gap; };
  const auto face = [=](double angle) { return amplitude * std::sin(angle) + half_gap; };
  const double contact =
      first_angle([&](double angle) { return coasting(angle) >= face(angle); }, 0.0, pi);
  return {0.0, {contact}, [=](double angle) {
            return angle < contact ? coasting(angle) : face(angle);
          }};
}

Waveform waveform_of(const CoulombFriction& friction, double) {
  return {0.0, {}, [=](double) { return friction.torque; }};
}
Waveform waveform_of(const RelayWithHysteresis& relay, double amplitude) {
  const double on = first_angle(
      [&](double angle) { return amplitude * std::sin(angle) >= relay.half_width; }, 0.0, 0.5 * pi);
  return {on, {}, [=](double) { return relay.level; }};
}
Waveform waveform_of(const Saturation& saturation, double amplitude) {
  const auto wanted = [=](double angle) { return saturation.slope * amplitude * std::sin(angle); };
  const double corner =
      first_angle([&](double angle) { return wanted(angle) >= saturation.limit; }, 0.0, 0.5 * pi);
  return {0.0, {corner, pi - corner}, [=](double angle) {
            return std::min(wanted(angle), saturation.limit);
          }};
}
Waveform waveform_of(const DeadZone& zone, double amplitude) {
  const auto beyond = [=](double angle) { return amplitude * std::sin(angle) - zone.half_width; };
  const double corner =
      first_angle([&](double angle) { return beyond(angle) >= 0.0; }, 0.0, 0.5 * pi);
  return {0.0, {corner, pi - corner}, [=](double angle) {
            return zone.slope * std::max(beyond(angle), 0.0);
          }};
}

/// One of each kind, of random size.
std::vector<Nonlinearity> one_of_each(SeededDraws& draws) {
  const auto size = [&] { return draws.log_uniform(0.1, 10.0); };
  const double gap = size();
  const double level = size();
  const double width = size();
  const double slope = size();
  return {FrictionControlledBacklash{gap},
          InertiaControlledBacklash{gap},
          RelayWithHysteresis{level, width},
          Saturation{level, slope},
          CoulombFriction{level},
          DeadZone{width, slope}};
}

/// Where the gain begins to depend on the amplitude.
double least_amplitude(const Nonlinearity& nonlinearity) {
  struct {
    double operator()(const FrictionControlledBacklash& n) const { return 0.5 * n.gap; }
    double operator()(const InertiaControlledBacklash& n) const { return n.gap / pi; }
    double operator()(const RelayWithHysteresis& n) const { return n.half_width; }
    double operator()(const Saturation& n) const { return n.limit / n.slope; }
    double operator()(const CoulombFriction&) const { return 1.0; }
    double operator()(const DeadZone& n) const { return n.half_width; }
  } least;
  return std::visit(least, nonlinearity);
}

TEST(DescribingFunctionOracle, FrictionControlledBacklashHasThePublishedGains) {
  const FrictionControlledBacklash backlash{2.0};
  const auto gain_at = [&](double ratio) { return describing_gain(backlash, 1.0 / ratio); };
  expect_digits("gain_at_a_half", gain_at(0.5).real(), 0.5, 15.0);
  expect_digits("lag_at_a_half", gain_at(0.5).imag(), -1.0 / pi, 15.0);
  expect_digits("gain_at_a_quarter", gain_at(0.25).real(), 0.804499, 6.8);
  expect_digits("lag_at_a_quarter", gain_at(0.25).imag(), -0.238732, 5.7);
  expect_digits("gain_at_a_tenth", gain_at(0.1).real(), 0.947956, 7.6);
  expect_digits("lag_at_a_tenth", gain_at(0.1).imag(), -0.114592, 5.4);
}

/// At c = π the output is a triangle of slope A, whose first harmonic is 4A/π a quarter turn late.
TEST(DescribingFunctionOracle, InertiaControlledBacklashEndsAsATriangle) {
  const InertiaControlledBacklash backlash{2.0};
  const Complex gain = describing_gain(backlash, std::nextafter(2.0 / pi, 1.0));
  EXPECT_NEAR(std::abs(gain - Complex(0.0, -4.0 / pi)), 0.0, 8.0 * epsilon);
  // c = π/2: 2h/A = π/2 − 1, N = 1/2 + 2/π − j/π.
  const Complex middle = describing_gain(backlash, 2.0 / (0.5 * pi - 1.0));
  EXPECT_NEAR(std::abs(middle - Complex(0.5 + 2.0 / pi, -1.0 / pi)), 0.0, 8.0 * epsilon);
}

/// The textbooks' forms. Each part of N to some epsilons, times how much an epsilon in A changes
/// it: near A = h that is A/(A − h) and is avoided by amplitudes that are exact.
TEST(DescribingFunctionOracle, GainsKeepTheirDigitsAtBothEnds) {
  for (const Reference& exact : References("question", "describing_gains")) {
    const double number = exact.input("number");
    SCOPED_TRACE(testing::Message() << exact.kind() << " " << number);
    if (exact.kind() == "coasting") {  // the number is h/A
      const Complex gain = describing_gain(InertiaControlledBacklash{2.0 * number}, 1.0);
      EXPECT_LT(epsilons_of(gain.real(), exact["real"], 1.0), 4);  // it ends at 0
      EXPECT_LT(epsilons_off(gain.imag(), exact["imaginary"]), 8);
      continue;
    }
    const Complex play = describing_gain(FrictionControlledBacklash{2.0}, number);
    EXPECT_LT(epsilons_off(play.real(), exact["real"]), 8);
    EXPECT_LT(epsilons_off(play.imag(), exact["imaginary"]), 8);
    EXPECT_LT(epsilons_off(describing_gain(Saturation{}, number).real(), exact["saturation"]), 8);
    EXPECT_LT(epsilons_off(describing_gain(DeadZone{}, number).real(), exact["dead_zone"]), 8);
  }
}

TEST(DescribingFunctionProperty, GainIsThatOfTheWaveform) {
  SeededDraws draws(1968);
  for (int count = 0; count < 200; ++count) {
    for (const Nonlinearity& nonlinearity : one_of_each(draws)) {
      const double amplitude = least_amplitude(nonlinearity) * (1.0 + draws.log_uniform(1e-3, 1e3));
      const Waveform waveform =
          std::visit([&](const auto& n) { return waveform_of(n, amplitude); }, nonlinearity);
      const Complex gain = describing_gain(nonlinearity, amplitude);
      const Complex expected = gain_by_quadrature(waveform, amplitude);
      // The waveform may be a small difference of the input and the width of the gap.
      const double of_input = std::abs(describing_gain(nonlinearity, 1e6 * amplitude));
      const double scale = std::max(std::abs(gain), of_input);
      EXPECT_NEAR(std::abs(gain - expected), 0.0, 20.0 * epsilon * scale)
          << "kind " << nonlinearity.index() << " A " << amplitude;
    }
  }
}

/// A free mass between two faces, a step at a time, from any start: the gain comes of itself.
TEST(DescribingFunctionProperty, CoastingLoadSettlesOnTheWaveform) {
  SeededDraws draws(3);
  constexpr int steps = 4'000;
  constexpr double step = 2.0 * pi / steps;
  for (int count = 0; count < 20; ++count) {
    const double half_gap = 1.0 / draws.uniform(0.65, 5.0);
    double position = draws.uniform(-half_gap, half_gap);
    double speed = draws.uniform(-1.0, 1.0);
    Complex gain = 0.0;
    for (int index = 1; index <= 40 * steps; ++index) {
      const double angle = step * index;
      const double input = std::sin(angle);
      const double free = position + step * speed;
      position = std::clamp(free, input - half_gap, input + half_gap);
      if (position != free) speed = std::cos(angle);
      if (index > 39 * steps) gain += Complex{0.0, step / pi} * position * std::polar(1.0, -angle);
    }
    // First order in the step; contact is late by up to a step.
    const Complex expected = describing_gain(InertiaControlledBacklash{2.0 * half_gap}, 1.0);
    EXPECT_NEAR(std::abs(gain - expected), 0.0, 4.0 * step) << half_gap;
  }
}

TEST(DescribingFunctionProperty, SlopeIsTheDerivative) {
  SeededDraws draws(7);
  for (int count = 0; count < 50; ++count) {
    for (const Nonlinearity& nonlinearity : one_of_each(draws)) {
      const double amplitude =
          least_amplitude(nonlinearity) * (1.0 + draws.log_uniform(0.03, 30.0));
      const double step = 1e-4 * amplitude;
      const auto difference = [&](double distance) {
        return (describing_gain(nonlinearity, amplitude + distance) -
                describing_gain(nonlinearity, amplitude - distance)) /
               (2.0 * distance);
      };
      const Complex expected = (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
      const Complex slope = describing_gain_slope(nonlinearity, amplitude);
      // Richardson leaves (step/distance to the end)⁴, and rounding ε N/step.
      const double scale =
          std::abs(slope) + std::abs(describing_gain(nonlinearity, amplitude)) / amplitude;
      EXPECT_NEAR(std::abs(slope - expected), 0.0, 1e-8 * scale) << nonlinearity.index();
    }
  }
}

TEST(DescribingFunctionProperty, DirectionAndGainLeadBackToTheAmplitude) {
  SeededDraws draws(11);
  for (int count = 0; count < 200; ++count) {
    for (const Nonlinearity& nonlinearity : one_of_each(draws)) {
      const double amplitude = least_amplitude(nonlinearity) * (1.0 + draws.log_uniform(1e-6, 1e6));
      const Complex gain = describing_gain(nonlinearity, amplitude);
      if (has_lag(nonlinearity)) {
        const GainPoint point = gain_in_direction(nonlinearity, 3.0 * gain);
        // A lag that changes little with the amplitude says less of it, but says the gain as well.
        EXPECT_NEAR(std::abs(point.gain - gain), 0.0, 50.0 * epsilon * std::abs(gain));
        EXPECT_NEAR(std::abs(describing_gain(nonlinearity, point.amplitude) - gain), 0.0,
                    1e-9 * std::abs(gain));
      } else {
        const auto found = amplitude_of_gain(nonlinearity, gain.real());
        ASSERT_TRUE(found) << nonlinearity.index() << " A " << amplitude;
        const double condition =
            std::abs(gain / (amplitude * describing_gain_slope(nonlinearity, amplitude)));
        EXPECT_NEAR(*found, amplitude, 20.0 * epsilon * amplitude * (1.0 + condition))
            << nonlinearity.index();
      }
    }
  }
}

/// What has_lag() states and harmonic_balance() rests on.
TEST(DescribingFunctionProperty, LogSlopeIsMonotoneInTheLagAndOfOneSign) {
  for (const Nonlinearity& nonlinearity :
       {Nonlinearity{FrictionControlledBacklash{2.0}}, Nonlinearity{InertiaControlledBacklash{2.0}},
        Nonlinearity{RelayWithHysteresis{1.0, 1.0}}}) {
    const double sign = nonlinearity.index() == 0 ? -1.0 : 1.0;
    constexpr int points = 2'000;
    GainPoint last = gain_in_direction(nonlinearity, std::polar(1.0, -0.5 * pi / points));
    for (int i = 2; i < points; ++i) {
      const GainPoint point =
          gain_in_direction(nonlinearity, std::polar(1.0, -0.5 * pi * i / points));
      EXPECT_GT(sign * point.log_slope, 0.0) << i;
      EXPECT_LT(point.log_slope, last.log_slope) << i;
      EXPECT_LT(point.amplitude, last.amplitude) << i;
      EXPECT_GT(sign * (std::abs(point.gain) - std::abs(last.gain)), 0.0) << i;
      // The slope is that of the curve: the mean of it lies between those at the ends.
      const double mean = std::log(std::abs(point.gain / last.gain)) / (0.5 * pi / points);
      EXPECT_LT(mean, last.log_slope + 1e-9 * std::abs(last.log_slope)) << i;
      EXPECT_GT(mean, point.log_slope - 1e-9 * std::abs(point.log_slope)) << i;
      last = point;
    }
  }
}

TEST(DescribingFunctionEdge, BelowTheLeastAmplitude) {
  EXPECT_EQ(describing_gain(FrictionControlledBacklash{2.0}, 1.0), 0.0);
  EXPECT_EQ(describing_gain_slope(FrictionControlledBacklash{2.0}, 0.5), 0.0);
  EXPECT_TRUE(std::isnan(describing_gain(InertiaControlledBacklash{2.0}, 0.63).real()));
  EXPECT_TRUE(std::isnan(describing_gain_slope(InertiaControlledBacklash{2.0}, 0.63).imag()));
  EXPECT_EQ(describing_gain(RelayWithHysteresis{1.0, 1.0}, 0.9), 0.0);
  EXPECT_EQ(describing_gain(DeadZone{}, 1.0), 0.0);
  EXPECT_EQ(describing_gain(Saturation{1.0, 3.0}, 0.3), 3.0);
}

TEST(DescribingFunctionEdge, NoGapPassesEverything) {
  for (const Nonlinearity& nonlinearity :
       {Nonlinearity{FrictionControlledBacklash{}}, Nonlinearity{InertiaControlledBacklash{}}}) {
    EXPECT_EQ(describing_gain(nonlinearity, 2.0), 1.0);
    EXPECT_EQ(describing_gain_slope(nonlinearity, 2.0), 0.0);
    EXPECT_FALSE(has_lag(nonlinearity));
    EXPECT_FALSE(amplitude_of_gain(nonlinearity, 1.0));
  }
  EXPECT_FALSE(has_lag(RelayWithHysteresis{1.0, 0.0}));
  EXPECT_EQ(describing_gain(RelayWithHysteresis{2.0, 0.0}, 0.5),
            describing_gain(CoulombFriction{2.0}, 0.5));
}

TEST(DescribingFunctionEdge, GainsThatAreNotReachedHaveNoAmplitude) {
  EXPECT_FALSE(amplitude_of_gain(Saturation{1.0, 2.0}, 2.0));
  EXPECT_FALSE(amplitude_of_gain(DeadZone{1.0, 2.0}, 2.5));
  EXPECT_FALSE(amplitude_of_gain(CoulombFriction{}, 0.0));
  EXPECT_FALSE(amplitude_of_gain(CoulombFriction{}, -1.0));
}

}  // namespace
}  // namespace gearlash::describing_function_test
