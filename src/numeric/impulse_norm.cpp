// ∫|c e^{At} b| dt and Σ|c (1 + A)ᵏ b| by series over pieces, with every error bounded.
//
// All numbers of a piece are doubles. What rounding has changed in them is bounded beside them,
// with Higham's γₙ = n u/(1 − n u) for n operations (Accuracy and Stability of Numerical
// Algorithms, 2002, chapter 3), in terms of norms.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/lists.hpp"
#include "base/number.hpp"
#include "numeric/decaying_motion.hpp"
#include "numeric/vector_algebra.hpp"

namespace gearlash {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr std::size_t order = 24;  ///< of the series
constexpr double stretch = 3.0;  ///< length of a piece, in 1/‖flow‖: the rest is 3²⁴/24! = 5e-13
constexpr double negligible = 1e-6;  ///< share of the integral at which a block counts as over
constexpr std::size_t most_pieces = 20'000;
constexpr double longest_walk = 16.0;  ///< steps: a longer piece is a series
constexpr int steps_at_a_time = 64;
constexpr int halvings = 10;      ///< of a piece, where the integrand changes its sign
constexpr double unseen = 1e-8;   ///< share of the integral below which a part is not halved
constexpr double unit = 0x1p-53;  ///< u: a result is off by at most this share of itself
/// Bounds of errors are themselves sums and products of at most some hundred numbers that are not
/// negative: rounding changes them by far less than this.
constexpr double rounded_up = 1.0 + 1e-9;

/// Σ coefficientsₖ Π (s − i step)/span, i < k: a function of s from 0 to span. Continuous: step 0,
/// span 1. Stepwise: step 1, and s counts the steps; no more terms than these.
struct Series {
  std::array<double, order> coefficients{};
  std::size_t terms = 0;
  double step = 0.0;
  double span = 1.0;
  double per_span = 1.0;
  double error = 0.0;  ///< ≥ |integrand − series| everywhere

  double factor(double s, std::size_t i) const {
    return (s - step * static_cast<double>(i)) * per_span;
  }
};

/// A series with what its integral needs.
class Integrand {
 public:
  /// Parts of at most `tolerance` need not be seen exactly.
  Integrand(const Series& series, double tolerance) : series_(series), tolerance_(tolerance) {
    double size = 0.0;
    for (std::size_t k = 0; k < series.terms; ++k) {
      const auto number = static_cast<double>(k);
      const double coefficient = series.coefficients[k];
      integrated_[k] = coefficient / (number + 1.0);
      if (k + 1 < series.terms) slope_[k] = (number + 1.0) * series.coefficients[k + 1];
      size += std::abs(coefficient);
      curvature_ += number * (number - 1.0) * std::abs(coefficient);
    }
    // Of Horner's rule with factors that are off by 3u. They are at most 1, or 1 + 1/span for
    // integrals, of which the product is below e. Slopes have weights up to `order`.
    const double operations = 5.0 * static_cast<double>(order);
    error_ = 3.0 * operations * unit * size * rounded_up + std::numeric_limits<double>::min();
    slope_error_ = static_cast<double>(order) * error_;
    curvature_ *= rounded_up;
  }

  /// ∫|series| from 0 to span; or Σ|series| over 0 … span − 1.
  Interval size() const {
    Sum sum;
    add_part(0.0, series_.span, halvings, sum);
    constexpr double rounding = 1e-12;  // of at most some thousand sums
    const double missing = series_.error * series_.span * rounded_up;
    return {std::max(0.0, sum.low * (1.0 - rounding) - missing) * (1.0 - rounding),
            (sum.high * (1.0 + rounding) + missing) * (1.0 + rounding)};
  }

