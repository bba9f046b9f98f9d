#include "output/file_safety.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace gearlash {

FileLock lock_file(int descriptor) {
#ifdef F_OFD_SETLK
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(descriptor, F_OFD_SETLK, &whole) == 0) return FileLock::held;
  if (errno == EAGAIN || errno == EACCES) return FileLock::elsewhere;
#else
  static_cast<void>(descriptor);
#endif
  return FileLock::unknown;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

void bring_names_to_disk(const std::filesystem::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  static_cast<void>(fsync(descriptor));
  close(descriptor);
}

}  // namespace gearlash
