#include "numeric/decaying_motion.hpp"

#include <cmath>
#include <complex>

#include "numeric/linear_algebra.hpp"

namespace gearlash {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

// ---- the change of coordinates: floating point, proved afterwards -------------------------------

struct Subspaces {
  Matrix basis;
  std::vector<Index> sizes;
};

/// The last eigenvectors, real and imaginary parts of a conjugate pair.
Matrix slow_vectors(const Eigensystem& system, Index count) {
  Matrix result(system.vectors.rows(), count);
  for (Index i = 0; i < count; ++i) {
    const Index k = system.values.size() - count + i;
    const auto vector = system.vectors.col(k);
    if (system.values[k].imag() >= 0.0) {
      result.col(i) = vector.real();
    } else {
      result.col(i) = vector.imag();
    }
  }
  return result;
}

/// Invariant subspaces by time scale, the fastest first: eigenvalues whose moduli differ by more
/// than `apart` are in different ones. The fastest, which may have equal eigenvalues with one
/// eigenvector (delays), is the complement of the others' left eigenvectors. `system`: sorted.
Subspaces by_time_scale(const Matrix& flow, const Eigensystem& system) {
  constexpr double apart = 4.0;
  const Index size = flow.rows();
  Subspaces result{Matrix(size, size), {}};
  Index first = 0;
  for (Index i = 1; i <= size; ++i) {
    if (i < size && std::abs(system.values[i - 1]) <= apart * std::abs(system.values[i])) {
      continue;
    }
    result.sizes.push_back(i - first);
    first = i;
  }
  const Index slow = size - result.sizes.front();
  if (slow == 0) {
    result.basis = Matrix::Identity(size, size);
    return result;
  }
  const Eigensystem left = sorted_eigensystem(flow.transpose());
  result.basis.leftCols(size - slow) = complement(slow_vectors(left, slow));
  result.basis.rightCols(slow) = slow_vectors(system, slow);
  first = size - slow;
  for (std::size_t k = 1; k < result.sizes.size(); first += result.sizes[k++]) {
    result.basis.middleCols(first, result.sizes[k]) =
        orthonormal_basis(result.basis.middleCols(first, result.sizes[k]));
  }
  return result;
}

/// X with slow X − X fast = −coupling, by iteration: each step gains the ratio of the time scales.
Matrix decoupling(const Matrix& slow, const Matrix& fast, const Matrix& coupling) {
  constexpr int steps = 30;
  const Matrix inverse_of_fast = inverse(fast);
  Matrix result = coupling * inverse_of_fast;
  for (int i = 0; i < steps; ++i) result = (slow * result + coupling) * inverse_of_fast;
  return result;
}

/// Corrects subspaces that are invariant only to the accuracy of the eigenvectors.
void refine(const Matrix& flow, Subspaces& subspaces) {
  const Matrix seen = inverse(subspaces.basis) * flow * subspaces.basis;
  Matrix correction = Matrix::Identity(flow.rows(), flow.rows());
  Index fast = 0;
  for (std::size_t i = 0; i < subspaces.sizes.size(); fast += subspaces.sizes[i++]) {
    const Index n = subspaces.sizes[i];
    Index slow = fast + n;
    for (std::size_t j = i + 1; j < subspaces.sizes.size(); slow += subspaces.sizes[j++]) {
      const Index m = subspaces.sizes[j];
      const Matrix fast_flow = seen.block(fast, fast, n, n);
      const Matrix slow_flow = seen.block(slow, slow, m, m);
      correction.block(slow, fast, m, n) =
          decoupling(slow_flow, fast_flow, seen.block(slow, fast, m, n));
      correction.block(fast, slow, n, m) = -decoupling(slow_flow.transpose(), fast_flow.transpose(),
                                                       seen.block(fast, slow, n, m).transpose())
                                                .transpose();
    }
  }
  subspaces.basis *= correction;
}

/// P with flowᵀP + P flow = −1, by the matrix sign function (Roberts 1980).
Matrix lyapunov_function(const Matrix& flow) {
  constexpr int steps = 60;
  const Index size = flow.rows();
  Matrix sign = flow;
  Matrix sum = Matrix::Identity(size, size);
  for (int i = 0; i < steps; ++i) {
    const Matrix inverted = inverse(sign);
    const double scale = std::sqrt(inverted.norm() / sign.norm());
    const Matrix next = 0.5 * (scale * sign + inverted / scale);
    sum = 0.5 * (scale * sum + inverted.transpose() * sum * inverted / scale);
    const double change = (next - sign).norm();
    sign = next;
    if (!(change > 1e-13 * next.norm())) break;
  }
  return 0.5 * sum;
}

/// P with P − mapᵀP map = 1, by doubling (Smith 1968).
Matrix stein_function(Matrix map) {
  constexpr int steps = 60;
  Matrix sum = Matrix::Identity(map.rows(), map.cols());
  for (int i = 0; i < steps; ++i) {
    const Matrix more = map.transpose() * sum * map;
    sum += more;
    if (!(more.norm() > 1e-16 * sum.norm())) break;
    map = map * map;
  }
  return sum;
}

/// Coordinates in which the motion contracts at half of its slowest rate, or nearly: U of the
/// Lyapunov function UᵀU. Empty if there are none.
Matrix contracting_coordinates(const Matrix& flow, TimeKind kind) {
  const Matrix one = Matrix::Identity(flow.rows(), flow.cols());
  const Eigen::VectorXcd values = eigenvalues(flow);
  if (kind == TimeKind::continuous) {
    const double slowest = -values.real().maxCoeff();
    return cholesky_factor(lyapunov_function(flow + 0.5 * slowest * one));
  }
  const double largest = (values.array() + 1.0).abs().maxCoeff();
  return cholesky_factor(stein_function((one + flow) / (0.5 * (1.0 + largest))));
}

bool decays(const Eigen::VectorXcd& values, TimeKind kind) {
  return kind == TimeKind::continuous ? values.real().maxCoeff() < 0.0
                                      : (values.array() + 1.0).abs().maxCoeff() < 1.0;
}

// ---- proofs -------------------------------------------------------------------------------------

/// Whether a symmetric matrix is positive definite, by Cholesky's decomposition.
bool is_positive_definite(IntervalMatrix matrix) {
  const Index size = matrix.rows();
  for (Index k = 0; k < size; ++k) {
    const Interval pivot = matrix(k, k);
    if (!(pivot.low > 0.0)) return false;
    for (Index i = k + 1; i < size; ++i) {
      const Interval factor = matrix(i, k) / pivot;
      for (Index j = k + 1; j < size; ++j) matrix(i, j) = matrix(i, j) - factor * matrix(k, j);
    }
  }
  return true;
}

/// −(A + Aᵀ)/2 of a flow; −(A + Aᵀ) − AᵀA = 1 − (1 + A)ᵀ(1 + A) of a step.
IntervalMatrix contraction(const IntervalMatrix& flow, TimeKind kind) {
  const IntervalMatrix sum = flow + flow.transpose();
  if (kind == TimeKind::continuous) return Interval(-0.5) * sum;
  return -sum - product(flow.transpose(), flow);
}

/// A rate with ‖e^{flow t}‖ ≤ e^{−rate t}, or ‖1 + flow‖ ≤ 1 − rate; 0 if none is proved.
double contraction_rate(const Matrix& flow, TimeKind kind) {
  const IntervalMatrix exact = contraction(flow.cast<Interval>(), kind);
  const double least = eigenvalues(middle(exact)).real().minCoeff();
  for (const double share : {1.0 - 1e-9, 0.999, 0.5}) {
    const double proved = share * least;
    if (!(proved > 0.0)) return 0.0;
    const IntervalMatrix one = IntervalMatrix::Identity(flow.rows(), flow.cols());
    if (!is_positive_definite(exact - Interval(proved) * one)) continue;
    // (1 − rate)² ≥ 1 − proved
    return kind == TimeKind::continuous ? proved : (0.5 * Interval(proved)).low;
  }
  return 0.0;
}

template <class Entries>
double norm(const Entries& entries) {
  Interval sum = 0.0;
  for (Index i = 0; i < entries.rows(); ++i) {
    for (Index j = 0; j < entries.cols(); ++j) sum = sum + square(Interval(entries(i, j)));
  }
  return sqrt(sum).high;
}

}  // namespace

