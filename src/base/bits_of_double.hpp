// The bits of a double as a whole number. std::bit_cast, which clang 14's library does not have.
#pragma once

#include <cstdint>
#include <cstring>

namespace gearlash {

/// For doubles ≥ 0 the numbers have the same order as the values.
inline std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline double double_of_bits(std::uint64_t bits) {
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace gearlash
