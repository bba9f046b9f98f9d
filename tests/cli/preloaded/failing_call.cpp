// To be preloaded into the tool: call number N of a kind fails, once. FAILING_CALL="KIND N" names
// it, and the file of CALL_COUNTS has the calls of each kind, in the order of `kinds`.
//   open write fsync rename close   of an output file: no space is left on the device
//   allocate                        new, and malloc of the tool itself, from main() on
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

extern "C" void* __libc_malloc(std::size_t size);  // NOLINT: glibc's name

namespace {

enum Kind : std::size_t { opening, writing, syncing, renaming, closing, allocating };
constexpr std::array kinds = {"open", "write", "fsync", "rename", "close", "allocate"};

using Counts = std::array<std::atomic<std::uint64_t>, kinds.size()>;
Counts own_counts;
Counts* counts = &own_counts;
std::size_t failing = kinds.size();
std::uint64_t number = 0;
std::atomic<bool> in_main = false;
std::uintptr_t program_begin = 0;
std::uintptr_t program_end = 0;

int note_program(dl_phdr_info* object, std::size_t, void*) {
  program_begin = UINTPTR_MAX;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& part = object->dlpi_phdr[i];
    if (part.p_type != PT_LOAD) continue;
    const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
    if (begin < program_begin) program_begin = begin;
    if (begin + part.p_memsz > program_end) program_end = begin + part.p_memsz;
  }
  return 1;  // the first one is the program
}

[[gnu::constructor]] void begin() {
  dl_iterate_phdr(note_program, nullptr);
  if (const char* file = std::getenv("CALL_COUNTS")) {
    const int descriptor = open(file, O_RDWR | O_CLOEXEC);
    void* shared = mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (shared != MAP_FAILED) counts = static_cast<Counts*>(shared);
    close(descriptor);
  }
  if (const char* call = std::getenv("FAILING_CALL")) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const std::size_t length = std::strlen(kinds[i]);
      if (std::strncmp(call, kinds[i], length) == 0) {
        number = std::strtoull(call + length, nullptr, 10);
        failing = i;
      }
    }
  }
  unsetenv("LD_PRELOAD");  // not in gnuplot
}

bool fails(Kind kind) { return ++(*counts)[kind] == number && kind == failing; }

/// Outputs are written under a hidden name, a sweep's under that of its part.
bool is_output(const char* name) {
  const std::size_t length = std::strlen(name);
  constexpr char part[] = ".nc.part";
  constexpr std::size_t end = sizeof part - 1;
  return std::strstr(name, ".gearlash-") != nullptr ||
         (length >= end && std::strcmp(name + length - end, part) == 0);
}

bool is_output(int descriptor) {
  std::array<char, 32> link{};
  std::array<char, PATH_MAX> name{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
  return readlink(link.data(), name.data(), name.size() - 1) > 0 && is_output(name.data());
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// What a call that fails returns.
int no_space() {
  errno = ENOSPC;
  return -1;
}

bool is_lost(Kind kind) { return in_main && fails(kind); }

}  // namespace

extern "C" {

decltype(&std::signal) real_signal() { return next<decltype(std::signal)>("signal"); }

/// The first call of main().
void (*signal(int number_of_signal, void (*handler)(int)))(int) {
  in_main = true;
  return real_signal()(number_of_signal, handler);
}

int open64(const char* path, int flags, ...) {
  __builtin_va_list arguments;
  __builtin_va_start(arguments, flags);
  const unsigned mode = (flags & O_CREAT) != 0 ? __builtin_va_arg(arguments, unsigned) : 0;
  __builtin_va_end(arguments);
  static auto* const real = next<int(const char*, int, ...)>("open64");
  return is_output(path) && fails(opening) ? no_space() : real(path, flags, mode);
}

int open(const char* path, int flags, ...) {
  __builtin_va_list arguments;
  __builtin_va_start(arguments, flags);
  const unsigned mode = (flags & O_CREAT) != 0 ? __builtin_va_arg(arguments, unsigned) : 0;
  __builtin_va_end(arguments);
  return open64(path, flags, mode);
}

int mkostemp(char* path, int flags) {
  static auto* const real = next<int(char*, int)>("mkostemp");
  return is_output(path) && fails(opening) ? no_space() : real(path, flags);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  static auto* const real = next<ssize_t(int, const void*, size_t)>("write");
  return is_output(descriptor) && fails(writing) ? no_space() : real(descriptor, bytes, size);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  static auto* const real = next<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  const bool is_lost_now = is_output(descriptor) && fails(writing);
  return is_lost_now ? no_space() : real(descriptor, bytes, size, offset);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  return pwrite64(descriptor, bytes, size, offset);
}

int fsync(int descriptor) {
  static auto* const real = next<int(int)>("fsync");
  return is_output(descriptor) && fails(syncing) ? no_space() : real(descriptor);
}

int rename(const char* from, const char* to) {
  static auto* const real = next<int(const char*, const char*)>("rename");
  return is_output(from) && fails(renaming) ? no_space() : real(from, to);
}

/// The file is closed, and the call fails.
int close(int descriptor) {
  static auto* const real = next<int(int)>("close");
  const bool is_lost_now = is_output(descriptor) && fails(closing);
  const int result = real(descriptor);
  return is_lost_now ? no_space() : result;
}

void* malloc(size_t size) {
  const auto caller = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
  const bool is_own = caller >= program_begin && caller < program_end;
  if (is_own && is_lost(allocating)) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(size);
}

}  // extern "C"

void* operator new(std::size_t size) {
  void* const memory = is_lost(allocating) ? nullptr : __libc_malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return is_lost(allocating) ? nullptr : __libc_malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
