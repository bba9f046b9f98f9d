#include "hybrid/fast_decays.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <vector>

#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

/// Least ratio of the fast rates to the remaining ones at which splitting pays.
constexpr double least_gap = 8.0;

using ComplexMatrix = Eigen::MatrixXcd;
using Spectrum = Eigen::VectorXcd;

std::vector<Eigen::Index> by_size(const Spectrum& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(values[a]) > std::abs(values[b]);
  });
  return order;
}

/// Number of the largest eigenvalues that all decay and have the widest gap, by ratio, to the next.
/// 0 if no gap is wide enough. Eigenvalues that rounding alone keeps from 0 do not decay.
std::size_t count_of_fast(const Spectrum& values, const std::vector<Eigen::Index>& order) {
  std::size_t count = 0;
  double widest = least_gap;
  constexpr double rounding = 1e-10;
  const double least = order.empty() ? 0.0 : rounding * std::abs(values[order.front()]);
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    constexpr double least_damping = 1e-3;
    const std::complex<double> here = values[order[i]];
    if (!(-here.real() > least_damping * std::abs(here) && std::abs(here) > least)) break;
    const double gap = std::abs(here) / std::abs(values[order[i + 1]]);
    if (gap > widest) {
      widest = gap;
      count = i + 1;
    }
  }
  return count;
}

/// The eigenvectors that belong to the `count` largest eigenvalues.
ComplexMatrix fast_vectors(const Matrix& matrix, std::size_t count) {
  const Eigensystem system = eigensystem(matrix);
  const std::vector<Eigen::Index> order = by_size(system.values);
  ComplexMatrix vectors(matrix.rows(), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    vectors.col(static_cast<Eigen::Index>(i)) = system.vectors.col(order[i]);
  }
  return vectors;
}

/// Numbers that change by constants and by each other's integrals alone, as those of a shaft that
/// sticks: no decay has a part in them.
std::vector<Eigen::Index> without_decays(const Matrix& matrix) {
  std::vector<Eigen::Index> found;
  std::vector<bool> is_found(static_cast<std::size_t>(matrix.rows()), false);
  const auto follows_found = [&](Eigen::Index row) {
    for (Eigen::Index i = 0; i < matrix.cols(); ++i) {
      if (matrix(row, i) != 0.0 && !is_found[static_cast<std::size_t>(i)]) return false;
    }
    return true;
  };
  std::size_t before = 0;
  do {
    before = found.size();
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      if (is_found[static_cast<std::size_t>(row)] || !follows_found(row)) continue;
      is_found[static_cast<std::size_t>(row)] = true;
      found.push_back(row);
    }
  } while (found.size() > before);
  return found;
}

}  // namespace

bool FastDecays::are_over(const Vector& state, const Vector& largest) const {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  const Vector off = (projector * state - rest).cwiseAbs();
  const Vector size = spread * largest + rest.cwiseAbs();
  return (off.array() <= rounding * size.array()).all();
}

void FastDecays::put_at_rest(Vector& state) const {
  thread_local Vector fast;
  fast.noalias() = projector * state;
  state -= fast - rest;
}

/// P = V (WᵀV)⁻¹ Wᵀ of the right and left eigenvectors V, W of the fast decays.
std::optional<FastDecays> fast_decays(const AffineFlow& flow) {
  const Matrix& matrix = flow.matrix;
  const Spectrum values = eigenvalues(matrix);
  const std::size_t count = count_of_fast(values, by_size(values));
  if (count == 0) return std::nullopt;
  const ComplexMatrix right = fast_vectors(matrix, count);
  const ComplexMatrix left = fast_vectors(matrix.transpose(), count);
  const ComplexMatrix overlap = left.transpose() * right;
  const ComplexMatrix shares = solved(overlap, ComplexMatrix(left.transpose()));
  Matrix projector = (right * shares).real();
  Matrix spread = right.cwiseAbs() * shares.cwiseAbs();
  constexpr double parallel = 100.0;  // nearly parallel eigenvectors have shares that cancel
  if (!(spread.norm() < parallel * projector.norm())) spread = projector.cwiseAbs();
  // Rounding would move a shaft that sticks, a little at each step.
  for (const Eigen::Index row : without_decays(matrix)) projector.row(row).setZero();
  // Nearly parallel eigenvectors make the projector too inaccurate to use.
  constexpr double acceptable = 1e-11;
  const double size = 1.0 + projector.norm();
  const Matrix commuted = matrix * projector - projector * matrix;
  const bool is_projector = (projector * projector - projector).norm() <= acceptable * size;
  const bool is_invariant = commuted.norm() <= acceptable * size * matrix.norm();
  constexpr double largest = 1e12;  // of a projector that separates more than rounding
  if (!(size < largest) || !is_projector || !is_invariant) return std::nullopt;
  // A P z = −P b, z = P z: A with the slow part replaced by the identity can be inverted.
  const Matrix identity = Matrix::Identity(matrix.rows(), matrix.cols());
  const Matrix invertible = matrix * projector + (identity - projector);
  const Vector rest = -(projector * solved(invertible, Vector(projector * flow.offset)));
  Matrix slow = matrix - matrix * projector;
  // Entries left by rounding alone would couple unrelated numbers and distort their weights.
  // Eigenvectors, and so the projector, are less accurate than rounding of these sums. The misfits
  // P² − P and A P − P A measure by how much.
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  constexpr double safety = 8.0;
  const Matrix sizes = matrix.cwiseAbs();
  const Matrix misfit = (projector * projector - projector).cwiseAbs();
  const Matrix unknown = rounding * (sizes * (identity + projector.cwiseAbs())) +
                         safety * (sizes * misfit + commuted.cwiseAbs());
  slow = (slow.array().abs() <= unknown.array()).select(0.0, slow);
  return FastDecays{projector, spread, rest, {slow, flow.offset - projector * flow.offset}};
}

}  // namespace gearlash::hybrid
