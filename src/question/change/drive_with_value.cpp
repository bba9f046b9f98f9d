#include "question/change/drive_with_value.hpp"

#include "question/analyse.hpp"
#include "question/axis.hpp"
#include "question/change/target.hpp"

namespace gearlash {

DriveWithValue with_value(const Drive& base, const Axis* axis, double value, const Target& target,
                          Progress& progress) {
  Wanted wanted = wanted_for(target, base);
  wanted.borders = true;
  for (const Quantity cost : {Quantity::bandwidth, Quantity::overshoot}) {
    ask_for(cost, base, wanted);
  }
  Drive drive = base;
  if (axis != nullptr) set_on(*axis, drive, value);
  return {.value = value, .answer = analyse(drive, wanted, progress)};
}

}  // namespace gearlash
