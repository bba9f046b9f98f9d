#include "numeric/panel_quadrature.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>

namespace gearlash {

double panel_integral(const std::function<double(double)>& f, double duration, double fastest) {
  double sum = 0.0;
  double start = 0.0;
  double width = 1.0 / std::max(1.0, fastest);
  while (start < duration) {
    const double end = std::min(start + width, duration);
    sum += end * std::max(1.0, fastest) <= 1.0
               ? boost::math::quadrature::gauss<double, 10>::integrate(f, start, end)
               : boost::math::quadrature::gauss<double, 30>::integrate(f, start, end);
    start = end;
    width = std::min(2.0 * width, 1.0);
  }
  return sum;
}

}  // namespace gearlash
