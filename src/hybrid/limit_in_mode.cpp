#include "hybrid/limit_in_mode.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "hybrid/linear_flow.hpp"
#include "numeric/linear_algebra.hpp"

namespace gearlash::hybrid {
namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;
using Spectrum = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

/// Speeds, and components of the velocity, that differ by less are one, or none: rounding.
constexpr double rounding = 1e-10;

/// The velocity obeys v′ = A v. Numbers that never move are left out, and those that move alike, as
/// both shafts whose faces stay together, are one.
struct Moving {
  Matrix matrix;
  Vector velocity;
  std::vector<std::vector<Index>> numbers;  ///< of each row
};

/// Those that move, and those that they move.
std::vector<Index> moved(const Matrix& matrix, const Vector& velocity) {
  std::vector<bool> is_moved(static_cast<std::size_t>(velocity.size()));
  std::vector<Index> all;
  const auto add = [&](Index number) {
    if (is_moved[static_cast<std::size_t>(number)]) return;
    is_moved[static_cast<std::size_t>(number)] = true;
    all.push_back(number);
  };
  for (Index i = 0; i < velocity.size(); ++i) {
    if (velocity[i] != 0.0) add(i);
  }
  for (std::size_t next = 0; next < all.size(); ++next) {
    for (Index i = 0; i < velocity.size(); ++i) {
      if (matrix(i, all[next]) != 0.0) add(i);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

bool move_alike(const Moving& moving, Index one, Index other) {
  const double apart = std::abs(moving.velocity[one] - moving.velocity[other]);
  return apart <= rounding * moving.velocity.cwiseAbs().maxCoeff() &&
         moving.matrix.row(one) == moving.matrix.row(other);
}

void merge(Moving& moving, Index one, Index other) {
  moving.matrix.col(one) += moving.matrix.col(other);
  std::vector<Index> kept;
  for (Index i = 0; i < moving.velocity.size(); ++i) {
    if (i != other) kept.push_back(i);
  }
  moving.matrix = Matrix(moving.matrix(kept, kept));
  moving.velocity = Vector(moving.velocity(kept));
  auto& numbers = moving.numbers;
  const auto gone = numbers.begin() + other;
  auto& joined = numbers[static_cast<std::size_t>(one)];
  joined.insert(joined.end(), gone->begin(), gone->end());
  numbers.erase(gone);
}

bool merge_two(Moving& moving) {
  for (Index one = 0; one < moving.velocity.size(); ++one) {
    for (Index other = one + 1; other < moving.velocity.size(); ++other) {
      if (!move_alike(moving, one, other)) continue;
      merge(moving, one, other);
      return true;
    }
  }
  return false;
}

Moving moving_part(const Matrix& matrix, const Vector& velocity) {
  const std::vector<Index> all = moved(matrix, velocity);
  Moving moving{matrix(all, all), velocity(all), {}};
  for (const Index number : all) moving.numbers.push_back({number});
  while (merge_two(moving)) {
  }
  return moving;
}

/// The ways (cₖ/λₖ) rₖ that decays still have to go, with a minus sign, and what goes on for ever.
/// Empty if one grows, or if eigenvectors are too inaccurate to tell.
struct Decays {
  Spectrum values;
  ComplexMatrix ways;  ///< columns
  Vector drift;
};

std::optional<Decays> decays_of(const Moving& moving) {
  const Eigensystem system = eigensystem(moving.matrix);
  const Spectrum shares = solved(system.vectors, ComplexMatrix(moving.velocity.cast<Complex>()));
  const double speed = moving.velocity.cwiseAbs().maxCoeff();
  const double size = moving.matrix.cwiseAbs().maxCoeff();
  constexpr double accurate = 1e-3;
  constexpr double least_damping = 1e-9;
  Decays decays{system.values, ComplexMatrix::Zero(system.vectors.rows(), system.vectors.cols()),
                Vector::Zero(moving.velocity.size())};
  if (!shares.allFinite()) return std::nullopt;
  for (Index k = 0; k < shares.size(); ++k) {
    const Spectrum& vector = system.vectors.col(k);
    const Complex value = system.values[k];
    const double part = std::abs(shares[k]) * vector.cwiseAbs().maxCoeff();
    const double misfit = (moving.matrix * vector - value * vector).cwiseAbs().maxCoeff();
    const bool is_accurate = misfit <= accurate * std::abs(value) * vector.cwiseAbs().maxCoeff();
    const bool decays_surely = is_accurate && -value.real() > least_damping * std::abs(value);
    if (decays_surely) {
      decays.ways.col(k) = shares[k] / value * vector;
    } else if (std::abs(value) > rounding * size) {
      return std::nullopt;
    } else if (part > rounding * speed) {
      decays.drift += (shares[k] * vector).real();
    }
  }
  // A velocity that itself grows is no drift.
  const double left = (moving.matrix * decays.drift).cwiseAbs().maxCoeff();
  if (left > rounding * size * decays.drift.cwiseAbs().maxCoeff()) return std::nullopt;
  const Vector sum = (system.vectors * shares).real();
  if (!((sum - moving.velocity).cwiseAbs().maxCoeff() <= accurate * speed)) return std::nullopt;
  return decays;
}

/// Where a guard is in the end.
enum class GuardEnd { crossed, border, off };

/// Where the terms of a guard, of which `last` and a drift remain in the end, leave it. `size` is
/// that of all numbers in it: eigenvectors are known to rounding of their largest number.
GuardEnd end_of(double last, double drift, double size, const Spectrum& terms,
                const Spectrum& values) {
  const double all = terms.cwiseAbs().sum();
  const double unknown = sum_rounding * size + rounding * all;
  const double now = last + terms.sum().real();
  if (drift * now < 0.0) return GuardEnd::crossed;
  if (all <= sum_rounding * size) return GuardEnd::off;  // constant
  std::optional<Index> slowest;
  for (Index k = 0; k < terms.size(); ++k) {
    const bool counts = std::abs(terms[k]) > unknown;
    if (counts && (!slowest || values[k].real() > values[*slowest].real())) slowest = k;
  }
  const double side = now < 0.0 ? -1.0 : 1.0;
  const bool is_real = slowest && values[*slowest].imag() == 0.0;
  const double slow = is_real ? side * terms[*slowest].real() : 0.0;
  const double others = all - std::abs(slow);
  if (side * last < -unknown) return GuardEnd::crossed;
  if (side * last <= unknown) return slow > others ? GuardEnd::border : GuardEnd::crossed;
  return side * last + std::min(slow, 0.0) > others ? GuardEnd::off : GuardEnd::crossed;
}

}  // namespace

std::optional<LimitInMode> limit_in_mode(const AffineMode& mode, const Vector& numbers) {
  if (!mode.timed.empty()) return std::nullopt;
  const Vector velocity = mode.flow.velocity(numbers);
  const Moving moving = moving_part(mode.flow.matrix, velocity);
  LimitInMode limit{numbers, Vector::Zero(numbers.size())};
  if (moving.numbers.empty()) return limit;
  const auto decays = decays_of(moving);
  if (!decays) return std::nullopt;
  const Vector still_to_go = -decays->ways.rowwise().sum().real();
  for (std::size_t row = 0; row < moving.numbers.size(); ++row) {
    for (const Index number : moving.numbers[row]) {
      limit.numbers[number] += still_to_go[static_cast<Index>(row)];
      limit.drift[number] = decays->drift[static_cast<Index>(row)];
    }
  }
  for (const Transition& transition : mode.transitions) {
    const AffineForm& guard = transition.guard;
    Vector normal = Vector::Zero(still_to_go.size());
    for (std::size_t row = 0; row < moving.numbers.size(); ++row) {
      for (const Index number : moving.numbers[row]) {
        normal[static_cast<Index>(row)] += guard.normal[number];
      }
    }
    const double size =
        guard.size_at(limit.numbers) + normal.cwiseAbs().sum() * decays->ways.cwiseAbs().maxCoeff();
    const Spectrum terms = decays->ways.transpose() * normal.cast<Complex>();
    const GuardEnd end =
        end_of(guard.at(limit.numbers), normal.dot(decays->drift), size, terms, decays->values);
    if (end == GuardEnd::crossed) return std::nullopt;
    limit.is_on_border = limit.is_on_border || end == GuardEnd::border;
  }
  return limit;
}

}  // namespace gearlash::hybrid
