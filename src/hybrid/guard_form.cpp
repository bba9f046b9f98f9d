#include "hybrid/guard_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hybrid/first_exit.hpp"

namespace gearlash::hybrid {

SparseForm::SparseForm(const AffineForm& form) : offset(form.offset) {
  for (int i = 0; i < static_cast<int>(form.normal.size()); ++i) {
    if (form.normal[i] != 0.0) terms.push_back({i, form.normal[i]});
  }
}

double SparseForm::at(const double* state) const {
  double sum = offset;
  for (const auto& [number, factor] : terms) sum += factor * state[number];
  return sum;
}

double SparseForm::size_at(const double* state) const {
  double sum = std::abs(offset);
  for (const auto& [number, factor] : terms) sum += std::abs(factor * state[number]);
  return sum;
}

double SparseForm::noise_at(const double* state, const double* noise) const {
  double sum = sum_rounding * std::abs(offset);
  for (const auto& [number, factor] : terms) {
    sum += std::abs(factor) * (sum_rounding * std::abs(state[number]) + noise[number]);
  }
  return sum;
}

namespace {

constexpr std::size_t lanes = 4;
using Lanes = Eigen::Array<double, lanes, 1>;

double power_of(double base, int exponent) {
  double power = 1.0;
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) power *= base;
    base *= base;
  }
  return power;
}

/// Rounding of the coefficient of an order, as a share of the magnitude of its terms.
double rounding_of(std::size_t order) {
  return sum_rounding + product_rounding * static_cast<double>(order);
}

}  // namespace

GuardTable::GuardTable(const LinearFlow& flow, const SparseForm& form)
    : count_(static_cast<std::size_t>(flow.count())),
      is_polynomial_(flow.polynomial_order() > 0),
      length_(is_polynomial_ ? 1.0 : flow.longest_step()),
      orders_(count_ == 0 ? 0 : static_cast<std::size_t>(flow.order(length_))),
      room_((orders_ + lanes - 1) / lanes * lanes) {
  rows_.assign(count_ * room_, 0.0);
  sizes_.assign(count_ * room_, 0.0);
  few_ = std::min(orders_, most_leading - 1);
  std::vector<double> row(count_, 0.0);
  std::vector<double> next(count_);
  for (const auto& [number, factor] : form.terms) {
    for (int i = 0; i < flow.count(); ++i) {
      if (flow.number(i) == number) row[static_cast<std::size_t>(i)] = factor * length_;
    }
  }
  const auto fill = [&](std::vector<double> first, bool sizes, std::vector<double>& table) {
    for (std::size_t k = 0; k < orders_; ++k) {
      for (std::size_t j = 0; j < count_; ++j) table[j * room_ + k] = first[j];
      flow.times_transposed(first.data(), length_ / static_cast<double>(k + 2), sizes, next.data());
      std::swap(first, next);
    }
    return first;
  };
  fill(row, false, rows_);
  for (double& entry : row) entry = std::abs(entry);
  add_up(flow, fill(row, true, sizes_));
}

/// `sizes` are those of the first order that the table does not have.
void GuardTable::add_up(const LinearFlow& flow, const std::vector<double>& sizes) {
  beyond_ = left_out_by(flow, sizes);
  beyond_.insert(beyond_.begin(), orders_ * count_, 0.0);
  for (std::size_t k = orders_; k-- > 0;) {
    for (std::size_t j = 0; j < count_; ++j) {
      beyond_[k * count_ + j] = beyond_[(k + 1) * count_ + j] + sizes_[j * room_ + k];
    }
  }
  for (std::size_t j = 0; j < count_; ++j) {
    if (beyond_[j] != 0.0) acting_.push_back(j);
  }
}

/// Σ of sizes of all orders that the table does not have, by velocities. They are added up until
/// the rest, of which the weights give a bound, is negligible beside what the table has.
std::vector<double> GuardTable::left_out_by(const LinearFlow& flow,
                                            std::vector<double> sizes) const {
  std::vector<double> sum(count_, 0.0);
  if (is_polynomial_) return sum;
  std::vector<double> in_table(count_, 0.0);
  for (std::size_t j = 0; j < count_; ++j) {
    for (std::size_t k = 0; k < orders_; ++k) in_table[j] += sizes_[j * room_ + k];
  }
  std::vector<double> next(count_);
  for (std::size_t order = orders_ + 1;; ++order) {
    // Weighted sums fall by longest_in_rates/order, at least by half, from order to order.
    double rest = 0.0;
    for (std::size_t j = 0; j < count_; ++j) {
      rest += 2.0 * sizes[j] * flow.weight(static_cast<int>(j));
    }
    bool is_negligible = true;
    for (std::size_t j = 0; j < count_; ++j) {
      const double known = (in_table[j] + sum[j]) * flow.weight(static_cast<int>(j));
      // A chain of numbers that is longer than the orders may yet act.
      const bool may_act = known > 0.0 || order < count_;
      if (may_act && rest > left_out * known) is_negligible = false;
    }
    for (std::size_t j = 0; j < count_; ++j) {
      if (!is_negligible) {
        sum[j] += sizes[j];
      } else if (in_table[j] + sum[j] > 0.0) {
        sum[j] += rest / flow.weight(static_cast<int>(j));
      }
    }
    if (is_negligible) return sum;
    flow.times_transposed(sizes.data(), length_ / static_cast<double>(order + 1), true,
                          next.data());
    std::swap(sizes, next);
  }
}

