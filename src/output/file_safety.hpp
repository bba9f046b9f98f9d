// Protecting files from other programs, from signals and from power failures.
#pragma once

#include <csignal>
#include <filesystem>

namespace gearlash {

enum class FileLock {
  held,       ///< until the descriptor is closed or the program ends in any way
  elsewhere,  ///< another descriptor holds it
  unknown     ///< the system has no such locks here
};

/// Locks the whole file for this descriptor without waiting. The lock belongs to the descriptor: it
/// stays when the program opens and closes the same file elsewhere.
FileLock lock_file(int descriptor);

std::filesystem::path folder_of(const std::filesystem::path& file);

/// Writes the names of a folder's files to the disk (fsync), if the system supports that.
void bring_names_to_disk(const std::filesystem::path& folder);

/// Blocks signals in this thread while it lives, so that making something and recording it for
/// removal are not separated.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace gearlash
