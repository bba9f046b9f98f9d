#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <memory>
#include <system_error>

#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "output/file_safety.hpp"

namespace gearlash {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 16U;

/// A hidden file's name, stored so that a signal handler reads it without allocating or locking.
struct UnfinishedOutput {
  std::atomic<bool> taken = false;
  std::atomic<bool> exists = false;  ///< `name` is complete and the file exists
  std::array<char, PATH_MAX> name{};
};
std::array<UnfinishedOutput, 8> unfinished_outputs;

int claim_slot() {
  for (std::size_t i = 0; i < unfinished_outputs.size(); ++i) {
    if (!unfinished_outputs[i].taken.exchange(true)) return static_cast<int>(i);
  }
  return -1;
}

UnfinishedOutput& output_in(int slot) { return unfinished_outputs[static_cast<std::size_t>(slot)]; }

std::string system_message(int error) { return std::generic_category().message(error); }

bool is_regular_or_new(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  return status.type() == std::filesystem::file_type::regular ||
         status.type() == std::filesystem::file_type::not_found;
}

/// /dev/stdout and similar names may lead to a regular file that the shell has opened and keeps
/// using. Renaming another file over it would lose the shell's other output.
bool names_open_descriptor(const std::filesystem::path& path) {
  const std::string text = path.string();
  return text == "/dev/stdout" || text == "/dev/stderr" || text.starts_with("/dev/fd/") ||
         text.starts_with("/proc/");
}

/// Permissions of the file to be replaced, or those of a new file.
mode_t permissions_of(const std::filesystem::path& target) {
  struct stat existing {};
  if (stat(target.c_str(), &existing) == 0) return existing.st_mode & 0777U;
  const mode_t mask = umask(0);
  umask(mask);
  return 0666U & ~mask;
}

/// Every hidden file of `target` begins with this name; no other file is taken for one.
std::string beginning_of_hidden(const std::filesystem::path& target) {
  return "." + target.filename().string() + ".gearlash-";
}
constexpr std::string_view random_end = "XXXXXX";

/// Removes the hidden file if no program holds it: a killed program left it then.
void remove_if_left_behind(const std::filesystem::path& hidden) {
  const int descriptor = open(hidden.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat file {};
  if (fstat(descriptor, &file) == 0 && S_ISREG(file.st_mode) &&
      lock_file(descriptor) == FileLock::held) {
    unlink(hidden.c_str());
  }
  close(descriptor);
}

void remove_left_behind(const std::filesystem::path& target) {
  const std::string beginning = beginning_of_hidden(target);
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  // Not std::filesystem's iterator, which ends the program when memory is short.
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(opendir(folder.c_str()), closedir);
  while (const dirent* entry = entries == nullptr ? nullptr : readdir(entries.get())) {
    const std::string_view name = entry->d_name;
    if (name.starts_with(beginning) && name.size() == beginning.size() + random_end.size()) {
      remove_if_left_behind(folder / name);
    }
  }
}

/// Whether a new hidden file is still this program's. Before it was locked, another program may
/// have taken it for one left behind.
bool is_held(int descriptor) {
  struct stat file {};
  return lock_file(descriptor) != FileLock::elsewhere &&
         (fstat(descriptor, &file) != 0 || file.st_nlink > 0);
}

}  // namespace

std::filesystem::path destination_of(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  constexpr int most_links = 40;  // as Linux has it
  std::error_code error;
  fs::path followed = path;
  for (int i = 0; i < most_links && fs::is_symlink(followed, error); ++i) {
    const fs::path next = fs::read_symlink(followed, error);
    if (error) return path;
    followed = followed.parent_path() / next;  // `next` alone if it is absolute
  }
  const fs::path whole = fs::weakly_canonical(followed, error);
  return error ? path : whole;
}

void remove_unfinished_outputs() noexcept {
  for (UnfinishedOutput& output : unfinished_outputs) {
    if (output.exists.exchange(false)) unlink(output.name.data());
  }
}

OutputFile::OutputFile(const std::filesystem::path& path)
    : shown_name_(path == "-" ? "standard output" : shown(path.string(), std::string::npos)) {
  buffer_.reserve(buffer_size);
  try {
    open_path(path);
  } catch (...) {  // the destructor will not run
    abandon();
    throw;
  }
}

OutputFile::~OutputFile() { abandon(); }

void OutputFile::open_path(const std::filesystem::path& path) {
  if (path.empty()) {
    errno = ENOENT;
    refuse("cannot be written");
  }
  if (path == "-" || path == "/dev/stdout") {
    descriptor_ = STDOUT_FILENO;
  } else if (names_open_descriptor(path) || !is_regular_or_new(path)) {
    open_directly(path);
  } else {
    open_beside(destination_of(path));
  }
}

void OutputFile::open_directly(const std::filesystem::path& path) {
  descriptor_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) refuse("cannot be opened for writing");
  owns_descriptor_ = true;
}

