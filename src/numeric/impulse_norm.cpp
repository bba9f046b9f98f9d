// ∫|c e^{At} b| dt and Σ|c (1 + A)ᵏ b| by series over pieces, with every error bounded.
#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/decaying_motion.hpp"

namespace gearlash {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;

constexpr std::size_t order = 24;  ///< of the series
constexpr double stretch = 3.0;  ///< length of a piece, in 1/‖flow‖: the rest is 3²⁴/24! = 5e-13
constexpr double negligible = 1e-6;  ///< share of the integral at which a block counts as over
constexpr std::size_t most_pieces = 20'000;
constexpr int halvings = 10;  ///< of a piece, where the integrand changes its sign

/// Σ seriesₖ Π (s − i step)/span, i < k: a function of s from 0 to span. Continuous: step 0,
/// span 1. Stepwise: step 1, and s counts the steps.
using Series = std::array<Interval, order>;

struct Piece {
  double step;
  double span;

  Interval factor(const Interval& s, std::size_t i) const {
    return step == 0.0 ? s : (s - step * static_cast<double>(i)) / span;
  }
};

/// What is integrated over a piece.
struct Integrand {
  Series series;
  Series slope;       ///< of series, or what one more step adds
  Series integrated;  ///< series with its terms divided by k + 1
  Piece piece;
};

Interval value(const Series& series, const Interval& s, const Piece& piece) {
  Interval sum = series[order - 1];
  for (std::size_t k = order - 1; k-- > 0;) sum = sum * piece.factor(s, k) + series[k];
  return sum;
}

/// ∫ from 0 to s; or the sum of the values at 0 … s − 1.
Interval integral(const Integrand& integrand, double s) {
  Interval sum = 0.0;
  for (std::size_t k = order; k-- > 0;) {
    sum = sum * integrand.piece.factor(s, k + 1) + integrand.integrated[k];
  }
  return sum * s;
}

Integrand integrand_of(const Series& series, const Piece& piece) {
  Integrand result{.series = series, .slope = {}, .integrated = {}, .piece = piece};
  for (std::size_t k = 0; k < order; ++k) {
    const Interval next = static_cast<double>(k + 1);
    result.integrated[k] = series[k] / next;
    if (k + 1 < order) result.slope[k] = next * series[k + 1] / Interval(piece.span);
  }
  return result;
}

/// ∫|series| from `from` to `to`; or Σ|series| over from … to − 1.
Interval integral_of_size(const Integrand& integrand, double from, double to, int halvings_left) {
  const Piece& piece = integrand.piece;
  const bool is_stepwise = piece.step > 0.0;
  if (is_stepwise && to - from == 1.0) return abs(value(integrand.series, from, piece));
  double middle = 0.5 * (from + to);  // exact: a multiple of a power of 2
  if (is_stepwise) middle = std::floor(middle);
  const Interval range =
      value(integrand.series, middle, piece) +
      value(integrand.slope, Interval(from, to), piece) * Interval(from - middle, to - middle);
  if (range.low >= 0.0 || range.high <= 0.0) {
    return not_negative(abs(integral(integrand, to) - integral(integrand, from)));
  }
  if (halvings_left == 0) return {0.0, (Interval(to - from) * abs(range)).high};
  return integral_of_size(integrand, from, middle, halvings_left - 1) +
         integral_of_size(integrand, middle, to, halvings_left - 1);
}

double size_of(const IntervalVector& vector) {
  Interval sum = 0.0;
  for (const Interval& number : vector) sum = sum + square(number);
  return sqrt(sum).high;
}

/// One block's share of the motion: a contraction from a known state.
struct Part {
  const Matrix* flow;
  TimeKind kind;
  double size;                ///< ≥ ‖flow‖
  double rate;                ///< of the contraction
  std::vector<double> state;  ///< as continued, exact
  std::vector<double> output;
  double output_size;  ///< ≥ its norm
  bool is_over = false;

