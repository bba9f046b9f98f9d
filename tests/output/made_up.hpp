// A document that only tests know.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gearlash::made_up {

enum class Colour : std::uint8_t { red, dark_blue };
/// The enumerator's name with spaces.
const char* name_of(Colour colour);

/// A wheel.
struct Wheel {
  double radius = 0.0;  ///< m

  [[nodiscard]] double width() const { return 2.0 * radius; }  ///< m
};

/// A key that turns with it.
struct FeatherKey {
  double length = 0.0;  ///< m
};

using Fastening = std::variant<Wheel, FeatherKey>;

/// "gearlash/made-up/1": what has every kind of member.
struct Cart {
  Wheel wheel{};                                              ///< in front
  std::vector<Wheel> others{};                                ///< behind
  std::optional<double> mass{};                               ///< kg
  Colour colour = Colour::dark_blue;                          ///< of the paint
  std::string name{};                                         ///< as its owner calls it; else empty
  Fastening fastening = FeatherKey{};                         ///< of the wheel
  double limit = std::numeric_limits<double>::infinity();     ///< N
  double unknown = std::numeric_limits<double>::quiet_NaN();  ///< N; NaN: not measured
};

}  // namespace gearlash::made_up
