#include "hybrid/fast_decays.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "hybrid/linear_flow.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

/// Least ratio of the fast rates to the remaining ones at which splitting pays.
constexpr double least_gap = 8.0;

using ComplexMatrix = Eigen::MatrixXcd;
using Spectrum = Eigen::VectorXcd;

/// Numbers of the largest eigenvalues that all decay and have a wide gap, by ratio, to the next,
/// rising. Eigenvalues that rounding alone keeps from 0 do not decay, and count as large as that
/// rounding: a decay next to them is not fast because they are 0. The largest are first.
std::vector<Eigen::Index> counts_of_fast(const Spectrum& values) {
  std::vector<Eigen::Index> counts;
  constexpr double rounding = 1e-10;
  const double least = values.size() == 0 ? 0.0 : rounding * std::abs(values[0]);
  for (Eigen::Index i = 0; i + 1 < values.size(); ++i) {
    constexpr double least_damping = 1e-3;
    const std::complex<double> here = values[i];
    if (!(-here.real() > least_damping * std::abs(here) && std::abs(here) > least)) break;
    const double gap = std::abs(here) / std::max(std::abs(values[i + 1]), least);
    if (gap > least_gap) counts.push_back(i + 1);
  }
  return counts;
}

/// Some eigenvectors, by r = A r/λ once more: errors along slow decays shrink so, numbers that move
/// alike, as shafts whose faces stay together, become equal to the last bit, and those that no
/// decay has a part in become 0. `done` projects on the faster decays, along which errors would
/// grow.
ComplexMatrix refined(const Matrix& matrix, const ComplexMatrix& vectors, const Spectrum& values,
                      const Matrix& done) {
  const Spectrum times = values.cwiseInverse();
  ComplexMatrix result = vectors;
  constexpr int rounds = 4;  // a speed follows from others, a position from a speed, and so on
  for (int round = 0; round < rounds; ++round) {
    result = (matrix * result * times.asDiagonal()).eval();
    result -= (done * result).eval();
  }
  return result;
}

/// Without what rounding alone keeps from 0. A flow in which a number acts on another so little,
/// and that one on it, has no weights in which both count alike.
Matrix without_rounding(const Matrix& matrix) {
  return (matrix.cwiseAbs().array() <= left_out * matrix.norm()).select(0.0, matrix);
}

}  // namespace

bool FastDecays::are_over(const Vector& state, const Vector& largest) const {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  const Vector off = (projector * state - rest).cwiseAbs();
  constexpr double beside = 1.0;  // roundings of the largest number
  const double alike = largest.cwiseQuotient(weights).maxCoeff();
  const Vector held = (reach * largest + least_reach).cwiseMin(beside * alike * weights);
  const Vector size = (projector.cwiseAbs() * largest + rest.cwiseAbs()).cwiseMax(held);
  return (off.array() <= rounding * size.array()).all();
}

void FastDecays::put_at_rest(Vector& state) const {
  thread_local Vector fast;
  fast.noalias() = projector * state;
  state -= fast - rest;
}

namespace {

/// The flow without the decays that P projects on, the slowest of which has this rate. Empty if
/// they are not separated well enough. `spread` is Σ |rₖ| |lₖᵀ| over right and left eigenvectors.
std::optional<FastDecays> without(const AffineFlow& flow, const Matrix& projector,
                                  const Matrix& spread, double slowest) {
  const Matrix& matrix = flow.matrix;
  // Nearly parallel eigenvectors make the projector too inaccurate to use.
  constexpr double acceptable = 1e-11;
  const double size = 1.0 + projector.norm();
  const Matrix commuted = matrix * projector - projector * matrix;
  // A stiff contact multiplies what is not rest by its stiffness.
  constexpr double to_rounding = 16.0 * std::numeric_limits<double>::epsilon();
  const bool is_projector = (projector * projector - projector).norm() <= to_rounding * size;
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
  const Matrix inaccuracy = misfit + commuted.cwiseAbs() / slowest;  // of P
  const Matrix reach = spread * sizes / slowest + safety / rounding * inaccuracy;
  const Vector least_reach = spread * flow.offset.cwiseAbs() / slowest;
  return FastDecays{projector,
                    rest,
                    reach,
                    least_reach,
                    Vector::Ones(flow.offset.size()),
                    {slow, flow.offset - projector * flow.offset}};
}

/// Powers of 2 that make the terms of a flow alike. Eigenvectors are known to rounding of their
/// largest number, and an integral may be a million times a position.
Vector balance(const AffineFlow& flow) {
  const LinearFlow moving(flow);
  Vector weights = Vector::Ones(flow.offset.size());
  for (int i = 0; i < moving.count(); ++i) weights[moving.number(i)] = moving.weight(i);
  return weights;
}

/// D⁻¹ A D
Matrix scaled(const Matrix& matrix, const Vector& weights) {
  return weights.cwiseInverse().asDiagonal() * matrix * weights.asDiagonal();
}

}  // namespace

/// P = V (WᵀV)⁻¹ Wᵀ of right and left eigenvectors V, W, added up group by group.
std::vector<FastDecays> fast_decays(const AffineFlow& flow) {
  const Vector weights = balance(flow);
  const Vector inverse = weights.cwiseInverse();
  const AffineFlow balanced{scaled(flow.matrix, weights), inverse.cwiseProduct(flow.offset)};
  const Matrix& matrix = balanced.matrix;
  const Eigensystem right = sorted_eigensystem(matrix);
  const Eigensystem left = sorted_eigensystem(matrix.transpose());
  Matrix projector = Matrix::Zero(matrix.rows(), matrix.cols());
  Matrix spread = projector;
  std::vector<FastDecays> all;
  Eigen::Index done = 0;
  for (const Eigen::Index count : counts_of_fast(right.values)) {
    const auto group = Eigen::seq(done, count - 1);
    done = count;
    const ComplexMatrix v =
        refined(matrix, right.vectors(Eigen::all, group), right.values(group), projector);
    const ComplexMatrix w = refined(matrix.transpose(), left.vectors(Eigen::all, group),
                                    left.values(group), projector.transpose());
    const ComplexMatrix overlap = w.transpose() * v;
    const ComplexMatrix shares = solved(overlap, ComplexMatrix(w.transpose()));
    const Matrix part = (v * shares).real();
    const Matrix sizes = v.cwiseAbs() * shares.cwiseAbs();
    constexpr double parallel = 100.0;  // nearly parallel eigenvectors have shares that cancel
    spread += sizes.norm() < parallel * part.norm() ? sizes : part.cwiseAbs();
    projector += without_rounding(part);
    auto fast = without(balanced, projector, spread, std::abs(right.values[count - 1]));
    if (!fast) continue;
    fast->projector = scaled(fast->projector, inverse);
    fast->rest = weights.cwiseProduct(fast->rest);
    fast->reach = scaled(fast->reach, inverse);
    fast->least_reach = weights.cwiseProduct(fast->least_reach);
    fast->weights = weights;
    fast->slow = {scaled(fast->slow.matrix, inverse), weights.cwiseProduct(fast->slow.offset)};
    all.push_back(std::move(*fast));
  }
  return all;
}

}  // namespace gearlash::hybrid
