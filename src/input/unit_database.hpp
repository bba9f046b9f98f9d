// The units that words stand for, of a table made from UDUNITS-2's database and our aliases.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearlash {

/// Powers of the base units. Radian is one of them here, though SI calls it 1.
struct UnitPowers {
  int metre = 0;
  int kilogram = 0;
  int second = 0;
  int ampere = 0;
  int radian = 0;
  bool foreign = false;  ///< kelvin, mole or candela come in, of which a servo has none

  bool operator==(const UnitPowers&) const = default;
};

struct Unit {
  double factor = 1.0;  ///< one of it in SI
  UnitPowers powers;
  bool counts_minutes = false;  ///< written with min, h, …

  Unit& multiply(const Unit& other, int power);
};

/// The units that one word stands for, prefixes included: one ("mN", "kΩ", "ozf"), or several where
/// data sheets run them together ("mNm", "gcm"), of which the last takes the power ("gcm2"). Empty
/// where there is none of that name, or one with an offset (degC) or a logarithm.
std::vector<Unit> find_units(std::string_view word);

}  // namespace gearlash
