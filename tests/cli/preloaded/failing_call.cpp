// To be preloaded into the tool, which then runs once for each request that it reads from its
// standard input: call `number` of a kind fails, once. Each run is a fork at the first call of
// main(), because starting the tool and its libraries takes longer than most runs. Its status goes
// to descriptor 3. The file of CALL_COUNTS has the calls of each kind, in the order of Kind.
//   open claim write fsync rename close   of an output file: no space is left on the device
//   allocate                              new, and malloc of the tool itself, from main() on
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/wait.h>
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

enum Kind : std::size_t {
  opening,
  claiming,
  writing,
  syncing,
  renaming,
  closing,
  allocating,
  kind_count
};

using Counts = std::array<std::atomic<std::uint64_t>, kind_count>;
Counts own_counts;
Counts* counts = &own_counts;

constexpr int status_descriptor = 3;

struct Request {
  std::uint64_t kind = kind_count;
  std::uint64_t number = 0;
};
Request failing;
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
  unsetenv("LD_PRELOAD");  // not in gnuplot
}

bool fails(Kind kind) { return ++(*counts)[kind] == failing.number && kind == failing.kind; }

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

bool is_own(const void* caller) {
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  return address >= program_begin && address < program_end;
}

/// In the fork, whose standard input is empty.
void begin_run(const Request& asked) {
  close(status_descriptor);
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  for (auto& count : *counts) count = 0;
  failing = asked;
  in_main = true;
}

/// Returns in each fork; the first process ends here.
void serve_requests() {
  Request asked;
  while (read(STDIN_FILENO, &asked, sizeof asked) == sizeof asked) {
    const pid_t run = fork();
    if (run == 0) return begin_run(asked);
    int status = -1;
    waitpid(run, &status, 0);
    if (write(status_descriptor, &status, sizeof status) != sizeof status) break;
  }
  _exit(EXIT_SUCCESS);
}

/// What an allocation that fails returns.
void* no_memory() {
  errno = ENOMEM;
  return nullptr;
}

}  // namespace

extern "C" {

decltype(&std::signal) real_signal() { return next<decltype(std::signal)>("signal"); }

/// The first call of main().
void (*signal(int number_of_signal, void (*handler)(int)))(int) {
  if (!in_main) serve_requests();
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

int fallocate64(int descriptor, int mode, off64_t offset, off64_t size) {
  static auto* const real = next<int(int, int, off64_t, off64_t)>("fallocate64");
  const bool is_lost_now = is_output(descriptor) && fails(claiming);
  return is_lost_now ? no_space() : real(descriptor, mode, offset, size);
}

int fallocate(int descriptor, int mode, off_t offset, off_t size) {
  return fallocate64(descriptor, mode, offset, size);
}

int ftruncate64(int descriptor, off64_t size) noexcept {
  static auto* const real = next<int(int, off64_t)>("ftruncate64");
  return is_output(descriptor) && fails(claiming) ? no_space() : real(descriptor, size);
}

int ftruncate(int descriptor, off_t size) noexcept { return ftruncate64(descriptor, size); }

/// Nobody waits for the disk.
int fsync(int descriptor) { return is_output(descriptor) && fails(syncing) ? no_space() : 0; }

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
  const bool is_own_call = is_own(__builtin_return_address(0));
  return is_own_call && is_lost(allocating) ? no_memory() : __libc_malloc(size);
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
