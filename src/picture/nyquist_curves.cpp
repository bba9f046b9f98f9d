#include "picture/nyquist_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/overloaded.hpp"
#include "question/loop/describing/harmonic_balance.hpp"

namespace gearlash {
namespace {

using Curve = std::function<Complex(double parameter)>;

/// Appends points between two points until no chord in or near the window is longer than a
/// few pixels. Intervals of the parameter are split at their geometric mean.
void refine(const Curve& curve, const Window& window, const TracePoint& from, const TracePoint& to,
            int depth, Trace& trace) {
  constexpr double near = 150.0;  // pixels
  constexpr double longest = 5.0;
  const bool is_seen = window.holds(from.value, near) || window.holds(to.value, near);
  const double length = std::abs(to.value - from.value) * window.scale;
  if (depth > 0 && is_seen && length > longest) {
    const double middle = std::sqrt(from.parameter) * std::sqrt(to.parameter);
    const TracePoint between{middle, curve(middle)};
    refine(curve, window, from, between, depth - 1, trace);
    refine(curve, window, between, to, depth - 1, trace);
    return;
  }
  trace.push_back(to);
}

Trace traced(const Curve& curve, const Window& window, double low, double high) {
  constexpr int steps = 1500;
  Trace trace = {{low, curve(low)}};
  for (int i = 1; i <= steps; ++i) {
    const double parameter = low * std::pow(high / low, static_cast<double>(i) / steps);
    refine(curve, window, TracePoint(trace.back()), {parameter, curve(parameter)}, 12, trace);
  }
  return trace;
}

}  // namespace

Window window_around(const std::vector<Complex>& points, const Complex& size) {
  Complex low = points.front();
  Complex high = points.front();
  for (const Complex& point : points) {
    low = {std::min(low.real(), point.real()), std::min(low.imag(), point.imag())};
    high = {std::max(high.real(), point.real()), std::max(high.imag(), point.imag())};
  }
  const Complex extent = high - low;
  constexpr double filled = 0.68;  // share of the frame
  const double scale =
      filled / std::max({extent.imag() / size.imag(), extent.real() / size.real(), 1e-300});
  const Complex spare = size / scale - extent;
  return {low - Complex{0.65 * spare.real(), 0.5 * spare.imag()}, scale, size};
}

Complex loop_at(const TransferFunction& loop, double frequency) {
  return frequency_response(loop, frequency).value;
}

Trace traced_loop(const TransferFunction& loop, const Window& window) {
  const Bounds range = natural_frequency_range(loop);
  return traced([&](double frequency) { return loop_at(loop, frequency); }, window, range.low,
                range.high);
}

AmplitudeScale scale_of(const Nonlinearity& nonlinearity) {
  return std::visit(Overloaded{[](const FrictionControlledBacklash& play) -> AmplitudeScale {
                                 return {0.5 * play.gap, "h", 0.5 * play.gap, true};
                               },
                               [](const InertiaControlledBacklash& play) -> AmplitudeScale {
                                 return {0.5 * play.gap, "h", play.gap / std::numbers::pi, true};
                               },
                               [](const RelayWithHysteresis& relay) -> AmplitudeScale {
                                 return {relay.half_width, "δ", relay.half_width, true};
                               },
                               [](const Saturation& saturation) -> AmplitudeScale {
                                 const double linear = saturation.limit / saturation.slope;
                                 return {linear, "T_max", linear, true};
                               },
                               [](const CoulombFriction&) -> AmplitudeScale {
                                 return {1.0, "", 0.0, false};
                               },
                               [](const DeadZone& zone) -> AmplitudeScale {
                                 return {zone.half_width, "h", zone.half_width, true};
                               }},
                    nonlinearity);
}

Complex inverse_gain(const Nonlinearity& nonlinearity, double amplitude) {
  return -1.0 / describing_gain(nonlinearity, amplitude);
}

Trace traced_inverse_gain(const Nonlinearity& nonlinearity, const Window& window) {
  const AmplitudeScale scale = scale_of(nonlinearity);
  // Without a least amplitude, −1/N is proportional to the amplitude.
  const double size = scale.least > 0.0 ? scale.least
                                        : window.size.imag() / window.scale /
                                              std::abs(inverse_gain(nonlinearity, 1.0));
  // The parameter is the amplitude's excess over the least one.
  Trace trace =
      traced([&](double excess) { return inverse_gain(nonlinearity, scale.least + excess); },
             window, 1e-8 * size, 1e6 * size);
  for (TracePoint& point : trace) point.parameter += scale.least;
  return trace;
}

}  // namespace gearlash
