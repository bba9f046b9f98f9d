// Protecting files from other programs and from power failures.
#pragma once

#include <filesystem>

namespace gearlash {

enum class FileLock {
  held,       ///< until the descriptor is closed or the program ends in any way
  elsewhere,  ///< another descriptor holds it
  unknown     ///< the system has no such locks here
};

/// Locks the whole file for this descriptor without waiting. The lock belongs to the descriptor: it
/// stays when HDF5 opens, locks and closes the same file.
FileLock lock_file(int descriptor);

/// Writes the file's name to the disk (fsync of its folder), if the system supports that.
void bring_name_to_disk(const std::filesystem::path& file);

}  // namespace gearlash
