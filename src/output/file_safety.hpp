// What keeps files safe from other programs and from power failures.
#pragma once

#include <filesystem>

namespace gearlash {

enum class FileLock {
  held,       ///< until the descriptor is closed, or the program ends, however it ends
  elsewhere,  ///< another descriptor has it
  unknown     ///< the system has no such locks here
};

/// Takes the whole file for this descriptor alone, and does not wait for it. The lock belongs to
/// the descriptor: that HDF5 opens, locks and closes the same file does not touch it.
FileLock lock_file(int descriptor);

/// Brings the name of a file to the disk (fsync of its folder), as far as the system knows how.
void bring_name_to_disk(const std::filesystem::path& file);

}  // namespace gearlash
