#include "prepared_flow.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

namespace gearlash::hybrid {
namespace {

/// A step times the rate. What terms of either sign take from each other is then below e².
constexpr double longest_in_rates = 2.0;
constexpr int highest_order = 60;
/// Of a sum of some products, as a share of the largest of them.
constexpr double epsilon = 4.0 * std::numeric_limits<double>::epsilon();

/// Decays split off are so much faster than all that is left, which pays.
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

/// How many of the largest eigenvalues decay and have the widest gap, by ratio, to the next; 0
/// where none is wide enough.
std::size_t count_of_fast(const Spectrum& values, const std::vector<Eigen::Index>& order) {
  std::size_t count = 0;
  double widest = least_gap;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    constexpr double least_damping = 1e-3;
    const std::complex<double> here = values[order[i]];
    if (!(-here.real() > least_damping * std::abs(here))) break;
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
  const Eigen::EigenSolver<Matrix> solver(matrix);
  const std::vector<Eigen::Index> order = by_size(solver.eigenvalues());
  ComplexMatrix vectors(matrix.rows(), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    vectors.col(static_cast<Eigen::Index>(i)) = solver.eigenvectors().col(order[i]);
  }
  return vectors;
}

}  // namespace

Vector Series::at(double share) const {
  Vector state = Eigen::Map<const Vector>(term(order_), size_);
  for (int k = order_; k-- > 0;) {
    const double* here = term(k);
    for (int i = 0; i < size_; ++i) state[i] = state[i] * share + here[i];
  }
  return state;
}

Vector Series::magnitude() const {
  Vector sum = Vector::Zero(size_);
  for (int k = 0; k <= order_; ++k) {
    const double* here = term(k);
    for (int i = 0; i < size_; ++i) sum[i] += std::abs(here[i]);
  }
  return sum;
}

LinearFlow::LinearFlow(const AffineFlow& flow)
    : size_(static_cast<int>(flow.offset.size())),
      matrix_(flow.matrix),
      sizes_(flow.matrix.cwiseAbs()),
      offset_(flow.offset),
      weights_(static_cast<std::size_t>(size_), 1.0) {
  balance();
  for (int i = 0; i < size_; ++i) {
    double sum = 0.0;
    for (int j = 0; j < size_; ++j) {
      sum += std::abs(matrix_(i, j)) * weights_[static_cast<std::size_t>(j)];
    }
    norm_ = std::max(norm_, sum / weights_[static_cast<std::size_t>(i)]);
  }
  longest_step_ = norm_ > 0.0 ? longest_in_rates / norm_ : std::numeric_limits<double>::max();
}

void LinearFlow::balance() {
  constexpr int sweeps = 20;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool changed = false;
    for (int i = 0; i < size_; ++i) {
      double row = 0.0;
      double column = 0.0;
      for (int j = 0; j < size_; ++j) {
        if (j == i) continue;
        const double ratio =
            weights_[static_cast<std::size_t>(j)] / weights_[static_cast<std::size_t>(i)];
        row += std::abs(matrix_(i, j)) * ratio;
        column += std::abs(matrix_(j, i)) / ratio;
      }
      if (row == 0.0 || column == 0.0) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (factor == 1.0) continue;
      weights_[static_cast<std::size_t>(i)] *= factor;
      changed = true;
    }
    if (!changed) return;
  }
}

double LinearFlow::weighted_norm(const double* vector) const {
  double largest = 0.0;
  for (int i = 0; i < size_; ++i) {
    largest = std::max(largest, std::abs(vector[i]) / weights_[static_cast<std::size_t>(i)]);
  }
  return largest;
}

