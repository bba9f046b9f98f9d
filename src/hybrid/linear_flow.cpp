#include "hybrid/linear_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lists.hpp"

namespace gearlash::hybrid {
namespace {

constexpr int highest_order = 36;

/// The largest rates at which each order's remainder is at most `left_out`.
constexpr std::array<double, highest_order + 1> permitted_rates = [] {
  std::array<double, highest_order + 1> permitted{};
  for (int order = 1; order <= highest_order; ++order) {
    const auto leaves = [order](double rates) {
      double term = 1.0;
      for (int k = 1; k <= order; ++k) term *= rates / (k + 1);
      return term / (1.0 - rates / (order + 2));
    };
    double low = 0.0;
    double high = longest_in_rates;
    if (leaves(high) <= left_out) low = high;
    while (high - low > 0x1p-40 * high) {
      const double middle = 0.5 * (low + high);
      (leaves(middle) <= left_out ? low : high) = middle;
    }
    permitted[static_cast<std::size_t>(order)] = low;
  }
  return permitted;
}();

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

int order_for(double rates) {
  const double* const first = permitted_rates.data();
  return static_cast<int>(std::lower_bound(first + 1, first + highest_order, rates) - first);
}

// ---- moving numbers and their rates -------------------------------------------------------------

LinearFlow::LinearFlow(const AffineFlow& flow) {
  find_moving(flow);
  weigh();
}

void LinearFlow::find_moving(const AffineFlow& flow) {
  const auto size = static_cast<int>(flow.offset.size());
  std::vector<int> place(at(size), -1);
  for (int i = 0; i < size; ++i) {
    if (flow.offset[i] == 0.0 && flow.matrix.row(i).isZero(0.0)) continue;
    place[at(i)] = count();
    numbers_.push_back(i);
  }
  velocity_rows_.push_back(0);
  rows_.push_back(0);
  for (const int i : numbers_) {
    for (int j = 0; j < size; ++j) {
      if (flow.matrix(i, j) == 0.0) continue;
      velocity_entries_.push_back({j, flow.matrix(i, j)});
      if (place[at(j)] >= 0) entries_.push_back({place[at(j)], flow.matrix(i, j)});
    }
    velocity_rows_.push_back(velocity_entries_.size());
    rows_.push_back(entries_.size());
    offsets_.push_back(flow.offset[i]);
  }
}

/// [i][j]: j acts on i, directly or through others.
std::vector<std::vector<bool>> LinearFlow::reaches() const {
  std::vector<std::vector<bool>> reached(at(count()), std::vector<bool>(at(count())));
  for (int i = 0; i < count(); ++i) {
    for (std::size_t e = rows_[at(i)]; e < rows_[at(i) + 1]; ++e) {
      reached[at(i)][at(entries_[e].column)] = true;
    }
  }
  for (std::size_t through = 0; through < reached.size(); ++through) {
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (!reached[i][through]) continue;
      for (std::size_t j = 0; j < reached.size(); ++j) {
        if (reached[through][j]) reached[i][j] = true;
      }
    }
  }
  return reached;
}

namespace {

bool in_one_loop(const std::vector<std::vector<bool>>& reached, std::size_t i, std::size_t j) {
  return reached[i][j] && reached[j][i];
}

}  // namespace

/// Weighted sum of the magnitudes of a row's entries that count.
template <class Counts>
double LinearFlow::sum_of_row(std::size_t row, const Counts& counts) const {
  double sum = 0.0;
  for (std::size_t e = rows_[row]; e < rows_[row + 1]; ++e) {
    const auto j = static_cast<std::size_t>(entries_[e].column);
    if (counts(j)) sum += std::abs(entries_[e].factor) * weights_[j] / weights_[row];
  }
  return sum;
}

/// Balances the sums of rows and columns within each loop (Osborne 1960).
void LinearFlow::weigh_within_loops(const std::vector<std::vector<bool>>& reached) {
  const std::size_t size = reached.size();
  constexpr int sweeps = 20;
  bool changed = true;
  for (int sweep = 0; sweep < sweeps && changed; ++sweep) {
    changed = false;
    for (std::size_t i = 0; i < size; ++i) {
      const double row =
          sum_of_row(i, [&](std::size_t j) { return j != i && in_one_loop(reached, i, j); });
      double column = 0.0;
      for (std::size_t k = 0; k < size; ++k) {
        if (k == i || !in_one_loop(reached, i, k)) continue;
        column += sum_of_row(k, [&](std::size_t j) { return j == i; });
      }
      if (row == 0.0 || column == 0.0) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (factor == 1.0) continue;
      weights_[i] *= factor;
      changed = true;
    }
  }
}

/// Loop by loop, first those that act on the others. Afterwards what comes from other loops is at
/// most a quarter of the fastest rate.
void LinearFlow::weigh_between_loops(const std::vector<std::vector<bool>>& reached,
                                     double fastest) {
  const std::size_t size = reached.size();
  std::vector<std::size_t> order = indices(size);
  sort_by(order, [&](std::size_t i) {  // by the reach of others
    return std::count(reached[i].begin(), reached[i].end(), true) - (reached[i][i] ? 1 : 0);
  });
  std::vector<bool> done(size);
  for (const std::size_t first : order) {
    if (done[first]) continue;
    std::vector<std::size_t> loop = {first};
    for (std::size_t i = 0; i < size; ++i) {
      if (i != first && in_one_loop(reached, first, i)) loop.push_back(i);
    }
    double from_without = 0.0;
    for (const std::size_t i : loop) {
      done[i] = true;
      const double sum =
          sum_of_row(i, [&](std::size_t j) { return j != i && !in_one_loop(reached, i, j); });
      from_without = std::max(from_without, sum);
    }
    if (from_without == 0.0) continue;
    const double factor = std::exp2(std::ceil(std::log2(4.0 * from_without / fastest)));
    for (const std::size_t i : loop) weights_[i] *= factor;
  }
}

void LinearFlow::weigh() {
  const std::vector<std::vector<bool>> reached = reaches();
  const std::size_t size = reached.size();
  weights_.assign(size, 1.0);
  weigh_within_loops(reached);
  double fastest = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    fastest =
        std::max(fastest, sum_of_row(i, [&](std::size_t j) { return in_one_loop(reached, i, j); }));
  }
  if (fastest == 0.0) {
    // A number on which a chain of k others acts is a polynomial of order k + 1.
    for (std::size_t i = 0; i < size; ++i) {
      const auto others = std::count(reached[i].begin(), reached[i].end(), true);
      polynomial_order_ = std::max(polynomial_order_, static_cast<int>(others) + 1);
    }
    polynomial_order_ = std::max(polynomial_order_, 1);
    return;
  }
  weigh_between_loops(reached, fastest);
  for (std::size_t i = 0; i < size; ++i) {
    rate_ = std::max(rate_, sum_of_row(i, [](std::size_t) { return true; }));
  }
  longest_step_ = longest_in_rates / rate_;
}

