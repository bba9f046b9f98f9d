// The curves of a Nyquist picture, loop gain and −1/N, traced within a window.
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "numeric/transfer_function.hpp"
#include "question/loop/describing/describing_function.hpp"

namespace gearlash {

using Complex = std::complex<double>;

/// The visible part of the complex plane. Both axes have the same scale.
struct Window {
  Complex corner;      ///< lower left
  double scale = 1.0;  ///< pixels for 1
  Complex size;        ///< pixels

  Complex on_paper(const Complex& point) const { return (point - corner) * scale; }
  Complex from_paper(const Complex& place) const { return corner + place / scale; }
  /// `margin`: pixels.
  bool holds(const Complex& point, double margin = 0.0) const {
    const Complex place = on_paper(point);
    return place.real() >= -margin && place.real() <= size.real() + margin &&
           place.imag() >= -margin && place.imag() <= size.imag() + margin;
  }
};

/// The window of that size around the points with a margin, larger on the left, where L comes from.
Window window_around(const std::vector<Complex>& points, const Complex& size);

struct TracePoint {
  double parameter;
  Complex value;
};
using Trace = std::vector<TracePoint>;

Complex loop_at(const TransferFunction& loop, double frequency);

/// The parameter is the frequency, rad/s.
Trace traced_loop(const TransferFunction& loop, const Window& window);

/// The unit of amplitude marks and the amplitude at which the curve −1/N begins.
struct AmplitudeScale {
  double unit;
  const char* name;
  double least;      ///< below it N is undefined, 0 or constant
  bool is_relative;  ///< marks are typical multiples of the unit, else round numbers
};

AmplitudeScale scale_of(const Nonlinearity& nonlinearity);

/// −1/N. Not finite if N is 0 or undefined.
Complex inverse_gain(const Nonlinearity& nonlinearity, double amplitude);

/// The parameter is the amplitude.
Trace traced_inverse_gain(const Nonlinearity& nonlinearity, const Window& window);

}  // namespace gearlash
