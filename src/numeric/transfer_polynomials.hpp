// The transfer functions of a linear system as polynomials, for any kind of number.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "numeric/vector_algebra.hpp"

namespace gearlash {

/// x′ = state_matrix x + Σ input_columns[i] uᵢ, y = output x + Σ direct[i] uᵢ.
template <class Number>
struct LinearEquations {
  std::vector<std::vector<Number>> state_matrix;   ///< n rows of n
  std::vector<std::vector<Number>> input_columns;  ///< one of n for each input
  std::vector<Number> output;                      ///< n
  std::vector<Number> direct;                      ///< one for each input
};

/// y = Σ numerators[i](s)/denominator(s) uᵢ, by ascending powers. No common factors are taken out.
template <class Number>
struct TransferPolynomials {
  std::vector<Number> denominator;              ///< n + 1 coefficients, the last is 1
  std::vector<std::vector<Number>> numerators;  ///< likewise
};

/// (s − A)⁻¹ = Σ M_k sⁿ⁻ᵏ/Σ c_k sⁿ⁻ᵏ with M_1 = 1, c_k = −tr(A M_k)/k, M_{k+1} = A M_k + c_k
/// (Faddeev and Leverrier): exact for rationals, enclosed for intervals.
template <class Number>
TransferPolynomials<Number> transfer_polynomials(const LinearEquations<Number>& system) {
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
      Row column;
      for (const Row& row : adjugate) column.push_back(dot(row, system.input_columns[input]));
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
