#include "base/decimal.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace gearlash {

// libc++ 14, with which the page is compiled, reads no doubles by from_chars. There the locale is
// always that of C.
std::optional<double> nearest_double(std::string_view text) {
#ifdef __cpp_lib_to_chars
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  return value;
#else
  const double value = std::strtod(std::string(text).c_str(), nullptr);
  const std::string_view digits = text.substr(0, text.find_first_of("eE"));
  const bool vanished = value == 0.0 && digits.find_first_of("123456789") != std::string_view::npos;
  if (vanished || !std::isfinite(value)) return std::nullopt;
  return value;
#endif
}

}  // namespace gearlash