 private:
  struct Sum {
    double low = 0.0;
    double high = 0.0;
  };
  static void add(double value, double error, Sum& sum) {
    sum.low += std::max(0.0, value - error);
    sum.high += value + error;
  }
  double value(double s) const {
    double sum = 0.0;
    for (std::size_t k = series_.terms; k-- > 0;) {
      sum = sum * series_.factor(s, k) + series_.coefficients[k];
    }
    return sum;
  }
  double integral(double s) const {
    double sum = 0.0;
    for (std::size_t k = series_.terms; k-- > 0;) {
      sum = sum * series_.factor(s, k + 1) + integrated_[k];
    }
    return sum * s;
  }
  /// From `from` to `to`; or over from … to − 1.
  void add_part(double from, double to, int halvings_left, Sum& sum) const {
    const bool is_stepwise = series_.step > 0.0;
    double middle = 0.5 * (from + to);  // exact: a multiple of a power of 2
    if (is_stepwise) middle = std::floor(middle);
    double here = 0.0;
    double slope = 0.0;  // times span
    for (std::size_t k = series_.terms; k-- > 0;) {
      const double factor = series_.factor(middle, k);
      here = here * factor + series_.coefficients[k];
      slope = slope * factor + slope_[k];
    }
    here = std::abs(here);
    if (is_stepwise && to - from == 1.0) return add(here, error_, sum);
    // Mean value theorem, for slopes and for their own changes.
    const double reach = std::max(middle - from, to - middle) * series_.per_span;
    const double change =
        (reach * (std::abs(slope) + slope_error_ + reach * curvature_) + error_) * rounded_up;
    if (here > change) {
      return add(std::abs(integral(to) - integral(from)), 2.0 * error_ * series_.span, sum);
    }
    const double most = (to - from) * (here + change);
    if (halvings_left == 0 || most <= tolerance_) {
      sum.high += most;
      return;
    }
    add_part(from, middle, halvings_left - 1, sum);
    add_part(middle, to, halvings_left - 1, sum);
  }

  Series series_;
  double tolerance_;
  std::array<double, order> slope_{};       ///< what one more step adds, or the derivative
  std::array<double, order> integrated_{};  ///< coefficients divided by k + 1
  double curvature_ = 0.0;                  ///< ≥ the second derivative or difference
  double error_ = 0.0;                      ///< of a value, or of an integral over 1
  double slope_error_ = 0.0;
};

double size_of(const IntervalVector& vector) {
  Interval sum = 0.0;
  for (const Interval& number : vector) sum = sum + square(number);
  return sqrt(sum).high;
}

/// Σ|numbers|, which is at least their norm.
double sum_of_sizes(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += std::abs(number);
  return sum * rounded_up;
}

/// What a form sees of a block.
struct View {
  std::vector<double> output;
  double size = 0.0;  ///< ≥ its norm
  bool is_over = false;
};

/// One block's share of the motion: a contraction from a known state.
struct Part {
  const Matrix* flow;
  TimeKind kind;
  double size;                ///< ≥ ‖flow‖
  double rate;                ///< of the contraction
  std::vector<double> state;  ///< as continued, exact
  std::vector<View> views;
  std::vector<double> stepped{};  ///< of step()

  /// ≥ ∫ or Σ of |output · state| from now on.
  double rest(const View& view) const {
    return view.size * sum_of_sizes(state) / rate * rounded_up;
  }
  bool is_over() const {
    return all_of(views, [](const View& view) { return view.is_over; });
  }
  double step(double size_of_state);
  void advance(double length, std::vector<Series>& sums, std::vector<Interval>& errors);

 private:
  std::vector<double> next_term(const std::vector<double>& term, double factor) const;
};

/// (1 + A) state. Gives a bound of the norm of what rounding changes in it. `size_of_state`: ≥ its
/// norm.
double Part::step(double size_of_state) {
  const std::size_t count = state.size();
  stepped.assign(state.begin(), state.end());
  const double* column = flow->data();  // by columns
  for (std::size_t j = 0; j < count; ++j, column += count) {
    for (std::size_t i = 0; i < count; ++i) stepped[i] += column[i] * state[j];
  }
  state.swap(stepped);
  const double operations = static_cast<double>(count) + 4.0;
  return operations * unit * (size + 1.0) * size_of_state + std::numeric_limits<double>::min();
}

std::vector<double> Part::next_term(const std::vector<double>& term, double factor) const {
  std::vector<double> next(term.size());
  const double* column = flow->data();  // by columns
  for (std::size_t j = 0; j < term.size(); ++j, column += term.size()) {
    const double scaled = factor * term[j];
    for (std::size_t i = 0; i < term.size(); ++i) next[i] += column[i] * scaled;
  }
  return next;
}

/// Adds the series of output · state over a piece to `sums` and goes on by `length`. Adds to
/// `errors` what this changes in the integral over all time: by the series' rest over the piece,
/// and by the state from then on.
///   Continuous: e^{A length s} = Σ (length A)ᵏ/k! sᵏ, 0 ≤ s ≤ 1.
///   Stepwise: (1 + A)ˢ = Σ Aᵏ binomial(s, k) = Σ (length A)ᵏ/k! Π (s − i)/length.
/// As both are contractions, what is left out after m terms is at most the m-th term in size.
void Part::advance(double length, std::vector<Series>& sums, std::vector<Interval>& errors) {
  const auto count = static_cast<double>(state.size());
  const double sum_error = (count + 4.0) * unit;  // of a sum of products, twice scaled
  constexpr double end_error = 6.0 * static_cast<double>(order) * unit;
  std::vector<double> term = state;  // (length A)ᵏ/k! state
  double term_error = 0.0;           // ≥ the norm of what it is off
  std::vector<double> end(state.size(), 0.0);
  double off = 0.0;     // ≥ the norm of what `end` is off
  double weight = 1.0;  // of the term at the end: Π (length − i)/length, or 1
  std::size_t k = 0;
  for (; k < order && weight > 0.0; ++k) {
    const auto number = static_cast<double>(k);
    const double size_of_term = sum_of_sizes(term);
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (views[i].is_over) continue;
      double& coefficient = sums[i].coefficients[k];
      coefficient += dot(views[i].output, term);
      sums[i].error +=
          views[i].size * (term_error + sum_error * size_of_term) + unit * std::abs(coefficient);
    }
    for (std::size_t i = 0; i < end.size(); ++i) end[i] += weight * term[i];
    off += weight * (term_error + end_error * size_of_term);
    const double factor = length / (number + 1.0);
    const double growth = factor * size;
    term_error = growth * (term_error + sum_error * size_of_term) * rounded_up +
                 std::numeric_limits<double>::min();
    term = next_term(term, factor);
    if (kind == TimeKind::stepwise) weight *= (length - number) / length;
  }
  for (std::size_t i = 0; i < views.size(); ++i) sums[i].terms = std::max(sums[i].terms, k);
  const Interval left_out = Interval(weight * (sum_of_sizes(term) + term_error) * rounded_up);
  state = end;
  const Interval jump = left_out + Interval(off * rounded_up);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].is_over) continue;
    errors[i] = errors[i] + views[i].size * (length * left_out + jump / rate);
  }
}