std::optional<DecayingMotion> DecayingMotion::of(const IntervalMatrix& flow, TimeKind kind) {
  DecayingMotion result(kind);
  if (!result.choose_basis(middle(flow)) || !result.prove(flow)) return std::nullopt;
  return result;
}

bool DecayingMotion::choose_basis(const Matrix& flow) {
  if (!flow.allFinite()) return false;
  const Vector scale = balancing_scales(flow);
  const Matrix balanced = scale.cwiseInverse().asDiagonal() * flow * scale.asDiagonal();
  const Eigensystem system = sorted_eigensystem(balanced);
  if (!decays(system.values, kind_)) return false;
  Subspaces subspaces = by_time_scale(balanced, system);
  if (subspaces.sizes.size() > 1) {
    for (int i = 0; i < 2; ++i) refine(balanced, subspaces);
  }
  const Matrix seen = inverse(subspaces.basis) * balanced * subspaces.basis;
  basis_ = scale.asDiagonal() * subspaces.basis;
  Index first = 0;
  for (const Index size : subspaces.sizes) {
    const Matrix coordinates = contracting_coordinates(seen.block(first, first, size, size), kind_);
    if (coordinates.size() == 0) return false;
    basis_.middleCols(first, size) *= inverse(coordinates);
    blocks_.push_back({.first = first, .flow = Matrix(size, size)});
    first += size;
  }
  inverse_ = inverse(basis_);
  const Matrix transformed = inverse_ * flow * basis_;
  for (Block& block : blocks_) {
    const Index size = block.flow.rows();
    block.flow = transformed.block(block.first, block.first, size, size);
  }
  return transformed.allFinite();
}

