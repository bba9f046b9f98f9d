// A checksum at memory speed: shows that a file is what was written.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace gearlash {

/// For 64-bit words, one after the other, by the round of xxHash (Collet, 2012). Each step is one
/// to one in the word and in the sum before it. So a change within one word is always detected;
/// other changes are missed once in 2⁶⁴. It does not protect against intent.
class Checksum {
 public:
  Checksum() = default;
  /// Continues from the value of another one.
  explicit Checksum(std::uint64_t value) : value_(value) {}

  void add(std::uint64_t word) {
    constexpr std::uint64_t prime_1 = 0x9E3779B185EBCA87U;
    constexpr std::uint64_t prime_2 = 0xC2B2AE3D27D4EB4FU;
    value_ = std::rotl(value_ + word * prime_2, 31) * prime_1;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0x27D4EB2F165667C5U;
};

inline std::uint64_t checksum_of(std::string_view text) {
  Checksum sum;
  sum.add(text.size());
  for (; !text.empty(); text.remove_prefix(std::min(text.size(), sizeof(std::uint64_t)))) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data(), std::min(text.size(), sizeof(word)));
    sum.add(word);
  }
  return sum.value();
}

}  // namespace gearlash