/// Input in the coordinates ξ: b = S(numbers + error), but for the error of the inverse.
struct Transformed {
  std::vector<double> numbers;
  IntervalVector error;
};

Transformed transformed_input(const Matrix& basis, const Matrix& inverse,
                              const IntervalVector& input) {
  const VectorOf<Interval> given = vector_of(input);
  const Vector numbers = inverse * middle(given);
  const VectorOf<Interval> rest = given - product(basis, numbers.cast<Interval>());
  return {entries_of<double>(numbers), entries_of<Interval>(product(inverse, rest))};
}

/// cS = numbers + error.
Transformed transformed_output(const Matrix& basis, const IntervalVector& output) {
  const VectorOf<Interval> given = vector_of(output);
  const Vector numbers = basis.transpose() * middle(given);
  const VectorOf<Interval> whole = product(basis.transpose(), given);
  return {entries_of<double>(numbers), entries_of<Interval>(whole - numbers.cast<Interval>())};
}

/// Ends the views that hardly matter any more and gives the size of the fastest part that is left;
/// 0 if there is none. Adds what is left of those that end to `errors`.
double fastest_of(std::vector<Part>& parts, const std::vector<Interval>& so_far,
                  std::vector<Interval>& errors) {
  double fastest = 0.0;
  for (Part& part : parts) {
    for (std::size_t i = 0; i < part.views.size(); ++i) {
      View& view = part.views[i];
      if (view.is_over) continue;
      const double rest = part.rest(view);
      if (rest <= negligible * so_far[i].low) {
        errors[i] = errors[i] + rest;
        view.is_over = true;
      } else {
        fastest = std::max(fastest, part.size);
      }
    }
  }
  return fastest;
}

/// Steps one by one, where a series would be no longer than these.
void walk(std::vector<Part>& parts, std::vector<Interval>& sums, std::vector<Interval>& errors) {
  std::vector<double> walked(sums.size(), 0.0);
  std::vector<double> off(sums.size(), 0.0);
  std::vector<double> values(sums.size());
  for (int step = 0; step < steps_at_a_time; ++step) {
    std::fill(values.begin(), values.end(), 0.0);
    for (Part& part : parts) {
      if (part.is_over()) continue;
      const double size = sum_of_sizes(part.state);
      const double dot_error = (static_cast<double>(part.state.size()) + 2.0) * unit * size;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const View& view = part.views[i];
        if (view.is_over) continue;
        values[i] += dot(view.output, part.state);
        off[i] += view.size * dot_error + unit * std::abs(values[i]);
      }
      const double jump = part.step(size) / part.rate;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!part.views[i].is_over) off[i] += part.views[i].size * jump;
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i) walked[i] += std::abs(values[i]);
  }
  constexpr double rounding = 1e-14;  // of `steps_at_a_time` sums
  for (std::size_t i = 0; i < values.size(); ++i) {
    sums[i] = sums[i] + walked[i];
    errors[i] = errors[i] + off[i] * rounded_up + rounding * walked[i];
  }
}

