// Seventy-digit arithmetic, which can afford straight exponentials, and the engaged motion in it.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <optional>

namespace gearlash {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<70>>;

/// ẍ + 2ζẋ + x = 0 from (position, speed).
struct Oscillation {
  Real damping, position, speed;

  Real split() const { return sqrt(abs(damping * damping - 1)); }

  /// First time > 0 at which a position + b speed is zero; nothing if there is none.
  std::optional<Real> first_zero(const Real& a, const Real& b) const {
    const Real value = a * position + b * speed;
    const Real slope = a * speed - b * (2 * damping * speed + position);
    const Real w = split();
    if (damping < 1) {
      Real angle = atan2(-value * w, slope + damping * value);
      if (angle <= 0) angle += boost::math::constants::pi<Real>();
      return angle / w;
    }
    // x = p e^{−(ζ−w)t} + q e^{−(ζ+w)t}
    const Real p = (slope + (damping + w) * value) / (2 * w);
    const Real q = value - p;
    if (!(-q / p > 1)) return std::nullopt;
    return log(-q / p) / (2 * w);
  }

  Oscillation at(const Real& time) const {
    const Real w = split();
    const Real decay = exp(-damping * time);
    const Real c = decay * (damping < 1 ? Real(cos(w * time)) : Real(cosh(w * time)));
    const Real s = decay * (damping < 1 ? Real(sin(w * time)) : Real(sinh(w * time))) / w;
    return {damping, position * (c + damping * s) + speed * s,
            speed * (c - damping * s) - position * s};
  }
};

}  // namespace gearlash