// ---- motion -------------------------------------------------------------------------------------

void LinearFlow::velocity_at(const double* state, const double* noise, Velocity& velocity) const {
  const std::size_t size = numbers_.size();
  velocity.values.resize(size);
  velocity.noise.resize(size);
  velocity.sizes.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    double value = offsets_[i];
    double unknown = product_rounding * std::abs(offsets_[i]);
    for (std::size_t e = velocity_rows_[i]; e < velocity_rows_[i + 1]; ++e) {
      const auto& [column, factor] = velocity_entries_[e];
      value += factor * state[column];
      unknown += std::abs(factor) * (noise[column] + product_rounding * std::abs(state[column]));
    }
    velocity.values[i] = value;
    velocity.noise[i] = unknown;
    velocity.sizes[i] = std::abs(value) * (1.0 + 8.0 * sum_rounding) + unknown;
  }
}

void LinearFlow::velocity_at(const double* state, Velocity& velocity) const {
  velocity.values.resize(numbers_.size());
  const Entry* entry = velocity_entries_.data();
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const Entry* end = velocity_entries_.data() + velocity_rows_[i + 1];
    double value = offsets_[i];
    for (; entry != end; ++entry) value += entry->factor * state[entry->column];
    velocity.values[i] = value;
  }
}

void LinearFlow::next_term(const double* here, double length, int order, double* next) const {
  const double factor = length / order;
  const std::size_t size = numbers_.size();
  const std::size_t* ends = rows_.data() + 1;
  const Entry* entry = entries_.data();
  std::size_t e = 0;
  for (std::size_t i = 0; i < size; ++i) {
    double value = 0.0;
    for (; e < ends[i]; ++e, ++entry) value += entry->factor * here[entry->column];
    next[i] = factor * value;
  }
}

double LinearFlow::natural_step(const double* state, const Velocity& velocity,
                                std::vector<double>& scratch) const {
  const std::size_t size = numbers_.size();
  const auto orders = at(polynomial_order_);
  scratch.resize((orders + 1) * size);
  double* terms = scratch.data();
  for (std::size_t i = 0; i < size; ++i) {
    terms[i] = state[numbers_[i]];
    terms[size + i] = velocity.values[i];
  }
  for (std::size_t k = 2; k <= orders; ++k) {
    next_term(terms + (k - 1) * size, 1.0, static_cast<int>(k), terms + k * size);
  }
  double longest = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 1; k <= orders; ++k) {
      const double later = std::abs(terms[k * size + i]);
      if (later == 0.0) continue;
      for (std::size_t j = 0; j < k; ++j) {
        const double alike =
            std::pow(std::abs(terms[j * size + i]) / later, 1.0 / static_cast<double>(k - j));
        longest = std::max(longest, alike);
      }
    }
  }
  return longest > 0.0 ? 4.0 * longest : longest_step_;
}