/// ∫ or Σ of |Σ output · state| of all parts, for the block diagonal motion and each output.
std::vector<Interval> integrals_of(std::vector<Part>& parts, TimeKind kind, std::size_t outputs) {
  const bool is_continuous = kind == TimeKind::continuous;
  std::vector<Interval> sums(outputs, Interval(0.0));
  std::vector<Interval> errors(outputs, Interval(0.0));
  for (std::size_t piece = 0; piece < most_pieces; ++piece) {
    const double fastest = fastest_of(parts, sums, errors);
    if (fastest == 0.0) break;
    // Beyond 2⁵⁰ steps numbers are no longer whole.
    const double length =
        is_continuous ? stretch / fastest : std::clamp(std::floor(stretch / fastest), 1.0, 0x1p50);
    if (!is_continuous && length <= longest_walk) {
      walk(parts, sums, errors);
      continue;
    }
    Series empty;
    if (!is_continuous) {
      empty.step = 1.0;
      empty.span = length;
      empty.per_span = 1.0 / length;
    }
    std::vector<Series> series(outputs, empty);
    for (Part& part : parts) {
      if (!part.is_over()) part.advance(length, series, errors);
    }
    for (std::size_t i = 0; i < outputs; ++i) {
      const double scale = is_continuous ? length : 1.0;
      const Interval here = Integrand(series[i], unseen * sums[i].low / scale).size();
      sums[i] = sums[i] + (is_continuous ? length * here : here);
    }
  }
  for (std::size_t i = 0; i < outputs; ++i) {
    for (const Part& part : parts) {
      if (!part.views[i].is_over) errors[i] = errors[i] + part.rest(part.views[i]);
    }
    sums[i] = {(sums[i] - errors[i]).low, (sums[i] + errors[i]).high};
  }
  return sums;
}

}  // namespace

Interval DecayingMotion::impulse_norm(const IntervalVector& input,
                                      const IntervalVector& output) const {
  return impulse_norms(input, {output}).front();
}

std::vector<Interval> DecayingMotion::impulse_norms(
    const IntervalVector& input, const std::vector<IntervalVector>& outputs) const {
  const auto is_nothing = [](const Interval& number) { return is_exactly(number, 0.0); };
  if (all_of(input, is_nothing)) {
    return std::vector<Interval>(outputs.size(), Interval(0.0));
  }
  const Transformed start = transformed_input(basis_, inverse_, input);
  std::vector<Part> parts;
  for (const Block& block : blocks_) {
    Part& part = parts.emplace_back();
    part.flow = &block.flow;
    part.kind = kind_;
    part.size = block.size;
    part.rate = block.rate;
    part.state.assign(start.numbers.data() + block.first, start.numbers.data() + end_of(block));
  }
  std::vector<std::vector<double>> output_errors;
  for (const IntervalVector& output : outputs) {
    const Transformed seen = transformed_output(basis_, output);
    output_errors.push_back(norms(seen.error));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      View& view = parts[i].views.emplace_back();
      view.output.assign(seen.numbers.data() + blocks_[i].first,
                         seen.numbers.data() + end_of(blocks_[i]));
      view.size = size_of({view.output.begin(), view.output.end()});
    }
  }
  // What the block diagonal motion leaves out.
  const Interval spread = inverse_error_ * Interval(size_of(start.error));
  const std::vector<double> start_errors = norms(start.error);
  // ≥ ∫‖ξ̂‖ dt of each block.
  const std::vector<Interval> durations = of_each(parts, [](const Part& part) {
    return Interval(size_of({part.state.begin(), part.state.end()})) / part.rate;
  });
  std::vector<double> sources;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Interval source = start_errors[i] + spread;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      source = source + couplings_[i][j] * durations[j];
    }
    sources.push_back(source.high);
  }
  const std::optional<std::vector<double>> differences = integrals(sources);
  if (!differences) return std::vector<Interval>(outputs.size(), Interval(0.0, infinity));
  std::vector<Interval> left_out(outputs.size(), Interval(0.0));
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double error = output_errors[k][i];
      left_out[k] = left_out[k] + (parts[i].views[k].size + Interval(error)) * (*differences)[i] +
                    error * durations[i];
    }
  }
  std::vector<Interval> sums = integrals_of(parts, kind_, outputs.size());
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const Interval& sum = sums[k];
    sums[k] = settled(std::max(0.0, (sum - left_out[k]).low), (sum + left_out[k]).high);
    if (!std::isfinite(sums[k].high)) sums[k] = {0.0, infinity};
  }
  return sums;
}

}  // namespace gearlash
