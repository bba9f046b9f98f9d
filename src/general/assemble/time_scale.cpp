#include "general/assemble/time_scale.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "base/special_numbers.hpp"
#include "model/stepped_drive.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::drive {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// A relay by its describing function at an amplitude of its threshold, or of half the gap.
LinearController linear_relay(const ReducedDrive& drive) {
  const double gain = 4.0 / std::numbers::pi * drive.controller.direct[0];
  if (drive.error_shape.is_of_speed) {
    constexpr double some = 1.0;  // rad/s, for a relay without thresholds
    const double speed = drive.error_shape.begins > 0.0 ? drive.error_shape.begins : some;
    return {.direct = {0.0, 0.0, -gain / speed}};
  }
  const double amplitude = std::max(drive.error_shape.begins, 0.5 * drive.backlash);
  const double stiffness = amplitude > 0.0 ? gain / amplitude : gain;
  return {.direct = {stiffness, -stiffness, 0.0}};
}

/// With those that are 0.
std::vector<std::complex<double>> all_eigenvalues(ReducedDrive drive) {
  if (drive.error_shape.is_relay()) drive.controller = linear_relay(drive);
  const LinearDrive<double> linear = linear_drive(drive);
  std::vector<std::complex<double>> values;
  if (linear.holds.empty()) {
    const Eigen::VectorXcd all = eigenvalues(balanced(flow_of(linear.loop())));
    values.assign(all.begin(), all.end());
    return values;
  }
  const Eigen::VectorXcd all =
      eigenvalues(balanced(flow_of(stepped_drive(linear, TorqueInput::requested).step)));
  for (const std::complex<double>& value : all) {
    constexpr double dead_beat = 1e-12;  // decays below rounding within one sample
    if (std::abs(value) > dead_beat) {
      values.push_back(std::log(value) / position_period(*drive.sampling));
    }
  }
  return values;
}

/// Removes the zero eigenvalues, within rounding, of numbers without a restoring action.
std::vector<std::complex<double>> without_free_numbers(std::vector<std::complex<double>> values) {
  double fastest = 0.0;
  for (const auto& value : values) fastest = std::max(fastest, std::abs(value));
  constexpr double nothing = 1e-9;  // of the fastest
  std::erase_if(values, [&](const auto& value) { return std::abs(value) <= nothing * fastest; });
  return values;
}

}  // namespace

std::vector<std::complex<double>> loop_eigenvalues(const ReducedDrive& drive) {
  return without_free_numbers(all_eigenvalues(drive));
}

TimeScales time_scales(const ReducedDrive& drive) {
  double slowest = infinity;
  double slowest_swing = infinity;
  double slowest_decay = infinity;
  for (const auto& value : loop_eigenvalues(drive)) {
    const double rate = std::abs(value);
    constexpr double swinging = 0.1;  // share of the modulus; a smaller imaginary part counts as
                                      // decay
    if (std::abs(value.imag()) > swinging * rate) slowest_swing = std::min(slowest_swing, rate);
    slowest = std::min(slowest, rate);
    constexpr double least_damping = 1e-3;  // bounds the settling time if damping is weak or absent
    slowest_decay = std::min(slowest_decay, std::max(-value.real(), least_damping * rate));
  }
  const double rate = std::isfinite(slowest_swing) ? slowest_swing : slowest;
  double swing = std::isfinite(rate) ? turn / rate : 1.0;
  for (const Signal& signal : {drive.reference, drive.load_torque}) {
    if (const auto* sine = std::get_if<Sine>(&signal)) {
      swing = std::max(swing, turn / sine->frequency);
    }
  }
  constexpr double samples = 10.0;  // shortest swing of interest, in sampling periods
  if (drive.sampling) swing = std::max(swing, samples * position_period(*drive.sampling));
  return {swing, std::isfinite(slowest_decay) ? 1.0 / slowest_decay : 0.0};
}

}  // namespace gearlash::drive
