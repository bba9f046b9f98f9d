// The transfer functions of a linear system as polynomials, for any kind of number.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "base/lists.hpp"
#include "numeric/vector_algebra.hpp"

namespace gearlash {

/// Of x′ = A x + B u, y = C x + D u: y = Σ numerators[i](s)/denominator(s) uᵢ, by ascending powers.
/// No common factors are taken out.
template <class Number>
struct TransferPolynomials {
  std::vector<Number> denominator;              ///< n + 1 coefficients, the last is 1
  std::vector<std::vector<Number>> numerators;  ///< likewise
};

/// (s − A)⁻¹ = Σ M_k sⁿ⁻ᵏ/Σ c_k sⁿ⁻ᵏ with M_1 = 1, c_k = −tr(A M_k)/k, M_{k+1} = A M_k + c_k
/// (Faddeev and Leverrier): exact for rationals, enclosed for intervals. The system has rows
/// state_matrix and input_matrix, A and B, and the rows output and direct, C and D.
template <class System>
auto transfer_polynomials(const System& system) {
  using Number = typename decltype(System::output)::value_type;
  using Row = std::vector<Number>;
  const std::size_t order = system.output.size();
  const std::size_t inputs = system.direct.size();
  TransferPolynomials<Number> result{Row(order + 1, Number(0.0)), {}};
  result.denominator[order] = Number(1.0);
  result.numerators.assign(inputs, Row(order + 1, Number(0.0)));
  std::vector<Row> adjugate(order, Row(order, Number(0.0)));
  for (std::size_t i = 0; i < order; ++i) adjugate[i][i] = Number(1.0);
  const auto moved = [&](const std::vector<Row>& matrix) {
    std::vector<Row> product(order, Row(order, Number(0.0)));
    for (std::size_t i = 0; i < order; ++i) {
      for (std::size_t k = 0; k < order; ++k) {
        product[i] = added(std::move(product[i]), scaled(system.state_matrix[i][k], matrix[k]));
      }
    }
    return product;
  };
  for (std::size_t k = 1; k <= order; ++k) {
    for (std::size_t input = 0; input < inputs; ++input) {
      const Row of_input = of_each(system.input_matrix, [&](const Row& row) { return row[input]; });
      const Row column = of_each(adjugate, [&](const Row& row) { return dot(row, of_input); });
      result.numerators[input][order - k] = dot(system.output, column);
    }
    adjugate = moved(adjugate);
    Number trace(0.0);
    for (std::size_t i = 0; i < order; ++i) trace = trace + adjugate[i][i];
    const Number coefficient = -(trace / Number(static_cast<double>(k)));
    result.denominator[order - k] = coefficient;
    for (std::size_t i = 0; i < order; ++i) adjugate[i][i] = adjugate[i][i] + coefficient;
  }
  for (std::size_t input = 0; input < inputs; ++input) {
    result.numerators[input] = added(std::move(result.numerators[input]),
                                     scaled(system.direct[input], result.denominator));
  }
  return result;
}

}  // namespace gearlash
