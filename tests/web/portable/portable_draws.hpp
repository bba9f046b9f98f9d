// Seeded numbers that have the same bits in every build.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/seeded_draws.hpp"

namespace gearlash::portable {

/// Rounded to 24 bits: exp and log of two C libraries differ in the last bits. (Not by a cast to
/// float and back: gcc 12 leaves out some pairs of such casts at -O3.)
class PortableDraws {
 public:
  explicit PortableDraws(std::uint64_t seed) : draws_(seed) {}

  double uniform(double low, double high) { return rounded(draws_.uniform(low, high)); }
  double log_uniform(double low, double high) { return rounded(draws_.log_uniform(low, high)); }
  bool happens(double probability) { return draws_.happens(probability); }

  static double rounded(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(mantissa, 24)), exponent - 24);
  }

 private:
  SeededDraws draws_;
};

}  // namespace gearlash::portable
