// To be preloaded: write number FAILING_WRITE of an output file fails, as on a full disk.
#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

/// Outputs are written under a hidden name, a sweep's under that of its part.
bool is_output(int descriptor) {
  char target[PATH_MAX];
  const ssize_t length =
      readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), target, sizeof target);
  const std::string_view name(target, length > 0 ? static_cast<std::size_t>(length) : 0);
  return name.find(".gearlash-") != std::string_view::npos || name.ends_with(".nc.part");
}

bool is_the_one_that_fails(int descriptor) {
  static const int failing = std::atoi(std::getenv("FAILING_WRITE"));
  static int count = 0;
  return is_output(descriptor) && ++count == failing;
}

}  // namespace

extern "C" ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  using Write = decltype(&pwrite);
  static const auto write = reinterpret_cast<Write>(dlsym(RTLD_NEXT, "pwrite"));
  if (!is_the_one_that_fails(descriptor)) return write(descriptor, bytes, size, offset);
  errno = ENOSPC;
  return -1;
}
