// A drive checked and reduced once, for all that is asked of it.
#pragma once

#include <optional>

#include "gearlash/drive.hpp"
#include "model/drive.hpp"

namespace gearlash {

/// A drive without faults, and the same at the load's shaft with the final course of its signals.
class SoundDrive {
 public:
  /// Throws InvalidInput with all faults of the drive.
  SoundDrive(Drive drive);
  /// Empty for a drive with faults.
  static std::optional<SoundDrive> of(Drive drive);

  const Drive& given() const { return given_; }
  /// reduce_settled() of it.
  const drive::ReducedDrive& settled() const { return settled_; }

 private:
  SoundDrive(Drive drive, drive::ReducedDrive reduced);

  Drive given_;
  drive::ReducedDrive settled_;
};

}  // namespace gearlash
