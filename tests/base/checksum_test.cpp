// Whatever changes, the checksum does.
#include "base/checksum.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gearlash::checksum_test {
namespace {

TEST(Checksum, SeesEveryFlippedBit) {
  const std::string text = "half past eleven, and all's well";
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string other = text;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(checksum_of(other), checksum_of(text)) << bit;
  }
}

TEST(Checksum, SeesOrderAndLength) {
  EXPECT_NE(checksum_of("12345678abcdefgh"), checksum_of("abcdefgh12345678"));
  EXPECT_NE(checksum_of("a"), checksum_of(std::string("a\0", 2)));
  EXPECT_NE(checksum_of(""), checksum_of(std::string(8, '\0')));
  EXPECT_EQ(checksum_of("abc"), checksum_of(std::string("abc")));
}

}  // namespace
}  // namespace gearlash::checksum_test