void LinearFlow::expand(const Vector& state, const Vector& noise, double length,
                        Series& series) const {
  const auto size = static_cast<std::size_t>(size_);
  series.size_ = size_;
  series.length_ = length;
  series.terms_.resize(size * (highest_order + 1));
  series.rounding_.resize(size * (highest_order + 1));
  double* terms = series.terms_.data();
  double* roundings = series.rounding_.data();
  const Vector velocity = this->velocity(state);
  const Vector velocity_noise =
      sizes_ * (noise + epsilon * state.cwiseAbs()) + epsilon * offset_.cwiseAbs();
  for (std::size_t i = 0; i < size; ++i) {
    const auto number = static_cast<Eigen::Index>(i);
    terms[i] = state[number];
    roundings[i] = noise[number];
    terms[size + i] = length * velocity[number];
    roundings[size + i] = length * velocity_noise[number];
  }
  const double reach = length * norm_;
  const double largest = std::max(weighted_norm(terms), weighted_norm(terms + size));
  const double negligible = 0x1p-60 * largest;
  const double* matrix = matrix_.data();
  const double* sizes = sizes_.data();
  for (int k = 1;; ++k) {
    const double* here = terms + static_cast<std::size_t>(k) * size;
    const double q = reach / (k + 1);
    const double left_out = q < 1.0 ? weighted_norm(here) * q / (1.0 - q) : largest;
    series.order_ = k;
    series.remainder_ = left_out;
    if (left_out <= negligible || k == highest_order) return;
    const double* rounding_here = roundings + static_cast<std::size_t>(k) * size;
    double* next = terms + static_cast<std::size_t>(k + 1) * size;
    double* rounding_next = roundings + static_cast<std::size_t>(k + 1) * size;
    std::fill(next, next + size, 0.0);
    std::fill(rounding_next, rounding_next + size, 0.0);
    const double factor = length / (k + 1);
    for (std::size_t j = 0; j < size; ++j) {
      const double by = factor * here[j];
      const double rounding_by = factor * (rounding_here[j] + epsilon * std::abs(here[j]));
      const double* column = matrix + j * size;
      const double* column_sizes = sizes + j * size;
      for (std::size_t i = 0; i < size; ++i) {
        next[i] += column[i] * by;
        rounding_next[i] += column_sizes[i] * rounding_by;
      }
    }
  }
}

// ---- fast decays --------------------------------------------------------------------------------

PreparedFlow::PreparedFlow(const AffineFlow& flow) : whole_(flow), split_(split(flow)) {}

/// P = V (WᵀV)⁻¹ Wᵀ of the right and left eigenvectors V, W of the fast decays.
std::optional<PreparedFlow::Split> PreparedFlow::split(const AffineFlow& flow) {
  const Matrix& matrix = flow.matrix;
  const Spectrum values = matrix.eigenvalues();
  const std::size_t count = count_of_fast(values, by_size(values));
  if (count == 0) return std::nullopt;
  const ComplexMatrix right = fast_vectors(matrix, count);
  const ComplexMatrix left = fast_vectors(matrix.transpose(), count);
  const ComplexMatrix overlap = left.transpose() * right;
  const Matrix projector = (right * overlap.partialPivLu().solve(left.transpose())).real();
  // Where eigenvectors are nearly alike it is known too badly to be of use.
  constexpr double acceptable = 1e-11;
  const double size = 1.0 + projector.norm();
  const Matrix commuted = matrix * projector - projector * matrix;
  const bool is_projector = (projector * projector - projector).norm() <= acceptable * size;
  const bool is_invariant = commuted.norm() <= acceptable * size * matrix.norm();
  if (!projector.allFinite() || !is_projector || !is_invariant) return std::nullopt;
  // A P z = −P b, z = P z: A with the slow part replaced by the identity can be inverted.
  const Matrix identity = Matrix::Identity(matrix.rows(), matrix.cols());
  const Matrix invertible = matrix * projector + (identity - projector);
  const Vector rest = -(projector * invertible.partialPivLu().solve(projector * flow.offset));
  return Split{LinearFlow({matrix - matrix * projector, flow.offset - projector * flow.offset}),
               projector, rest};
}

const LinearFlow& PreparedFlow::from(const Vector& state) const {
  if (!split_) return whole_;
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  const Vector off = (split_->projector * state - split_->rest).cwiseAbs();
  const Vector size = split_->projector.cwiseAbs() * state.cwiseAbs() + split_->rest.cwiseAbs();
  return (off.array() <= rounding * size.array()).all() ? split_->slow : whole_;
}

Vector PreparedFlow::corrected(const LinearFlow& flow, const Vector& state) const {
  if (&flow == &whole_) return state;
  return state - (split_->projector * state - split_->rest);
}

}  // namespace gearlash::hybrid
