// Matrices of any numbers, intervals among them, and their inverse.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "base/number.hpp"

namespace Eigen {

template <>
struct NumTraits<gearlash::Interval> : GenericNumTraits<gearlash::Interval> {
  enum { RequireInitialization = 1, ReadCost = 2, AddCost = 8, MulCost = 16 };
};

}  // namespace Eigen

namespace gearlash {

template <class Number>
using MatrixOf = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
template <class Number>
using VectorOf = Eigen::Matrix<Number, Eigen::Dynamic, 1>;

template <class Number>
MatrixOf<Number> matrix_of(const std::vector<std::vector<Number>>& rows, std::size_t columns) {
  MatrixOf<Number> matrix(static_cast<Eigen::Index>(rows.size()),
                          static_cast<Eigen::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
    }
  }
  return matrix;
}

template <class Number>
VectorOf<Number> vector_of(const std::vector<Number>& numbers) {
  return Eigen::Map<const VectorOf<Number>>(numbers.data(),
                                            static_cast<Eigen::Index>(numbers.size()));
}

template <class Number>
std::vector<Number> entries_of(const VectorOf<Number>& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

template <class Number>
std::vector<std::vector<Number>> rows_of(const MatrixOf<Number>& matrix) {
  std::vector<std::vector<Number>> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back(entries_of<Number>(matrix.row(i).transpose()));
  }
  return rows;
}

/// left · right. Products of intervals with an exact 0 are left out: sums with them would be
/// widened.
template <class Left, class Right>
auto product(const Eigen::MatrixBase<Left>& left, const Eigen::MatrixBase<Right>& right) {
  using Number = decltype(typename Left::Scalar() * typename Right::Scalar());
  using Product = Eigen::Matrix<Number, Eigen::Dynamic, Right::ColsAtCompileTime>;
  if constexpr (std::is_same_v<Number, double>) {
    return Product(left * right);
  } else {
    Product result(left.rows(), right.cols());
    for (Eigen::Index i = 0; i < left.rows(); ++i) {
      for (Eigen::Index j = 0; j < right.cols(); ++j) {
        Number sum = 0.0;
        for (Eigen::Index k = 0; k < left.cols(); ++k) {
          const Number term = left.coeff(i, k) * right.coeff(k, j);
          if (!is_exactly(term, 0.0)) sum = is_exactly(sum, 0.0) ? term : Number(sum + term);
        }
        result(i, j) = sum;
      }
    }
    return result;
  }
}

template <class Number>
std::vector<Number> times(const MatrixOf<Number>& matrix, const std::vector<Number>& column) {
  return entries_of<Number>(product(matrix, vector_of(column)));
}
template <class Number>
std::vector<Number> times(const std::vector<Number>& row, const MatrixOf<Number>& matrix) {
  return entries_of<Number>(product(matrix.transpose(), vector_of(row)));
}

/// By Gauss and Jordan with partial pivoting. Of intervals it contains the inverse of every matrix
/// within; the whole line where a pivot may be 0.
template <class Number>
MatrixOf<Number> inverse_by_elimination(MatrixOf<Number> matrix) {
  const Eigen::Index size = matrix.rows();
  MatrixOf<Number> inverse = MatrixOf<Number>::Identity(size, size);
  const auto subtract = [&](MatrixOf<Number>& from, Eigen::Index row, const Number& factor,
                            Eigen::Index of) {
    for (Eigen::Index j = 0; j < size; ++j) {
      if (is_exactly(from(of, j), 0.0)) continue;
      from(row, j) = from(row, j) - factor * from(of, j);
    }
  };
  for (Eigen::Index k = 0; k < size; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < size; ++i) {
      if (std::abs(approximate(matrix(i, k))) > std::abs(approximate(matrix(pivot, k)))) pivot = i;
    }
    matrix.row(k).swap(matrix.row(pivot));
    inverse.row(k).swap(inverse.row(pivot));
    for (Eigen::Index i = 0; i < size; ++i) {
      if (i == k || is_exactly(matrix(i, k), 0.0)) continue;
      const Number factor = matrix(i, k) / matrix(k, k);
      subtract(matrix, i, factor, k);
      subtract(inverse, i, factor, k);
      matrix(i, k) = Number(0.0);
    }
  }
  for (Eigen::Index k = 0; k < size; ++k) {
    for (Eigen::Index j = 0; j < size; ++j) inverse(k, j) = inverse(k, j) / matrix(k, k);
  }
  return inverse;
}

}  // namespace gearlash
