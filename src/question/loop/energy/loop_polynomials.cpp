#include "question/loop/energy/loop_polynomials.hpp"

#include <utility>

#include "numeric/decaying_motion.hpp"
#include "numeric/transfer_polynomials.hpp"

namespace gearlash {
namespace {

using Polynomial = IntervalPolynomial;

Polynomial times_s(Polynomial polynomial) {
  polynomial.insert(polynomial.begin(), Interval(0.0));
  return polynomial;
}

}  // namespace

Polynomial conjugate(Polynomial polynomial) {
  for (std::size_t i = 1; i < polynomial.size(); i += 2) polynomial[i] = -polynomial[i];
  return polynomial;
}

/// By the companion matrix.
bool is_stable(const Polynomial& polynomial) {
  const auto order = static_cast<Eigen::Index>(polynomial.size()) - 1;
  if (order == 0) return true;
  IntervalMatrix companion = IntervalMatrix::Constant(order, order, 0.0);
  companion.diagonal(1).setOnes();
  for (Eigen::Index i = 0; i < order; ++i) {
    companion(order - 1, i) = -(polynomial[static_cast<std::size_t>(i)] / polynomial.back());
  }
  return DecayingMotion::of(companion, TimeKind::continuous).has_value();
}

LoopPolynomials loop_polynomials(const LinearDrive<Interval>& drive) {
  TransferPolynomials<Interval> controller = transfer_polynomials(drive.controller);
  LoopPolynomials loop;
  loop.at_reference = std::move(controller.numerators[0]);
  loop.position = scaled(Interval(-1.0), std::move(controller.numerators[1]));
  loop.speed = scaled(Interval(-1.0), std::move(controller.numerators[2]));
  loop.denominator = std::move(controller.denominator);
  const Polynomial electrical = scaled(drive.back_emf, times_s(loop.denominator));
  if (drive.lags) loop.denominator = product({1.0, drive.electrical_time}, loop.denominator);
  loop.load_momentum = {drive.load_friction, drive.load_inertia};
  const auto shared = [&](const Interval& of_position, const Interval& of_speed) {
    return sum(scaled(of_position, loop.position), scaled(of_speed, times_s(loop.speed)));
  };
  const Polynomial motor_momentum{drive.motor_friction, drive.motor_inertia};
  loop.motor = sum(times_s(product(motor_momentum, loop.denominator)),
                   shared(1.0 - drive.position_share, 1.0 - drive.speed_share));
  if (drive.lags) loop.motor = sum(loop.motor, electrical);
  loop.load = times_s(loop.load_momentum);
  loop.load[0] = drive.weight;
  loop.closed = sum(loop.motor, sum(product(loop.load, loop.denominator),
                                    shared(drive.position_share, drive.speed_share)));
  return loop;
}

}  // namespace gearlash
