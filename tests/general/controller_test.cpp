// Controllers as linear ones: their transfer functions are those that their names stand for.
#include "model/controller.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>

#include "general/assemble/drive_system.hpp"

namespace gearlash::drive::controller_test {
namespace {

using Complex = std::complex<double>;

/// From (r, y, v) to the torque asked for.
Eigen::RowVector3cd transfer_of(const Controller& controller, Complex s) {
  const LinearController linear = linear_controller(controller);
  const auto order = static_cast<Eigen::Index>(linear.order());
  Eigen::MatrixXcd dynamics = s * Eigen::MatrixXcd::Identity(order, order);
  Eigen::MatrixXcd input(order, 3);
  Eigen::RowVectorXcd output(order);
  Eigen::RowVector3cd direct;
  for (Eigen::Index i = 0; i < order; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < order; ++j) {
      dynamics(i, j) -= linear.state_matrix[row][static_cast<std::size_t>(j)];
    }
    for (Eigen::Index j = 0; j < 3; ++j) {
      input(i, j) = linear.input_matrix[row][static_cast<std::size_t>(j)];
    }
    output(i) = linear.output[row];
  }
  for (Eigen::Index j = 0; j < 3; ++j) direct(j) = linear.direct[static_cast<std::size_t>(j)];
  if (order == 0) return direct;
  return output * dynamics.partialPivLu().solve(input) + direct;
}

void expect_transfer(const Controller& controller, Complex s, Complex of_error, Complex of_speed) {
  const Eigen::RowVector3cd found = transfer_of(controller, s);
  const double size = std::abs(of_error) + std::abs(of_speed);
  EXPECT_LT(std::abs(found(0) - of_error), 1e-14 * size);
  EXPECT_LT(std::abs(found(1) + of_error), 1e-14 * size);
  EXPECT_LT(std::abs(found(2) + of_speed), 1e-14 * size);
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
  const auto faults = validate(Controller(improper));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].path, "controller.numerator");
  EXPECT_EQ(validate(Controller(LeadLag{1.0, 0.0, -1.0})).size(), 2U);
}

/// An integrating controller whose motor sticks: the integral grows until it breaks away, the motor
/// jumps past its goal and sticks on the other side.
TEST(Controller, IntegralActionHuntsWithStiction) {
  ReducedDrive drive;
  drive.motor = {1.0, {.viscous = 0.1, .coulomb = 0.5, .breakaway = 1.0}};
  drive.load.inertia = 1.0;
  drive.backlash = 1e3;  // the load is out of reach
  drive.sensing = {.load_share_of_position = 0.0, .load_share_of_speed = 0.0};
  drive.controller =
      ProportionalIntegralDerivative{.proportional = 4.0, .integral = 2.0, .derivative = 3.0};
  const DriveSystem built = drive_system(drive);
  const auto start = drive_start(drive, built, {.motor_position = 0.2});
  const auto motion = simulate(built.system, start, {.until = 300.0});
  EXPECT_EQ(motion.stop_reason(), hybrid::StopReason::reached_end) << motion.culprit();
  // It breaks away on either side by turns.
  const auto& events = motion.events();
  ASSERT_GT(events.size(), 10U);
  const auto name_of = [&](const hybrid::Event& event) {
    return built.system.mode(event.mode).transitions[event.transition].name;
  };
  EXPECT_EQ(name_of(events[events.size() - 1]).rfind("motor", 0), 0U);
  EXPECT_NE(name_of(events[events.size() - 2]), name_of(events[events.size() - 4]));
}

}  // namespace
}  // namespace gearlash::drive::controller_test