void LinearFlow::advance(const Velocity& velocity, double length, double* state,
                         std::vector<double>& scratch) const {
  const std::size_t size = numbers_.size();
  scratch.resize(3 * size);
  double* here = scratch.data();
  double* next = here + size;
  double* sum = next + size;
  for (std::size_t i = 0; i < size; ++i) sum[i] = here[i] = length * velocity.values[i];
  const int last = order(std::abs(length));
  for (int k = 2; k <= last; ++k) {
    next_term(here, length, k, next);
    for (std::size_t i = 0; i < size; ++i) sum[i] += next[i];
    std::swap(here, next);
  }
  for (std::size_t i = 0; i < size; ++i) state[numbers_[i]] += sum[i];
}

void LinearFlow::add_sizes(const Velocity& velocity, double length, double* sizes,
                           std::vector<double>& scratch) const {
  const std::size_t size = numbers_.size();
  scratch.resize(2 * size);
  double* here = scratch.data();
  double* next = here + size;
  for (std::size_t i = 0; i < size; ++i) here[i] = length * velocity.values[i];
  const int last = order(length);
  for (int k = 1; k <= last; ++k) {
    for (std::size_t i = 0; i < size; ++i) sizes[numbers_[i]] += std::abs(here[i]);
    next_term(here, length, k + 1, next);
    std::swap(here, next);
  }
}

std::vector<std::size_t> LinearFlow::acting() const {
  std::vector<std::size_t> all =
      of_each(entries_, [](const Entry& entry) { return at(entry.column); });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void LinearFlow::times_transposed(const double* row, double factor, bool sizes,
                                  double* result) const {
  std::fill(result, result + count(), 0.0);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    for (std::size_t e = rows_[i]; e < rows_[i + 1]; ++e) {
      const double entry = sizes ? std::abs(entries_[e].factor) : entries_[e].factor;
      result[entries_[e].column] += factor * entry * row[i];
    }
  }
}

Stride::Stride(const LinearFlow& flow, double longest)
    : length_(longest), orders_(at(flow.order(longest))), acting_(flow.acting()) {
  const auto size = at(flow.count());
  const std::size_t blocks = (size + lanes - 1) / lanes;
  terms_.assign(blocks * orders_ * acting_.size(), Rows::Zero());
  change_.assign(blocks * size, Rows::Zero());
  sizes_.assign(blocks * size, Rows::Zero());
  std::vector<double> row(size);
  std::vector<double> next(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t block = i / lanes;
    const auto lane = static_cast<Eigen::Index>(i % lanes);
    std::fill(row.begin(), row.end(), 0.0);
    row[i] = longest;
    for (std::size_t k = 0; k < orders_; ++k) {
      for (std::size_t a = 0; a < acting_.size(); ++a) {
        terms_[(block * orders_ + k) * acting_.size() + a](lane) = row[acting_[a]];
      }
      for (std::size_t j = 0; j < size; ++j) {
        change_[block * size + j](lane) += row[j];
        sizes_[block * size + j](lane) += std::abs(row[j]);
      }
      flow.times_transposed(row.data(), longest / static_cast<double>(k + 2), false, next.data());
      std::swap(row, next);
    }
  }
}

void Stride::advance(const LinearFlow& flow, const Velocity& velocity, double length,
                     double* state) const {
  const std::size_t size = velocity.values.size();
  const double* values = velocity.values.data();
  const double share = length / length_;
  const std::size_t last = at(flow.order(std::abs(length)));
  for (std::size_t first = 0; first < size; first += lanes) {
    const std::size_t block = first / lanes;
    const std::size_t end = std::min(size, first + lanes);
    Rows sum = Rows::Zero();
    if (length == length_) {
      for (std::size_t j = 0; j < size; ++j) sum += values[j] * change_[block * size + j];
    } else {
      for (std::size_t k = last; k-- > 1;) {
        const Rows* column = &terms_[(block * orders_ + k) * acting_.size()];
        for (const std::size_t j : acting_) sum += values[j] * *column++;
        sum *= share;
      }
      sum *= share;
      for (std::size_t i = first; i < end; ++i) {
        sum[static_cast<Eigen::Index>(i - first)] += length * values[i];
      }
    }
    for (std::size_t i = first; i < end; ++i) {
      state[flow.number(static_cast<int>(i))] += sum[static_cast<Eigen::Index>(i - first)];
    }
  }
}

void Stride::add_sizes(const LinearFlow& flow, const Velocity& velocity, double* sizes) const {
  const std::size_t size = velocity.sizes.size();
  for (std::size_t first = 0; first < size; first += lanes) {
    const Rows* column = &sizes_[first / lanes * size];
    Rows sum = Rows::Zero();
    for (const double value : velocity.sizes) sum += value * *column++;
    for (std::size_t i = first; i < std::min(size, first + lanes); ++i) {
      sizes[flow.number(static_cast<int>(i))] += sum[static_cast<Eigen::Index>(i - first)];
    }
  }
}

}  // namespace gearlash::hybrid