  /// ≥ ∫ or Σ of |output · state| from now on.
  double rest() const {
    const IntervalVector wide(state.begin(), state.end());
    return (output_size * Interval(size_of(wide)) / rate).high;
  }
  double advance(double length, Series& sum);
};

/// Adds the series of output · state over a piece to `sum` and goes on by `length`. Gives a bound
/// of the error that this makes in the integral over all time: of the series over the piece, and of
/// the state from then on.
///   Continuous: e^{A length s} = Σ (length A)ᵏ/k! sᵏ, 0 ≤ s ≤ 1.
///   Stepwise: (1 + A)ˢ = Σ Aᵏ binomial(s, k) = Σ (length A)ᵏ/k! Π (s − i)/length.
/// As both are contractions, what is left out after m terms is at most the m-th term in size.
double Part::advance(double length, Series& sum) {
  const std::size_t count = state.size();
  IntervalVector term(state.begin(), state.end());  // (length A)ᵏ/k! state
  IntervalVector end(count, Interval(0.0));
  IntervalVector next(count);
  Interval weight = 1.0;  // of the term at the end: Π (length − i)/length, or 1
  for (std::size_t k = 0; k < order && weight.high > 0.0; ++k) {
    const auto number = static_cast<double>(k);
    for (std::size_t i = 0; i < count; ++i) {
      sum[k] = sum[k] + output[i] * term[i];
      end[i] = end[i] + weight * term[i];
    }
    const Interval factor = length / Interval(number + 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      Interval product = 0.0;
      for (std::size_t j = 0; j < count; ++j) {
        product = product + (*flow)(static_cast<Index>(i), static_cast<Index>(j)) * term[j];
      }
      next[i] = factor * product;
    }
    if (kind == TimeKind::stepwise) weight = weight * (Interval(length - number) / length);
    term.swap(next);
  }
  const Interval left_out = weight * Interval(size_of(term));
  IntervalVector radius(count);
  for (std::size_t i = 0; i < count; ++i) {
    state[i] = 0.5 * (end[i].low + end[i].high);
    radius[i] = end[i] - state[i];
  }
  const Interval jump = left_out + size_of(radius);
  return (output_size * (length * left_out + jump / rate)).high;
}

/// Input and output in the coordinates ξ: b = S(start + start_error), cS = output + output_error.
struct Transformed {
  Eigen::VectorXd start;
  Eigen::VectorXd output;
  IntervalVector start_error;  ///< but for the error of the inverse
  IntervalVector output_error;
};

double middle(const Interval& number) { return 0.5 * (number.low + number.high); }

Transformed transformed(const Matrix& basis, const Matrix& inverse, const IntervalVector& input,
                        const IntervalVector& output) {
  const Index size = basis.rows();
  const auto at = [](Index index) { return static_cast<std::size_t>(index); };
  Transformed result{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size),
                     IntervalVector(at(size), Interval(0.0)), IntervalVector(at(size))};
  for (Index i = 0; i < size; ++i) {
    for (Index k = 0; k < size; ++k) {
      result.start[i] += inverse(i, k) * middle(input[at(k)]);
      result.output[i] += middle(output[at(k)]) * basis(k, i);
    }
  }
  IntervalVector rest(at(size));  // b − S start
  for (Index i = 0; i < size; ++i) {
    rest[at(i)] = input[at(i)];
    result.output_error[at(i)] = -Interval(result.output[i]);
    for (Index k = 0; k < size; ++k) {
      rest[at(i)] = rest[at(i)] - Interval(basis(i, k)) * result.start[k];
      result.output_error[at(i)] = result.output_error[at(i)] + output[at(k)] * basis(k, i);
    }
  }
  for (Index i = 0; i < size; ++i) {
    for (Index k = 0; k < size; ++k) {
      result.start_error[at(i)] = result.start_error[at(i)] + inverse(i, k) * rest[at(k)];
    }
  }
  return result;
}

/// Ends the parts that hardly matter any more and gives the size of the fastest other one; 0 if
/// there is none. Adds what is left of those that end to `error`.
double fastest_of(std::vector<Part>& parts, double so_far, Interval& error) {
  double fastest = 0.0;
  for (Part& part : parts) {
    if (part.is_over) continue;
    const double rest = part.rest();
    if (rest <= negligible * so_far) {
      error = error + rest;
      part.is_over = true;
    } else {
      fastest = std::max(fastest, part.size);
    }
  }
  return fastest;
}

/// ∫ or Σ of |Σ output · state| of all parts, for the block diagonal motion.
Interval integral_of(std::vector<Part>& parts, TimeKind kind) {
  const bool is_continuous = kind == TimeKind::continuous;
  Interval sum = 0.0;
  Interval error = 0.0;
  for (std::size_t i = 0; i < most_pieces; ++i) {
    const double fastest = fastest_of(parts, sum.low, error);
    if (fastest == 0.0) break;
    // Beyond 2⁵⁰ steps numbers are no longer whole.
    const double length =
        is_continuous ? stretch / fastest : std::clamp(std::floor(stretch / fastest), 1.0, 0x1p50);
    Series series;
    for (Part& part : parts) {
      if (!part.is_over) error = error + part.advance(length, series);
    }
    const Piece own = is_continuous ? Piece{0.0, 1.0} : Piece{1.0, length};
    const Interval here = integral_of_size(integrand_of(series, own), 0.0, own.span, halvings);
    sum = sum + (is_continuous ? length * here : here);
  }
  for (const Part& part : parts) {
    if (!part.is_over) error = error + part.rest();
  }
  return {(sum - error).low, (sum + error).high};
}

}  // namespace

Interval DecayingMotion::impulse_norm(const IntervalVector& input,
                                      const IntervalVector& output) const {
  const Transformed seen = transformed(basis_, inverse_, input, output);
  std::vector<Part> parts;
  for (const Block& block : blocks_) {
    Part& part = parts.emplace_back();
    part.flow = &block.flow;
    part.kind = kind_;
    part.size = block.size;
    part.rate = block.rate;
    part.state.assign(seen.start.data() + block.first, seen.start.data() + end_of(block));
    part.output.assign(seen.output.data() + block.first, seen.output.data() + end_of(block));
    part.output_size = size_of({part.output.begin(), part.output.end()});
  }
  // What the block diagonal motion leaves out.
  const Interval spread = inverse_error_ * Interval(size_of(seen.start_error));
  const std::vector<double> start_errors = norms(seen.start_error);
  const std::vector<double> output_errors = norms(seen.output_error);
  std::vector<Interval> durations;  // ≥ ∫‖ξ̂‖ dt of each block
  for (const Part& part : parts) {
    durations.push_back(Interval(size_of({part.state.begin(), part.state.end()})) / part.rate);
  }
  std::vector<double> sources;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Interval source = start_errors[i] + spread;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      source = source + couplings_[i][j] * durations[j];
    }
    sources.push_back(source.high);
  }
  const std::optional<std::vector<double>> differences = integrals(sources);
  if (!differences) return {0.0, infinity};
  Interval left_out = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    left_out = left_out + (parts[i].output_size + Interval(output_errors[i])) * (*differences)[i] +
               output_errors[i] * durations[i];
  }
  const Interval sum = integral_of(parts, kind_);
  return {std::max(0.0, (sum - left_out).low), (sum + left_out).high};
}

}  // namespace gearlash