/// With S⁻¹ = (1 − G)⁻¹R, R the approximate inverse and G = 1 − RS: S⁻¹AS − Â = (1 − G)⁻¹M,
/// M = R(AS − SÂ), so that ‖S⁻¹AS − Â − M‖ ≤ ‖M‖ ‖G‖/(1 − ‖G‖).
bool DecayingMotion::prove(const IntervalMatrix& flow) {
  const Index size = basis_.rows();
  Matrix block_flow = Matrix::Zero(size, size);
  for (Block& block : blocks_) {
    const Index own = block.flow.rows();
    block_flow.block(block.first, block.first, own, own) = block.flow;
    block.size = norm(block.flow);
    block.rate = contraction_rate(block.flow, kind_);
    if (!(block.rate > 0.0)) return false;
  }
  const IntervalMatrix basis = basis_.cast<Interval>();
  const IntervalMatrix one = IntervalMatrix::Identity(size, size);
  const IntervalMatrix missing = one - product(inverse_, basis);  // G
  const IntervalMatrix residual =
      product(flow, basis) - product(basis_, block_flow.cast<Interval>());  // AS − SÂ
  const Interval gap = norm(missing);
  if (!(gap.high < 0.5)) return false;
  inverse_error_ = (gap / (1.0 - gap)).high;
  const IntervalMatrix seen = product(inverse_, residual);
  const Interval spread = inverse_error_ * Interval(norm(seen));
  for (const Block& row : blocks_) {
    std::vector<double>& couplings = couplings_.emplace_back();
    for (const Block& column : blocks_) {
      const double here =
          norm(seen.block(row.first, column.first, row.flow.rows(), column.flow.rows()));
      couplings.push_back((here + spread).high);
    }
  }
  return integrals(std::vector<double>(blocks_.size(), 1.0)).has_value();
}

/// Norms of the blocks' parts.
std::vector<double> DecayingMotion::norms(const IntervalVector& numbers) const {
  std::vector<double> result;
  for (const Block& block : blocks_) {
    Interval sum = 0.0;
    for (Index i = block.first; i < end_of(block); ++i) sum = sum + square(numbers[at(i)]);
    result.push_back(sqrt(sum).high);
  }
  return result;
}

/// Bounds yᵢ ≥ ∫nᵢ dt for nᵢ′ ≤ −rateᵢ nᵢ + Σⱼ couplingᵢⱼ nⱼ + sources of which ∫ ≤ `sources`, and
/// likewise for sums over steps: any y with rateᵢ yᵢ − Σⱼ couplingᵢⱼ yⱼ ≥ sourceᵢ, for the matrix
/// is an M-matrix if there is one for positive sources.
std::optional<std::vector<double>> DecayingMotion::integrals(
    const std::vector<double>& sources) const {
  constexpr int steps = 50;
  const std::size_t count = blocks_.size();
  std::vector<double> result(count, 0.0);
  const auto gain = [&](std::size_t i) {
    Interval sum = sources[i];
    for (std::size_t j = 0; j < count; ++j) {
      sum = sum + Interval(couplings_[i][j]) * result[j];
    }
    return sum / Interval(blocks_[i].rate);
  };
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < count; ++i) result[i] = gain(i).high;
  }
  for (double& value : result) value = (1.01 * Interval(value)).high;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(gain(i).high <= result[i]) || !std::isfinite(result[i])) return std::nullopt;
  }
  return result;
}

}  // namespace gearlash
