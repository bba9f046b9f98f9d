#include "analysis/energy/loop_polynomials.hpp"

#include "base/datum.hpp"
#include "numeric/decaying_motion.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;
using Polynomial = IntervalPolynomial;

/// τ = (at_reference r − position y − speed v)/denominator; of s. The position is r + y.
struct ControllerPolynomials {
  Polynomial denominator;
  Polynomial position;
  Polynomial speed;
  Polynomial at_reference;
};

/// What a row of the controller receives of a reference and of a position at it.
Interval of_both(const std::vector<double>& row) {
  return row[0] == -row[1] ? Interval(0.0) : datum(row[0]) + datum(row[1]);
}

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
  const Polynomial zeros(order + 1, Interval(0.0));
  ControllerPolynomials result{zeros, zeros, zeros, zeros};
  result.denominator[order] = 1.0;
  const auto through = [&](const auto& input) {
    Interval sum = 0.0;
    for (std::size_t i = 0; i < order; ++i) {
      for (std::size_t j = 0; j < order; ++j) {
        sum =
            sum + datum(controller.output[i]) * adjugate[i][j] * input(controller.input_matrix[j]);
      }
    }
    return sum;
  };
  const auto column = [](std::size_t input) {
    return [input](const std::vector<double>& row) { return datum(row[input]); };
  };
  for (std::size_t k = 1; k <= order; ++k) {
    result.position[order - k] = -through(column(1));
    result.speed[order - k] = -through(column(2));
    result.at_reference[order - k] = through(of_both);
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
  result.at_reference =
      sum(result.at_reference, product({of_both(controller.direct)}, result.denominator));
  return result;
}

}  // namespace

Polynomial conjugate(Polynomial polynomial) {
  for (std::size_t i = 1; i < polynomial.size(); i += 2) polynomial[i] = -polynomial[i];
  return polynomial;
}

Polynomial momentum_and_friction(const drive::Shaft& shaft) {
  return {datum(shaft.friction.viscous), datum(shaft.inertia)};
}

/// By the companion matrix.
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

LoopPolynomials loop_polynomials(const ReducedDrive& drive) {
  const ControllerPolynomials requested =
      polynomials_of(drive::linear_controller(drive.controller));
  LoopPolynomials loop{.denominator = requested.denominator,
                       .position = requested.position,
                       .speed = requested.speed,
                       .at_reference = requested.at_reference,
                       .motor = {},
                       .load = {},
                       .closed = {}};
  const drive::Winding& winding = drive.winding;
  const bool lags = winding.time_constant > 0.0;
  if (lags) loop.denominator = product({1.0, datum(winding.time_constant)}, loop.denominator);
  const Interval of_position = drive.sensing.load_share_of_position;
  const Interval of_speed = drive.sensing.load_share_of_speed;
  const Polynomial s{0.0, 1.0};
  const auto scaled = [](const Interval& factor, const Polynomial& polynomial) {
    return product({factor}, polynomial);
  };
  const Polynomial electrical = scaled(datum(winding.back_emf), product(s, requested.denominator));
  loop.motor = sum(product(product(s, momentum_and_friction(drive.motor)), loop.denominator),
                   sum(scaled(1.0 - of_position, loop.position),
                       scaled(1.0 - of_speed, product(s, loop.speed))));
  if (lags) loop.motor = sum(loop.motor, electrical);
  loop.load = product(s, momentum_and_friction(drive.load));
  if (drive.gravity.stiffness != 0.0) {
    loop.load = sum(loop.load, {datum(drive.gravity.stiffness)});
  }
  loop.closed =
      sum(loop.motor,
          sum(product(loop.load, loop.denominator),
              sum(scaled(of_position, loop.position), scaled(of_speed, product(s, loop.speed)))));
  return loop;
}

}  // namespace gearlash
