#include "gearlash/drive/time_scale.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>

namespace gearlash::drive {
namespace {

using Complex = std::complex<double>;

/// The torque asked for by one of the inputs, at a frequency.
Complex response(const LinearController& controller, Eigen::Index input, Complex at) {
  const auto order = static_cast<Eigen::Index>(controller.order());
  const Complex direct = controller.direct[static_cast<std::size_t>(input)];
  if (order == 0) return direct;
  Eigen::MatrixXcd dynamics = at * Eigen::MatrixXcd::Identity(order, order);
  Eigen::VectorXcd gain(order);
  Eigen::RowVectorXcd output(order);
  for (Eigen::Index i = 0; i < order; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < order; ++j) {
      dynamics(i, j) -= controller.state_matrix[row][static_cast<std::size_t>(j)];
    }
    gain(i) = controller.input_matrix[row][static_cast<std::size_t>(input)];
    output(i) = controller.output[row];
  }
  return direct + output.dot(dynamics.partialPivLu().solve(gain));
}

}  // namespace

double slow_time(const Drive& drive) {
  const double inertia = drive.motor.inertia + drive.load.inertia;
  const double friction = drive.motor.friction.viscous + drive.load.friction.viscous;
  const LinearController controller = drive.sampling
                                          ? sampled_controller(drive.controller, *drive.sampling)
                                          : linear_controller(drive.controller);
  const auto gain = [&](double frequency) {
    const Complex s(0.0, frequency);
    const Complex at = drive.sampling ? std::exp(s * drive.sampling->period) : s;
    const Complex torque = response(controller, 1, at) + s * response(controller, 2, at);
    return std::abs(torque / (s * (inertia * s + friction)));
  };
  // From fast to slow; a computer does nothing faster than half its rate.
  constexpr double fastest = 1e9;
  constexpr double slowest = 1e-9;
  constexpr double factor = 0.9;
  const double highest = drive.sampling ? std::numbers::pi / drive.sampling->period : fastest;
  for (double frequency = highest; frequency > slowest; frequency *= factor) {
    if (gain(frequency) >= 1.0) return 2.0 * std::numbers::pi / frequency;
  }
  return drive.sampling ? drive.sampling->period : 1.0;
}

}  // namespace gearlash::drive
