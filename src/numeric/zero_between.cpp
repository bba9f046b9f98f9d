#include "numeric/zero_between.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

namespace gearlash {

double zero_between(double low, double high, double at_low, double at_high,
                    const std::function<double(double)>& function, unsigned bits) {
  if (!(low < high)) return low;
  const boost::math::tools::eps_tolerance<double> is_close(bits);
  std::uintmax_t most = 100;
  const auto [below, above] =
      boost::math::tools::toms748_solve(function, low, high, at_low, at_high, is_close, most);
  return 0.5 * (below + above);
}

}  // namespace gearlash
