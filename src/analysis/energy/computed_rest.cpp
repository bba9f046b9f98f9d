#include "analysis/energy/computed_rest.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "base/special_numbers.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;

/// τ = of_reference r + of_position y at rest; empty with an integrator.
struct StaticGains {
  double of_reference;
  double of_position;
};

std::optional<StaticGains> static_gains(const LinearController& controller) {
  const auto order = static_cast<Eigen::Index>(controller.order());
  if (order == 0) return StaticGains{controller.direct[0], controller.direct[1]};
  Eigen::MatrixXd flow(order, order);
  Eigen::VectorXd output(order);
  Eigen::MatrixXd input(order, 2);
  for (Eigen::Index i = 0; i < order; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < order; ++j) {
      flow(i, j) = controller.state_matrix[row][static_cast<std::size_t>(j)];
    }
    input(i, 0) = controller.input_matrix[row][0];
    input(i, 1) = controller.input_matrix[row][1];
    output[i] = controller.output[row];
  }
  const Eigen::VectorXd weights = -solved(flow.transpose(), output);
  const StaticGains gains{controller.direct[0] + weights.dot(input.col(0)),
                          controller.direct[1] + weights.dot(input.col(1))};
  const bool is_finite = std::isfinite(gains.of_reference) && std::isfinite(gains.of_position);
  return is_finite ? std::optional(gains) : std::nullopt;
}

/// The gaps that a mesh torque leaves.
std::vector<double> gaps(const ReducedDrive& drive, double mesh_torque) {
  const double half = 0.5 * drive.backlash;
  if (mesh_torque == 0.0) return {-half, half};
  const auto* faces = std::get_if<drive::CompliantContact>(&drive.contact);
  const double compression = faces == nullptr ? 0.0 : mesh_torque / faces->stiffness;
  return {std::copysign(half, mesh_torque) + compression};
}

}  // namespace

std::optional<Rest> computed_rest(const ReducedDrive& drive) {
  const auto* reference = std::get_if<double>(&drive.reference);
  const auto* load_torque = std::get_if<double>(&drive.load_torque);
  if (drive.sampling || drive.sensing.resolution > 0.0 || std::isfinite(drive.torque_limit) ||
      reference == nullptr || load_torque == nullptr || drive.gravity.stiffness != 0.0) {
    return std::nullopt;
  }
  const auto gains = static_gains(drive::linear_controller(drive.controller));
  if (!gains || !(gains->of_position < 0.0)) return std::nullopt;
  const double least = -*load_torque - drive.load.friction.breakaway;
  const double most = -*load_torque + drive.load.friction.breakaway;
  std::vector<double> mesh_torques{least, most};
  if (least < 0.0 && most > 0.0) mesh_torques.push_back(0.0);
  // Every extreme is at an end of the ranges, because all relations are linear.
  Rest rest{.load = {infinity, -infinity}, .motor = {infinity, -infinity}};
  const auto include = [](Bounds& range, double value) {
    range = {std::min(range.low, value), std::max(range.high, value)};
  };
  for (const double mesh_torque : mesh_torques) {
    for (const double way : {-1.0, 1.0}) {
      const double torque = mesh_torque + way * drive.motor.friction.breakaway;
      const double sensed = (torque - gains->of_reference * *reference) / gains->of_position;
      for (const double gap : gaps(drive, mesh_torque)) {
        const double load = sensed - (1.0 - drive.sensing.load_share_of_position) * gap;
        include(rest.load, load - *reference);
        include(rest.motor, load + gap - *reference);
      }
    }
  }
  rest.error = {-rest.load.high, -rest.load.low};
  return rest;
}

}  // namespace gearlash
