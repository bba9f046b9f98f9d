// Integrals of what a flight or an engaged motion does, to rounding.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>

namespace gearlash {

/// ∫ f over [0, duration] of a smooth sum of exponentials and sinusoids whose fastest rate is
/// `fastest`: panels that double from 1/fastest to 1, thirty Gauss points each (Boost.Math), so that
/// e^{−fastest·t} is resolved where it lives and no panel spans more than a radian elsewhere.
template <class Function>
double panel_integral(const Function& f, double duration, double fastest) {
  double sum = 0.0;
  double start = 0.0;
  double width = 1.0 / std::max(1.0, fastest);
  while (start < duration) {
    const double end = std::min(start + width, duration);
    sum += boost::math::quadrature::gauss<double, 30>::integrate(f, start, end);
    start = end;
    width = std::min(2.0 * width, 1.0);
  }
  return sum;
}

}  // namespace gearlash
