// The cycles of a drive, and motion that does not repeat, in the phase plane.
#pragma once

#include <string>

#include "general/attractors/attractors.hpp"
#include "input/servo_file.hpp"
#include "picture/picture.hpp"

namespace gearlash {

struct AttractorPicture {
  std::string title;
  const drive::ReducedDrive& drive;  ///< that was searched
  const drive::AttractorSearch& search;
  AngleUnit angle;
  bool is_normalized = false;  ///< speeds are in units of ω_n
};

/// Positions from the reference, with the speeds of both shafts. Throws OutputError.
std::string draw_attractors(const AttractorPicture& picture, PictureFormat format);

}  // namespace gearlash
