// Factors that a controller's numerator and denominator share cancel in proofs as in rationals.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/seeded_draws.hpp"
#include "model/rational_function.hpp"
#include "model/reduced_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/loop/energy/absence_by_energy.hpp"
#include "question/loop/energy/loop_polynomials.hpp"
#include "question/loop/energy/mesh_torque.hpp"

namespace gearlash::common_factors_test {
namespace {

using drive::Rational;
using drive::RationalFunction;

using Coefficients = std::vector<double>;  ///< by descending powers

Coefficients product(const Coefficients& a, const Coefficients& b) {
  Coefficients result(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  }
  return result;
}

/// Of so few binary digits that products of four are exact.
double few_digits(SeededDraws& draws, double lowest, double highest) {
  return std::ldexp(std::round(std::ldexp(draws.log_uniform(lowest, highest), 6)), -6);
}

/// The motor holds itself, or the load does, by a lead-lag controller.
Drive lead_drive(SeededDraws& draws) {
  Drive drive;
  const double share = draws.uniform(0.1, 0.9);
  drive.motor = {.kind = TorqueControl{},
                 .inertia = share,
                 .friction = {.viscous = draws.log_uniform(0.1, 3.0)}};
  drive.load = {.inertia = 1.0 - share, .friction = {.viscous = draws.log_uniform(0.1, 3.0)}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.1};
  drive.sensor.position = draws.happens(0.5) ? SensorPlace::motor : SensorPlace::load;
  const double pole = few_digits(draws, 1.0, 30.0);
  drive.controller.law = TransferFunctionController{
      .gain = 1.0, .numerator = {few_digits(draws, 0.1, 30.0), pole}, .denominator = {1.0, pole}};
  return drive;
}

/// By (s + a) (s² + 2 d w s + w²), of few digits, so that products are exact.
Drive with_common_factors(Drive drive, SeededDraws& draws) {
  const double frequency = few_digits(draws, 0.3, 30.0);
  const Coefficients factors =
      product({1.0, few_digits(draws, 0.1, 30.0)},
              {1.0, 2.0 * few_digits(draws, 0.1, 2.0) * frequency, frequency * frequency});
  auto& law = std::get<TransferFunctionController>(drive.controller.law);
  law.numerator = product(law.numerator, factors);
  law.denominator = product(law.denominator, factors);
  return drive;
}

/// What is proved does not change, nor do bounds by more than their proofs are loose.
TEST(OracleCommonFactors, ChangeNoProof) {
  SeededDraws draws(20261128);
  int proved = 0;
  int bounded = 0;
  int with_torque = 0;
  int lost = 0;
  constexpr int count = 300;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Drive plain = lead_drive(draws);
    const auto reduced = reduce(plain);
    const auto longer = reduce(with_common_factors(plain, draws));
    const bool is_absent = is_absent_by_energy(reduced);
    EXPECT_EQ(is_absent_by_energy(longer), is_absent);
    proved += is_absent ? 1 : 0;
    const auto ceiling = ceiling_of(reduced).load;
    const auto with_factors = ceiling_of(longer).load;
    ASSERT_EQ(with_factors.has_value(), ceiling.has_value());
    if (!ceiling) continue;
    ++bounded;
    EXPECT_NEAR(*with_factors, *ceiling, 1e-3 * *ceiling);
    // Its bound is searched: where it is 0 but for rounding, chance decides.
    const double torque = highest_mean_mesh_torque(reduced).value_or(0.0);
    if (torque < 1e-6) continue;
    ++with_torque;
    const double with_longer = highest_mean_mesh_torque(longer).value_or(0.0);
    lost += with_longer == 0.0 ? 1 : 0;
    if (with_longer > 0.0) {
      EXPECT_NEAR(with_longer, torque, 2e-2 * torque);
    }
  }
  EXPECT_GT(proved, count / 10);
  EXPECT_GT(bounded, count / 2);
  EXPECT_GT(with_torque, count / 4);
  EXPECT_LE(50 * lost, with_torque);
}

/// The polynomials of a proof contain multiples of the rational function in lowest terms.
TEST(OracleCommonFactors, StandInBothPolynomials) {
  SeededDraws draws(1960);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto reduced = reduce(with_common_factors(lead_drive(draws), draws));
    const LoopPolynomials loop = loop_polynomials(linear_drive(EnclosedDrive(reduced)));
    const RationalFunction exact =
        exact_transfer(reduced.controller, drive::TorqueGiven::as_asked).position;
    ASSERT_LE(exact.denominator().degree(), 1U);  // the factors cancelled
    const auto& numerator = exact.numerator().data();
    const auto& denominator = exact.denominator().data();
    // −position · exact denominator = exact numerator · denominator
    const std::size_t size = loop.position.size() + denominator.size() - 1;
    for (std::size_t power = 0; power < size; ++power) {
      Rational low = 0;
      Rational high = 0;
      const auto add = [&](const Interval& number, const Rational& factor) {
        const Rational a = Rational(number.low) * factor;
        const Rational b = Rational(number.high) * factor;
        low += std::min(a, b);
        high += std::max(a, b);
      };
      for (std::size_t j = 0; j < loop.position.size(); ++j) {
        if (power < j) continue;
        if (power - j < denominator.size()) add(loop.position[j], denominator[power - j]);
        if (power - j < numerator.size()) add(loop.denominator[j], numerator[power - j]);
      }
      EXPECT_LE(low, 0) << "power " << power;
      EXPECT_GE(high, 0) << "power " << power;
    }
  }
}

}  // namespace
}  // namespace gearlash::common_factors_test
