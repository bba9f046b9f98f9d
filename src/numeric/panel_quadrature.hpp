// Integrals of what a flight or an engaged motion does, to rounding.
#pragma once

#include <functional>

namespace gearlash {

/// ∫ f over [0, duration] of a smooth sum of exponentials and sinusoids whose fastest rate is
/// `fastest`: panels that double from 1/fastest to 1, thirty Gauss points each (Boost.Math), so
/// that e^{−fastest·t} is resolved where it lives and no panel spans more than a radian elsewhere.
double panel_integral(const std::function<double(double)>& f, double duration, double fastest);

}  // namespace gearlash
