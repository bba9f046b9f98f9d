// Central differences of sixth order.
#pragma once

#include <array>

namespace gearlash {

/// f′ ≈ Σ wₖ (f(x + kh) − f(x − kh))/h, k = 1, 2, 3; the error is h⁶ f⁽⁷⁾/140.
inline constexpr std::array<double, 3> difference_weights = {45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0};

}  // namespace gearlash
