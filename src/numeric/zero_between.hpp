// The zero of a function without derivatives.
#pragma once

#include <functional>

namespace gearlash {

/// The zero of a continuous function, to so many bits, between two numbers at which its values have
/// unlike signs. Both may be the same number.
double zero_between(double low, double high, double at_low, double at_high,
                    const std::function<double(double)>& function, unsigned bits = 51);

}  // namespace gearlash
