// Integrals over a flight or an engaged motion, to rounding.
#pragma once

#include <functional>

namespace gearlash {

/// ∫ f over [0, duration] of a smooth sum of exponentials and sinusoids whose fastest rate is
/// `fastest`. The panels double from 1/fastest to 1, with thirty Gauss points each (Boost.Math). So
/// they resolve e^{−fastest·t} where it matters, and no panel spans more than a radian elsewhere.
/// The first one spans neither more than 1/fastest nor more than a radian, and ten points leave out
/// less than 1e-24 of a product of two such terms there: 2²⁰ (10!)⁴/(21 (20!)³).
double panel_integral(const std::function<double(double)>& f, double duration, double fastest);

}  // namespace gearlash
