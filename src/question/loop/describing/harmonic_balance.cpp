#include "question/loop/describing/harmonic_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/bracketed_root.hpp"
#include "base/extent.hpp"
#include "base/lists.hpp"

namespace gearlash {
namespace {

using Complex = std::complex<double>;

using std::numbers::pi;
constexpr double turn = 2.0 * pi;

/// The number of solutions in a range of frequencies, as far as bounds show it.
enum class Finding { none, at_most_one, unclear, flat };

// ---- Bounds

Bounds sum(const Bounds& a, const Bounds& b) { return {a.low + b.low, a.high + b.high}; }

Bounds product(const Bounds& a, const Bounds& b) {
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

bool holds_zero(const Bounds& bounds) { return bounds.low <= 0.0 && bounds.high >= 0.0; }
double width(const Bounds& bounds) { return bounds.high - bounds.low; }

/// The geometric mean: it halves the exponent of wide ranges.
double middle(const Bounds& range) { return std::sqrt(range.low) * std::sqrt(range.high); }

/// Narrowed by the mean value theorem: f = f(middle) + f′ · (ω − middle).
Bounds narrowed(const Bounds& bounds, double at_middle, const Bounds& slope, const Bounds& range) {
  const double steepest = std::max(std::abs(slope.low), std::abs(slope.high));
  const double reach = steepest * (range.high - middle(range));  // the longer part
  return {std::max(bounds.low, at_middle - reach), std::min(bounds.high, at_middle + reach)};
}

/// Function and slope bounded over a range.
struct Enclosure {
  Bounds value;
  Bounds slope;
};

/// Rounding of a sum of logarithms or angles is below this. Values within it may be 0.
constexpr double rounding = 1e-12;

Finding finding_of(const Enclosure& enclosure) {
  if (!holds_zero(enclosure.value)) return Finding::none;
  if (!holds_zero(enclosure.slope)) return Finding::at_most_one;
  const bool is_flat = enclosure.value.low > -rounding && enclosure.value.high < rounding;
  return is_flat ? Finding::flat : Finding::unclear;
}

// ---- The loop of one search

struct Loop {
  Nonlinearity nonlinearity;
  TransferFunction transfer;
  FactoredTransferFunction factors;
};

struct PhaseEnclosure {
  ResponseBounds response;
  ResponseBounds at_middle;
  Bounds phase;  ///< of −G, narrowed
};

PhaseEnclosure enclose_phase(const Loop& loop, const Bounds& range) {
  const double center = middle(range);
  PhaseEnclosure enclosure{response_bounds(loop.factors, range.low, range.high),
                           response_bounds(loop.factors, center, center),
                           {}};
  const Bounds narrow = narrowed(enclosure.response.phase, enclosure.at_middle.phase.low,
                                 enclosure.response.phase_slope, range);
  enclosure.phase = {narrow.low + pi, narrow.high + pi};
  return enclosure;
}

// ---- Without lag: the phase of −G is a multiple of a turn.

Finding finding_without_lag(const Loop& loop, const Bounds& range) {
  const PhaseEnclosure enclosure = enclose_phase(loop, range);
  const double shift = turn * std::round(0.5 * (enclosure.phase.low + enclosure.phase.high) / turn);
  const Bounds mismatch{enclosure.phase.low - shift, enclosure.phase.high - shift};
  if (width(mismatch) > pi) return Finding::unclear;
  return finding_of({mismatch, enclosure.response.phase_slope});
}

ValueAndSlope phase_mismatch(const Loop& loop, double frequency) {
  const FrequencyResponse response = frequency_response(loop.transfer, frequency);
  return {std::arg(-response.value), response.log_slope.imag()};
}

std::optional<PredictedCycle> cycle_without_lag(const Loop& loop, double frequency) {
  const FrequencyResponse response = frequency_response(loop.transfer, frequency);
  const double gain = 1.0 / std::abs(response.value);
  const std::optional<double> amplitude = amplitude_of_gain(loop.nonlinearity, gain);
  if (!amplitude) return std::nullopt;
  const bool gain_rises = std::holds_alternative<DeadZone>(loop.nonlinearity);
  const double phase_slope = response.log_slope.imag();
  return PredictedCycle{*amplitude,
                        frequency,
                        turn / frequency,
                        gain,
                        gain_rises ? phase_slope > 0.0 : phase_slope < 0.0,
                        std::abs(1.0 + gain * response.value)};
}

// ---- With lag: g(ω) = ln|N| + ln|G| at the lag that −G asks for.

/// Lags nearer to 0 or to a quarter turn cannot be distinguished from these.
constexpr double least_lag = 1e-13;
constexpr double greatest_lag = 0.25 * turn - least_lag;

/// The part of a range's lags that a nonlinearity can have.
struct Lags {
  Bounds bounds;
  bool has_all;  ///< nothing was cut off
};

std::optional<Lags> possible_lags(const Bounds& phase) {
  Bounds lags = phase;
  const double shift = turn * std::floor(phase.high / turn);
  lags.low -= shift;
  lags.high -= shift;
  if (lags.high <= least_lag || lags.low >= greatest_lag) return std::nullopt;
  const Bounds clipped{std::max(lags.low, least_lag), std::min(lags.high, greatest_lag)};
  return Lags{clipped, clipped == lags};
}

GainPoint gain_at_lag(const Nonlinearity& nonlinearity, double lag) {
  return gain_in_direction(nonlinearity, {std::cos(lag), -std::sin(lag)});
}

double log_gain(const GainPoint& point) { return std::log(std::abs(point.gain)); }

Bounds between(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

Enclosure enclose_balance(const Loop& loop, const Bounds& range, const PhaseEnclosure& phase,
                          const Bounds& lags) {
  const GainPoint first = gain_at_lag(loop.nonlinearity, lags.low);
  const GainPoint last = gain_at_lag(loop.nonlinearity, lags.high);
  const ResponseBounds& response = phase.response;
  Bounds log_response =
      narrowed(response.log_gain, phase.at_middle.log_gain.low, response.log_gain_slope, range);
  const Bounds slope = sum(product(between(first.log_slope, last.log_slope), response.phase_slope),
                           response.log_gain_slope);
  Bounds value = sum(between(log_gain(first), log_gain(last)), log_response);
  const double middle_phase = phase.at_middle.phase.low + pi;
  const double middle_lag = middle_phase - turn * std::floor(middle_phase / turn);
  if (middle_lag >= lags.low && middle_lag <= lags.high) {
    const double at_middle =
        log_gain(gain_at_lag(loop.nonlinearity, middle_lag)) + phase.at_middle.log_gain.low;
    value = narrowed(value, at_middle, slope, range);
  }
  return {value, slope};
}

Finding finding_with_lag(const Loop& loop, const Bounds& range) {
  const PhaseEnclosure phase = enclose_phase(loop, range);
  if (width(phase.phase) > 0.25 * turn) return Finding::unclear;
  const std::optional<Lags> lags = possible_lags(phase.phase);
  if (!lags) return Finding::none;
  const Finding finding = finding_of(enclose_balance(loop, range, phase, lags->bounds));
  return finding == Finding::at_most_one && !lags->has_all ? Finding::unclear : finding;
}

/// −1/G, clamped to the open fourth quadrant, which rounding may leave at the ends of a range.
Complex direction_of(const Complex& response) {
  const Complex direction = -1.0 / response;
  const double least = 1e-3 * least_lag * std::abs(direction);
  return {std::max(direction.real(), least), std::min(direction.imag(), -least)};
}

ValueAndSlope balance_mismatch(const Loop& loop, double frequency) {
  const FrequencyResponse response = frequency_response(loop.transfer, frequency);
  const GainPoint point = gain_in_direction(loop.nonlinearity, direction_of(response.value));
  return {log_gain(point) + std::log(std::abs(response.value)),
          point.log_slope * response.log_slope.imag() + response.log_slope.real()};
}

/// Moves a point along the curve to the least |1 + NG|. The lag alone is too inaccurate where it is
/// next to 0: an epsilon of ω is then many epsilons of the amplitude.
GainPoint balanced(const Nonlinearity& nonlinearity, GainPoint point, const Complex& response) {
  const Complex effect = describing_gain_slope(nonlinearity, point.amplitude) * response;
  const double move = -((1.0 + point.gain * response) / effect).real();
  constexpr double far = 1e-6;  // beyond, the slope at the rounded amplitude means nothing (A → h)
  const bool is_near = std::isfinite(std::abs(effect)) && std::abs(move) < far * point.amplitude;
  if (!is_near) return point;
  point.amplitude += move;
  point.gain += move * effect / response;
  return point;
}

std::optional<PredictedCycle> cycle_with_lag(const Loop& loop, double frequency) {
  const Complex response = frequency_response(loop.transfer, frequency).value;
  const GainPoint point = balanced(
      loop.nonlinearity, gain_in_direction(loop.nonlinearity, direction_of(response)), response);
  return PredictedCycle{point.amplitude,
                        frequency,
                        turn / frequency,
                        point.gain,
                        balance_mismatch(loop, frequency).slope < 0.0,
                        std::abs(1.0 + point.gain * response)};
}

// ---- The search

/// The frequency of the one solution, if the ends of its range have different signs. A zero counts
/// as positive, so that a solution at the common end of two ranges is found once.
template <class Function>
std::optional<double> bracketed(const Function& mismatch, const Bounds& range) {
  const bool ends_positive = mismatch(range.high).value >= 0.0;
  if ((mismatch(range.low).value >= 0.0) == ends_positive) return std::nullopt;
  return bracketed_root(mismatch, range.low, range.high, middle(range), ends_positive ? 1.0 : -1.0);
}

std::optional<PredictedCycle> cycle_in(const Loop& loop, bool lags, const Bounds& range) {
  const auto mismatch = [&](double frequency) {
    return lags ? balance_mismatch(loop, frequency) : phase_mismatch(loop, frequency);
  };
  const std::optional<double> frequency = bracketed(mismatch, range);
  if (!frequency) return std::nullopt;
  return lags ? cycle_with_lag(loop, *frequency) : cycle_without_lag(loop, *frequency);
}

/// The range without the neighbourhoods of undamped modes.
std::vector<Bounds> between_undamped_modes(const FactoredTransferFunction& factors,
                                           const Bounds& range) {
  constexpr double distance = 1e-8;
  std::vector<double> modes;
  for (const auto* roots : {&factors.zeros, &factors.poles}) {
    for (const Complex& root : *roots) {
      if (root.real() == 0.0 && root.imag() > 0.0) modes.push_back(root.imag());
    }
  }
  std::sort(modes.begin(), modes.end());
  std::vector<Bounds> parts;
  double low = range.low;
  for (const double mode : modes) {
    const double before = std::min(mode * (1.0 - distance), range.high);
    if (before > low) parts.push_back({low, before});
    low = std::max(low, mode * (1.0 + distance));
  }
  if (low < range.high) parts.push_back({low, range.high});
  return parts;
}

void add_unresolved(HarmonicBalance& found, const Bounds& range) {
  if (!found.unresolved.empty() && found.unresolved.back().high == range.low) {
    found.unresolved.back().high = range.high;
  } else {
    found.unresolved.push_back(range);
  }
}

/// Finds all solutions, by increasing frequency.
HarmonicBalance search(const Loop& loop, std::vector<Bounds> parts) {
  constexpr double narrowest = 1e-14;
  constexpr int range_limit = 1'000'000;
  const bool lags = has_lag(loop.nonlinearity);
  HarmonicBalance found;
  std::reverse(parts.begin(), parts.end());
  for (int count = 0; !parts.empty(); ++count) {
    const Bounds range = parts.back();
    parts.pop_back();
    const Finding finding = count >= range_limit ? Finding::flat
                            : lags               ? finding_with_lag(loop, range)
                                                 : finding_without_lag(loop, range);
    if (finding == Finding::none) continue;
    if (finding == Finding::at_most_one) {
      if (const auto cycle = cycle_in(loop, lags, range)) found.cycles.push_back(*cycle);
    } else if (finding == Finding::flat || width(range) <= narrowest * range.high) {
      add_unresolved(found, range);
    } else {
      const double center = middle(range);
      parts.push_back({center, range.high});
      parts.push_back({range.low, center});
    }
  }
  return found;
}

}  // namespace

HarmonicBalance harmonic_balance(const Nonlinearity& nonlinearity, const TransferFunction& loop,
                                 const Bounds& frequencies) {
  const Loop whole{nonlinearity, loop, factored(loop)};
  HarmonicBalance found = search(whole, between_undamped_modes(whole.factors, frequencies));
  sort_by(found.cycles, &PredictedCycle::amplitude);
  return found;
}

Bounds natural_frequency_range(const TransferFunction& loop) {
  constexpr double beyond = 1e6;
  const FactoredTransferFunction factors = factored(loop);
  Extent scale;
  for (const auto* roots : {&factors.zeros, &factors.poles}) {
    for (const Complex& root : *roots) {
      if (root != 0.0) scale.include(std::abs(root));
    }
  }
  if (loop.delay > 0.0) scale.include(1.0 / loop.delay);
  if (scale.high < 0.0) {
    const double order =
        static_cast<double>(factors.poles.size()) - static_cast<double>(factors.zeros.size());
    scale.include(order == 0.0 ? 1.0 : std::pow(std::abs(factors.gain), 1.0 / order));
  }
  const double high = beyond * scale.high;
  return {scale.low / beyond, loop.delay > 0.0 ? std::min(high, 100.0 * turn / loop.delay) : high};
}

/// Amplitude of the play's output, A − h; for A < 2h as h tan²(φ/2), which keeps its digits.
double load_amplitude(const FrictionControlledBacklash& backlash, const PredictedCycle& cycle) {
  const double half_gap = 0.5 * backlash.gap;
  if (cycle.amplitude >= 2.0 * half_gap) return cycle.amplitude - half_gap;
  const double angle = std::asin(std::sqrt(std::min(1.0, -pi * cycle.gain.imag())));
  const double tangent = std::tan(0.5 * angle);
  return half_gap * tangent * tangent;
}

/// The load is farthest at the input's turning point if they have met by then, otherwise where they
/// meet, at A sin c + h.
double load_amplitude(const InertiaControlledBacklash& backlash, const PredictedCycle& cycle) {
  const double cosine = 1.0 - std::sqrt(-pi * cycle.gain.imag());
  const double sine = cosine >= 0.0 ? 1.0 : std::sqrt((1.0 - cosine) * (1.0 + cosine));
  return cycle.amplitude * sine + 0.5 * backlash.gap;
}

}  // namespace gearlash
