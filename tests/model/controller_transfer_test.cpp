// Controllers as linear ones: their transfer functions are those that their names stand for, and
// C (sI − A)⁻¹ B + D worked out at single s.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <random>

#include "controllers.hpp"
#include "gearlash/drive.hpp"
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

void expect_transfer(const LinearController& controller, Complex s, Complex of_error,
                     Complex of_speed) {
  const auto found = direct_transfer(controller, s);
  const double size = std::abs(of_error) + std::abs(of_speed);
  EXPECT_LT(std::abs(Complex(found(0)) - of_error), 1e-14 * size);
  EXPECT_LT(std::abs(Complex(found(1)) + of_error), 1e-14 * size);
  EXPECT_LT(std::abs(Complex(found(2)) + of_speed), 1e-14 * size);
}

TEST(OracleController, HasTheTransferFunctionOfItsName) {
  for (const Complex s : {Complex{0.3, 1.7}, Complex{2.0, -0.4}, Complex{0.0, 11.0}}) {
    expect_transfer(at_load(PID{PIDTerms::PD, 3.0, 0.0, 0.7}), s, 3.0, 0.7);
    const PID pid{PIDTerms::PID, 3.0, 2.0, 0.7};
    expect_transfer(at_load(pid), s, 3.0 + 2.0 / s, 0.7);
    const PID filtered{PIDTerms::PID, 3.0, 2.0, 0.7, 0.05};
    expect_transfer(at_load(filtered), s, 3.0 + 2.0 / s + 0.7 * s / (0.05 * s + 1.0), 0.0);
    const CascadeController cascade{4.0, 0.6, 1.5};
    expect_transfer(at_load(cascade), s, 4.0 * (0.6 + 1.5 / s), 0.6 + 1.5 / s);
    for (const double integral : {0.0, 1.5}) {
      const CascadeController of_filtered_speed{4.0, 0.6, integral, 0.0, 0.05};
      const Complex speed = 0.6 + integral / s;
      expect_transfer(at_load(of_filtered_speed), s, 4.0 * speed, speed / (0.05 * s + 1.0));
    }
    const LeadLagController lead{2.0, 1.5, 9.0};
    expect_transfer(at_load(lead), s, 2.0 * (s / 1.5 + 1.0) / (s / 9.0 + 1.0), 0.0);
    const TransferFunctionController any{1.0, {0.0, 2.0, 1.0, 3.0}, {0.5, 4.0, 1.0, 7.0}};
    const Complex exact = (2.0 * s * s + s + 3.0) / (0.5 * s * s * s + 4.0 * s * s + s + 7.0);
    expect_transfer(at_load(any), s, exact, 0.0);
    const TransferFunctionController biproper{1.0, {2.0, 1.0, 3.0}, {4.0, 1.0, 7.0}};
    expect_transfer(at_load(biproper), s, (2.0 * s * s + s + 3.0) / (4.0 * s * s + s + 7.0), 0.0);
  }
}

TEST(EdgeController, AnImproperTransferFunctionIsRefused) {
  Drive drive;
  drive.motor.inertia = drive.load.inertia = drive.gearbox.backlash = 1.0;
  drive.controller.law = TransferFunctionController{1.0, {1.0, 0.0, 0.0}, {1.0, 1.0}};
  const auto found = faults(drive);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].path, "controller.num");
  drive.controller.law = LeadLagController{1.0, 0.0, -1.0};
  EXPECT_EQ(faults(drive).size(), 2U);
}

TEST(IntegralAction, IsAPoleAtZeroThatThePositionMoves) {
  for (const LinearController& with : std::vector<LinearController>{
           at_load(PID{PIDTerms::PID, 1.0, 0.1, 0.2, 0.05}),
           at_load(CascadeController{.position = 3.0, .speed = 1.0, .speed_integral = 2.0}),
           at_load(TransferFunctionController{1.0, {1.0, 2.0}, {1.0, 3.0, 0.0}}),
           at_load(TransferFunctionController{.gain = 1.0,
           .numerator = {1.0, -0.9},
           .denominator = {1.0, -1.0},
           .is_sampled = true}),
           // 0 and −2, turned so that no number is 0
           LinearController{.state_matrix = {{-1.0, 1.0}, {1.0, -1.0}},
           .input_matrix = {{1.0, -1.0, 0.0}, {0.5, -0.5, 0.0}},
           .output = {1.0, 0.0}}}) {
    EXPECT_TRUE(integrates(with)) << with.order();
  }
  for (const LinearController& without : std::vector<LinearController>{
           at_load(PID{PIDTerms::PD, 1.0, 0.0, 0.1}),
           at_load(PID{PIDTerms::PID, 1.0, 0.0, 0.2, 0.05}),
           at_load(CascadeController{.position = 3.0, .speed = 1.0}),
           at_load(LeadLagController{1.0, 2.0, 5.0}),
           at_load(TransferFunctionController{1.0, {1.0, 2.0}, {1.0, 3.0, 1e-3}}),
           at_load(TransferFunctionController{.gain = 1.0,
           .numerator = {1.0, -0.9},
           .denominator = {1.0, -0.999},
           .is_sampled = true}),
           // an integral of the speed alone, which is 0 where the position stands
           LinearController{
               .state_matrix = {{0.0}}, .input_matrix = {{0.0, 0.0, 1.0}}, .output = {1.0}}}) {
    EXPECT_FALSE(integrates(without)) << without.order();
  }
}

TEST(OracleControllerTransfer, IsThatOfTheStateSpace) {
  const std::vector<LinearController> controllers = {
      at_load(PID{PIDTerms::PD, 3.0, 0.0, 0.7}),
      at_load(PID{.terms = PIDTerms::PID, .proportional = 3.0, .integral = 2.0, .derivative = 0.7}),
      at_load(PID{PIDTerms::PID, 3.0, 2.0, 0.7, 0.05, 0.0}),
      at_load(PID{PIDTerms::PID, 3.0, 2.0, 0.7, 1e-4, 0.1, true}),
      at_load(CascadeController{4.0, 0.6, 1.5, 0.2}),
      at_load(CascadeController{4.0, 0.6, 1.5, 0.2, 0.005}),
      at_load(LeadLagController{2.0, 1.5, 9.0}),
      at_load(TransferFunctionController{
          1.0, {0.5, 2.0, 1.0, 3.0, 8.0, 1.0}, {0.5, 4.0, 1.0, 7.0, 1.0, 2.0, 3.0}})};
  for (const LinearController& controller : controllers) {
    for (const Complex s : {Complex{0.0, 0.03}, Complex{0.3, 1.7}, Complex{0.0, 900.0}}) {
      expect_same(controller, s);
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
