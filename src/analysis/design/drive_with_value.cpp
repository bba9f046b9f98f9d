#include "analysis/design/drive_with_value.hpp"

#include "analysis/grid/axis.hpp"
#include "gearlash/analyse.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

DriveWithValue with_value(Drive drive, const Axis* axis, double value, const drive::Step& step) {
  if (axis != nullptr) set_on(*axis, drive, value);
  const drive::ReducedDrive reduced = reduce(drive);
  return {.value = value,
          .answer = analyse(drive, {.proofs = false}),
          .response = drive::step_response(reduced, step.size, step.until),
          .loop = drive::loop_figures(reduced)};
}

}  // namespace gearlash
