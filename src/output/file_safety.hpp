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

std::filesystem::path folder_of(const std::filesystem::path& file);

/// Writes the names of a folder's files to the disk (fsync), if the system supports that.
void bring_names_to_disk(const std::filesystem::path& folder);

}  // namespace gearlash
