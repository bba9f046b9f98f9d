// Controllers as linear ones: their transfer functions are those that their names stand for, and
// C (sI − A)⁻¹ B + D worked out at single s.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <random>

#include "model/rational_function.hpp"

namespace gearlash::drive::controller_transfer_test {
namespace {

using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;

/// In long double, for the direct way rounds too.
Eigen::Matrix<LongComplex, 1, 3> direct_transfer(const LinearController& controller, Complex at) {
  using Matrix = Eigen::Matrix<LongComplex, Eigen::Dynamic, Eigen::Dynamic>;
  const auto order = static_cast<Eigen::Index>(controller.order());
  Matrix dynamics = LongComplex(at) * Matrix::Identity(order, order);
  Matrix input(order, 3);
  Matrix output(1, order);
  Eigen::Matrix<LongComplex, 1, 3> result;
  for (Eigen::Index i = 0; i < order; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < order; ++j) {
      dynamics(i, j) -= controller.state_matrix[row][static_cast<std::size_t>(j)];
    }
    for (Eigen::Index j = 0; j < 3; ++j) {
      input(i, j) = controller.input_matrix[row][static_cast<std::size_t>(j)];
    }
    output(i) = controller.output[row];
  }
  for (Eigen::Index j = 0; j < 3; ++j) result(j) = controller.direct[static_cast<std::size_t>(j)];
  if (order > 0) result += output * dynamics.partialPivLu().solve(input);
  return result;
}

Complex value_of(const TransferFunction& transfer, Complex s) {
  const auto polynomial = [s](const std::vector<double>& coefficients) {
    Complex value = 0.0;
    for (const double coefficient : coefficients) value = value * s + coefficient;
    return value;
  };
  return polynomial(transfer.numerator) / polynomial(transfer.denominator);
}

/// As doubles. Denominators begin with 1; a zero function has the numerator {0}.
struct ControllerTransfer {
  TransferFunction reference;
  TransferFunction position;
  TransferFunction speed;
};

ControllerTransfer controller_transfer(const LinearController& controller) {
  const ExactControllerTransfer exact = exact_transfer(controller, TorqueGiven::as_asked);
  return {rounded(exact.reference), rounded(exact.position), rounded(exact.speed)};
}

void expect_same(const LinearController& controller, Complex s) {
  const ControllerTransfer transfer = controller_transfer(controller);
  const auto expected = direct_transfer(controller, s);
  const TransferFunction* found[] = {&transfer.reference, &transfer.position, &transfer.speed};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Complex exact(expected(i));
    EXPECT_LT(std::abs(value_of(*found[i], s) - exact), 1e-12 * std::abs(exact) + 1e-300)
        << "input " << i << ", s = " << s;
  }
}

void expect_transfer(const Controller& controller, Complex s, Complex of_error, Complex of_speed) {
  const auto found = direct_transfer(linear_controller(controller), s);
  const double size = std::abs(of_error) + std::abs(of_speed);
  EXPECT_LT(std::abs(Complex(found(0)) - of_error), 1e-14 * size);
  EXPECT_LT(std::abs(Complex(found(1)) + of_error), 1e-14 * size);
  EXPECT_LT(std::abs(Complex(found(2)) + of_speed), 1e-14 * size);
}

TEST(OracleController, HasTheTransferFunctionOfItsName) {
  for (const Complex s : {Complex{0.3, 1.7}, Complex{2.0, -0.4}, Complex{0.0, 11.0}}) {
    expect_transfer(ProportionalDerivative{3.0, 0.7}, s, 3.0, 0.7);
    const ProportionalIntegralDerivative pid{3.0, 2.0, 0.7, 0.0, 0.0};
    expect_transfer(pid, s, 3.0 + 2.0 / s, 0.7);
    const ProportionalIntegralDerivative filtered{3.0, 2.0, 0.7, 0.05, 0.0};
    expect_transfer(filtered, s, 3.0 + 2.0 / s + 0.7 * s / (0.05 * s + 1.0), 0.0);
    const Cascade cascade{4.0, 0.6, 1.5, 0.0};
    expect_transfer(cascade, s, 4.0 * (0.6 + 1.5 / s), 0.6 + 1.5 / s);
    for (const double integral : {0.0, 1.5}) {
      const Cascade of_filtered_speed{4.0, 0.6, integral, 0.0, 0.05};
      const Complex speed = 0.6 + integral / s;
      expect_transfer(of_filtered_speed, s, 4.0 * speed, speed / (0.05 * s + 1.0));
    }
    const LeadLag lead{2.0, 1.5, 9.0};
    expect_transfer(lead, s, 2.0 * (s / 1.5 + 1.0) / (s / 9.0 + 1.0), 0.0);
    const ErrorTransfer any{{{0.0, 2.0, 1.0, 3.0}, {0.5, 4.0, 1.0, 7.0}}};
    const Complex exact = (2.0 * s * s + s + 3.0) / (0.5 * s * s * s + 4.0 * s * s + s + 7.0);
    expect_transfer(any, s, exact, 0.0);
    const ErrorTransfer biproper{{{2.0, 1.0, 3.0}, {4.0, 1.0, 7.0}}};
    expect_transfer(biproper, s, (2.0 * s * s + s + 3.0) / (4.0 * s * s + s + 7.0), 0.0);
  }
}

