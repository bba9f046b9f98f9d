#include "analysis/energy/absence_by_energy.hpp"

#include <cmath>
#include <variant>
#include <vector>

#include "base/datum.hpp"
#include "numeric/decaying_motion.hpp"
#include "numeric/positive_polynomial.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;
using Polynomial = IntervalPolynomial;

/// τ = −(position y + speed v)/denominator; of s.
struct ControllerPolynomials {
  Polynomial denominator;
  Polynomial position;
  Polynomial speed;
};

std::vector<std::vector<Interval>> times(const std::vector<std::vector<Interval>>& a,
                                         const std::vector<std::vector<Interval>>& b) {
  const std::size_t size = a.size();
  std::vector<std::vector<Interval>> result(size, std::vector<Interval>(size, Interval(0.0)));
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      for (std::size_t j = 0; j < size; ++j) {
        result[i][j] = result[i][j] + a[i][k] * b[k][j];
      }
    }
  }
  return result;
}

/// det(s − A) and the adjugate's products, by Faddeev and LeVerrier:
///   adj(s − A) = Σ M_k s^{n−k}, M_1 = 1, c_{n−k} = −tr(A M_k)/k, M_{k+1} = A M_k + c_{n−k}.
ControllerPolynomials polynomials_of(const LinearController& controller) {
  const std::size_t order = controller.order();
  std::vector<std::vector<Interval>> flow(order, std::vector<Interval>(order));
  std::vector<std::vector<Interval>> adjugate(order, std::vector<Interval>(order, Interval(0.0)));
  for (std::size_t i = 0; i < order; ++i) {
    for (std::size_t j = 0; j < order; ++j) flow[i][j] = datum(controller.state_matrix[i][j]);
    adjugate[i][i] = 1.0;
  }
  ControllerPolynomials result{Polynomial(order + 1, Interval(0.0)),
                               Polynomial(order + 1, Interval(0.0)),
                               Polynomial(order + 1, Interval(0.0))};
  result.denominator[order] = 1.0;
  const auto through = [&](std::size_t input) {
    Interval sum = 0.0;
    for (std::size_t i = 0; i < order; ++i) {
      for (std::size_t j = 0; j < order; ++j) {
        sum = sum + datum(controller.output[i]) * adjugate[i][j] *
                        datum(controller.input_matrix[j][input]);
      }
    }
    return sum;
  };
  for (std::size_t k = 1; k <= order; ++k) {
    result.position[order - k] = -through(1);
    result.speed[order - k] = -through(2);
    adjugate = times(flow, adjugate);
    Interval trace = 0.0;
    for (std::size_t i = 0; i < order; ++i) trace = trace + adjugate[i][i];
    const Interval coefficient = -(trace / Interval(static_cast<double>(k)));
    result.denominator[order - k] = coefficient;
    for (std::size_t i = 0; i < order; ++i) adjugate[i][i] = adjugate[i][i] + coefficient;
  }
  const Polynomial direct_position{-datum(controller.direct[1])};
  const Polynomial direct_speed{-datum(controller.direct[2])};
  result.position = sum(result.position, product(direct_position, result.denominator));
  result.speed = sum(result.speed, product(direct_speed, result.denominator));
  return result;
}

Polynomial conjugate(Polynomial polynomial) {
  for (std::size_t i = 1; i < polynomial.size(); i += 2) polynomial[i] = -polynomial[i];
  return polynomial;
}

/// Whether Re(a/b) > 0 on the imaginary axis but at 0.
bool has_positive_real_part(const Polynomial& a, const Polynomial& b) {
  return is_positive(real_part(product(a, conjugate(b))));
}

/// Whether all roots have negative real parts, by the companion matrix.
bool is_stable(const Polynomial& polynomial) {
  const std::size_t order = polynomial.size() - 1;
  if (order == 0) return true;
  IntervalMatrix companion(order);
  for (std::size_t i = 0; i + 1 < order; ++i) companion.rows[i][i + 1] = 1.0;
  for (std::size_t i = 0; i < order; ++i) {
    companion.rows[order - 1][i] = -(polynomial[i] / polynomial[order]);
  }
  return DecayingMotion::of(companion, TimeKind::continuous).has_value();
}

bool is_at_rest_for_ever(const drive::Signal& signal) {
  return std::holds_alternative<double>(signal);
}

}  // namespace

bool is_absent_by_energy(const ReducedDrive& drive) {
  constexpr std::size_t highest_order = 12;
  const LinearController controller = drive::linear_controller(drive.controller);
  if (drive.sampling || drive.sensing.resolution > 0.0 || std::isfinite(drive.torque_limit) ||
      !is_at_rest_for_ever(drive.reference) || !is_at_rest_for_ever(drive.load_torque) ||
      controller.order() > highest_order) {
    return false;
  }
  const ControllerPolynomials requested = polynomials_of(controller);
  ControllerPolynomials loop = requested;
  const drive::Winding& winding = drive.winding;
  const bool lags = winding.time_constant > 0.0;
  if (lags) loop.denominator = product({1.0, datum(winding.time_constant)}, loop.denominator);
  const Interval of_position = drive.sensing.load_share_of_position;
  const Interval of_speed = drive.sensing.load_share_of_speed;
  const Polynomial s{0.0, 1.0};
  const auto shaft = [](const drive::Shaft& one) {
    return Polynomial{datum(one.friction.viscous), datum(one.inertia)};
  };
  const auto scaled = [](const Interval& factor, const Polynomial& polynomial) {
    return product({factor}, polynomial);
  };
  // Times s and the controller's denominator.
  const Polynomial position_and_speed = sum(loop.position, product(s, loop.speed));
  const Polynomial electrical = scaled(datum(winding.back_emf), product(s, requested.denominator));
  Polynomial motor = sum(product(product(s, shaft(drive.motor)), loop.denominator),
                         sum(scaled(1.0 - of_position, loop.position),
                             scaled(1.0 - of_speed, product(s, loop.speed))));
  if (lags) motor = sum(motor, electrical);
  const Interval weight = datum(drive.gravity.stiffness);
  const bool is_weighed = drive.gravity.stiffness != 0.0;
  Polynomial load = product(s, shaft(drive.load));
  if (is_weighed) load = sum(load, {weight});
  const Polynomial closed = sum(
      motor, sum(product(load, loop.denominator), sum(scaled(of_position, loop.position),
                                                      scaled(of_speed, product(s, loop.speed)))));
  if (!is_stable(closed)) return false;
  // The mesh torque over the gap's speed has a pole at 0, whose residue must not be negative.
  const Interval residue = weight * (1.0 - of_position) * loop.position[0];
  if (is_weighed && residue.low < 0.0) return false;
  const bool is_dry = drive.motor.friction.is_dry() || drive.load.friction.is_dry();
  if (!is_dry) {  // Re of the mesh torque over the gap's speed, load·motor/(s·closed)
    return is_weighed ? has_positive_real_part(product(load, motor), product(s, closed))
                      : has_positive_real_part(product(shaft(drive.load), motor), closed);
  }
  // Ports of motor and load are apart only where nothing is measured on the load.
  const bool measures_load =
      drive.sensing.load_share_of_position != 0.0 || drive.sensing.load_share_of_speed != 0.0;
  return !measures_load && drive.load.friction.viscous > 0.0 && drive.gravity.stiffness >= 0.0 &&
         has_positive_real_part(motor, product(s, loop.denominator));
}

}  // namespace gearlash
