// The units that words stand for, from a table made of UDUNITS-2's database and our aliases.
#pragma once

#include <string_view>
#include <vector>

namespace gearlash {

/// Powers of the base units. The radian counts as one of them, although SI calls it 1.
struct UnitPowers {
  int metre = 0;
  int kilogram = 0;
  int second = 0;
  int ampere = 0;
  int radian = 0;
  bool foreign = false;  ///< involves kelvin, mole or candela, which no servo quantity has

  bool operator==(const UnitPowers&) const = default;
};

struct Unit {
  double factor = 1.0;  ///< the unit in SI
  UnitPowers powers;
  bool counts_minutes = false;  ///< written with min, h, …
  int roundings = 0;            ///< the factor's error is at most this, in 2⁻⁵³ of it

  Unit& multiply(const Unit& other, int power);
};

/// A unit with more is refused: a value read is within AsWritten (base/number.hpp) of the one
/// written.
inline constexpr int most_roundings = 50;

/// The units that one word stands for, prefixes included: one ("mN", "kΩ", "ozf"), or several that
/// data sheets run together ("mNm", "gcm"). A power applies to the last of several ("gcm2"). Empty
/// for an unknown word, and for a unit with an offset (degC) or a logarithm.
std::vector<Unit> find_units(std::string_view word);

}  // namespace gearlash