TEST(EdgeController, AnImproperTransferFunctionIsRefused) {
  const ErrorTransfer improper{{{1.0, 0.0, 0.0}, {1.0, 1.0}}};
  const auto found = faults(Controller(improper));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].path, "controller.numerator");
  EXPECT_EQ(faults(Controller(LeadLag{1.0, 0.0, -1.0})).size(), 2U);
}

TEST(IntegralAction, IsAPoleAtZeroThatThePositionMoves) {
  for (const Controller& with : std::vector<Controller>{
           ProportionalIntegralDerivative{1.0, 0.1, 0.2, 0.05},
           Cascade{.position = 3.0, .speed = 1.0, .speed_integral = 2.0},
           ErrorTransfer{{{1.0, 2.0}, {1.0, 3.0, 0.0}}},
           SampledTransfer{.numerator = {1.0, -0.9}, .denominator = {1.0, -1.0}},
           // 0 and −2, turned so that no number is 0
           LinearController{.state_matrix = {{-1.0, 1.0}, {1.0, -1.0}},
           .input_matrix = {{1.0, -1.0, 0.0}, {0.5, -0.5, 0.0}},
           .output = {1.0, 0.0}}}) {
    EXPECT_TRUE(integrates(with)) << with.index();
  }
  for (const Controller& without : std::vector<Controller>{
           ProportionalDerivative{1.0, 0.1}, ProportionalIntegralDerivative{1.0, 0.0, 0.2, 0.05},
           Cascade{.position = 3.0, .speed = 1.0}, LeadLag{1.0, 2.0, 5.0},
           ErrorTransfer{{{1.0, 2.0}, {1.0, 3.0, 1e-3}}},
           SampledTransfer{.numerator = {1.0, -0.9}, .denominator = {1.0, -0.999}},
           // an integral of the speed alone, which is 0 where the position stands
           LinearController{
               .state_matrix = {{0.0}}, .input_matrix = {{0.0, 0.0, 1.0}}, .output = {1.0}}}) {
    EXPECT_FALSE(integrates(without)) << without.index();
  }
}

TEST(OracleControllerTransfer, IsThatOfTheStateSpace) {
  const std::vector<Controller> controllers = {
      ProportionalDerivative{3.0, 0.7},
      ProportionalIntegralDerivative{.proportional = 3.0, .integral = 2.0, .derivative = 0.7},
      ProportionalIntegralDerivative{3.0, 2.0, 0.7, 0.05, 0.0},
      ProportionalIntegralDerivative{3.0, 2.0, 0.7, 1e-4, 0.1, true},
      Cascade{4.0, 0.6, 1.5, 0.2},
      Cascade{4.0, 0.6, 1.5, 0.2, 0.005},
      LeadLag{2.0, 1.5, 9.0},
      ErrorTransfer{{{0.5, 2.0, 1.0, 3.0, 8.0, 1.0}, {0.5, 4.0, 1.0, 7.0, 1.0, 2.0, 3.0}}}};
  for (const Controller& controller : controllers) {
    for (const Complex s : {Complex{0.0, 0.03}, Complex{0.3, 1.7}, Complex{0.0, 900.0}}) {
      expect_same(linear_controller(controller), s);
    }
  }
}

/// Full matrices of order 6, of rates from 1e-3 to 1e3 per second. The condition of the value by
/// the coefficients is that of Horner's rule, which is why s is not next to a pole.
TEST(PropertyControllerTransfer, HoldsForAnyMatrices) {
  constexpr unsigned seed = 20260711;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> number;
  std::uniform_real_distribution<double> decade(-3.0, 3.0);
  for (int i = 0; i < 30; ++i) {
    LinearController controller;
    const std::size_t order = 1 + static_cast<std::size_t>(i) % 6;
    for (std::size_t row = 0; row < order; ++row) {
      const double rate = std::pow(10.0, decade(random));
      controller.state_matrix.emplace_back();
      for (std::size_t column = 0; column < order; ++column) {
        controller.state_matrix[row].push_back(rate * number(random));
      }
      controller.input_matrix.push_back({number(random), number(random), number(random)});
      controller.output.push_back(number(random));
    }
    controller.direct = {number(random), number(random), number(random)};
    expect_same(controller, Complex{0.0, 2.0e4});
    expect_same(controller, Complex{7.0e3, 1.0e4});
  }
}

TEST(EdgeControllerTransfer, ModesThatTheTorqueDoesNotShowAreLeftOut) {
  LinearController controller;
  controller.state_matrix = {{-1.0, 0.0}, {0.0, 5.0}};
  controller.input_matrix = {{1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}};
  controller.output = {3.0, 0.0};
  const ControllerTransfer transfer = controller_transfer(controller);
  EXPECT_EQ(transfer.reference, (TransferFunction{{3.0}, {1.0, 1.0}}));
  EXPECT_EQ(transfer.position, (TransferFunction{{-3.0}, {1.0, 1.0}}));
  EXPECT_EQ(transfer.speed, (TransferFunction{{0.0}, {1.0}}));
}

}  // namespace
}  // namespace gearlash::drive::controller_transfer_test