void OutputFile::open_beside(const std::filesystem::path& target) {
  const std::string hidden =
      (target.parent_path() / (beginning_of_hidden(target) + std::string(random_end))).string();
  slot_ = claim_slot();
  if (slot_ < 0) throw OutputError(shown_name_ + ": too many files are being written at once");
  UnfinishedOutput& output = output_in(slot_);
  if (hidden.size() >= output.name.size()) {
    errno = ENAMETOOLONG;
    refuse("cannot be written");
  }
  remove_left_behind(target);
  do {
    if (descriptor_ >= 0) close(descriptor_);
    output.exists = false;
    std::memcpy(output.name.data(), hidden.c_str(), hidden.size() + 1);
    const SignalsHeld held;
    descriptor_ = mkostemp(output.name.data(), O_CLOEXEC);
    output.exists = descriptor_ >= 0;
  } while (descriptor_ >= 0 && !is_held(descriptor_));
  if (descriptor_ < 0) refuse("cannot be written");
  owns_descriptor_ = true;
  target_ = target;
  if (fchmod(descriptor_, permissions_of(target)) != 0) refuse("cannot be given its permissions");
}

void OutputFile::write(std::string_view text) {
  if (buffer_.size() + text.size() > buffer_size) flush();
  buffer_.append(text);
  if (buffer_.size() > buffer_size) flush();
}

void OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      if (errno == EPIPE) throw ReaderGone();
      refuse("cannot be written");
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

int OutputFile::descriptor_of_file() const {
  if (target_.empty()) {
    throw OutputError(shown_name_ +
                      ": must be a file: its format is not written from front to back");
  }
  return descriptor_;
}

void OutputFile::commit() {
  flush();
  if (!owns_descriptor_) return;
  if (!target_.empty() && fsync(descriptor_) != 0) refuse("cannot be written");
  const int closed = close(descriptor_);
  owns_descriptor_ = false;
  descriptor_ = -1;
  if (closed != 0) refuse("cannot be written");
  if (target_.empty()) return;
  UnfinishedOutput& output = output_in(slot_);
  // Nothing may fail for want of memory once the file has its name.
  const std::filesystem::path folder = folder_of(target_);
  if (std::rename(output.name.data(), target_.c_str()) != 0) refuse("cannot be written");
  output.exists = false;
  bring_names_to_disk(folder);
}

void OutputFile::refuse(const std::string& action) const {
  throw OutputError(shown_name_ + ": " + action + ": " + system_message(errno));
}

void OutputFile::abandon() noexcept {
  if (owns_descriptor_) close(descriptor_);
  if (slot_ < 0) return;
  UnfinishedOutput& output = output_in(slot_);
  if (output.exists.exchange(false)) unlink(output.name.data());
  output.taken = false;
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

std::string why_unwritable(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_fifo(path, error)) return "";
  try {
    const OutputFile tried(path);
  } catch (const OutputError& fault) {
    const std::string_view line = fault.what();
    return std::string(line.substr(line.rfind(": ") + 2));
  }
  return "";
}

void save(const std::filesystem::path& path, std::string_view text) { write_file(path, text); }

}  // namespace gearlash
