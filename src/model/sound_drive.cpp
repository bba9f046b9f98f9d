#include "model/sound_drive.hpp"

#include <utility>

#include "base/range_check.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

SoundDrive::SoundDrive(Drive drive) : given_(std::move(drive)) {
  require_none(faults(given_, settled_));
  settled_ = with_settled_signals(std::move(settled_));
}

std::optional<SoundDrive> SoundDrive::of(Drive drive) {
  drive::ReducedDrive reduced;
  if (!faults(drive, reduced).empty()) return std::nullopt;
  return SoundDrive(std::move(drive), std::move(reduced));
}

SoundDrive::SoundDrive(Drive drive, drive::ReducedDrive reduced)
    : given_(std::move(drive)), settled_(with_settled_signals(std::move(reduced))) {}

}  // namespace gearlash