double GuardTable::beyond(const Velocity& velocity, double share, int order) const {
  double sum = 0.0;
  if (is_polynomial_) {  // a share has no meaning by itself and may be above 1
    for (std::size_t k = orders_; k > static_cast<std::size_t>(order); --k) {
      for (const std::size_t j : acting_) sum += sizes_[j * room_ + k - 1] * velocity.sizes[j];
      sum *= share;
    }
    return sum * power_of(share, order);
  }
  const double* const sizes = beyond_.data() + static_cast<std::size_t>(order) * count_;
  for (const std::size_t j : acting_) sum += sizes[j] * velocity.sizes[j];
  return sum * power_of(share, order + 1);
}

double GuardTable::uncertainty_of(const Velocity& velocity, double share, int order) const {
  const auto k = static_cast<std::size_t>(order - 1);
  const double rounding = rounding_of(k);
  double sum = 0.0;
  for (const std::size_t j : acting_) {
    sum += sizes_[j * room_ + k] * (velocity.noise[j] + rounding * std::abs(velocity.values[j]));
  }
  return sum * power_of(share, order);
}

double GuardTable::uncertainty(const Velocity& velocity, double share, int first, int last) const {
  double sum = 0.0;
  double power = power_of(share, first);
  const auto from = static_cast<std::size_t>(first - 1);
  const auto to = static_cast<std::size_t>(last);
  for (std::size_t k = from / lanes * lanes; k < to; k += lanes) {
    Lanes by_noise = Lanes::Zero();
    Lanes by_values = Lanes::Zero();
    for (const std::size_t j : acting_) {
      const Eigen::Map<const Lanes> sizes(&sizes_[j * room_ + k]);
      by_noise += velocity.noise[j] * sizes;
      by_values += std::abs(velocity.values[j]) * sizes;
    }
    for (std::size_t i = std::max(k, from); i < std::min(k + lanes, to); ++i) {
      const auto lane = static_cast<Eigen::Index>(i - k);
      sum += power * (by_noise[lane] + rounding_of(i) * by_values[lane]);
      power *= share;
    }
  }
  return sum;
}

double GuardTable::bound_of_uncertainty(const Velocity& velocity, double share, int first) const {
  if (is_polynomial_) return uncertainty(velocity, share, first, static_cast<int>(orders_));
  const double rounding = rounding_of(orders_);
  double sum = 0.0;
  for (const std::size_t j : acting_) {
    sum += beyond_[j] * (velocity.noise[j] + rounding * std::abs(velocity.values[j]));
  }
  return power_of(share, first) * sum;
}

void GuardTable::coefficients(const Velocity& velocity, double share, int last,
                              double* coefficients) const {
  const auto orders = static_cast<std::size_t>(last);
  for (std::size_t k = 0; k < orders; k += lanes) {
    Lanes sum = Lanes::Zero();
    for (const std::size_t j : acting_) {
      sum += velocity.values[j] * Eigen::Map<const Lanes>(&rows_[j * room_ + k]);
    }
    Eigen::Map<Lanes>(coefficients + 1 + k) = sum;
  }
  if (share == 1.0) return;
  double power = share;
  for (std::size_t k = 1; k <= orders; ++k) {
    coefficients[k] *= power;
    power *= share;
  }
}

double GuardTable::time_to_zero(double value, const Velocity& velocity) const {
  std::array<double, lanes + 1> g{value};
  coefficients(velocity, 1.0, lanes, g.data());
  double time = -value / g[1];
  constexpr int rounds = 2;
  for (int i = 0; i < rounds; ++i) {
    time = -value / (g[1] + time * (g[2] + time * (g[3] + time * g[4])));
  }
  return time * length_;
}

}  // namespace gearlash::hybrid
