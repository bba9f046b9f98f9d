// Output files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gearlash {

/// Output could not be written; what() is one line that names the file and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program that reads our output through a pipe has closed it, which is not an error.
class ReaderGone : public std::runtime_error {
 public:
  ReaderGone() : std::runtime_error("the reader of the pipe has gone") {}
};

/// A file being written. Nothing appears under its name before commit(): the text goes to a hidden
/// file beside it (".NAME.gearlash-XXXXXX"), which commit() writes to the disk (fsync) and then
/// renames. Without commit() the hidden file is removed. Hidden files of a killed program are
/// removed by the next program that writes the same file. An existing file keeps its permissions,
/// and a symbolic link keeps its place.
///
/// Standard output ("-") and everything that is not a regular file (/dev/stdout, a pipe, a
/// terminal, a device) is written to directly.
///
/// Every member throws OutputError if the system reports an error (no such directory, no
/// permission, disk full), and ReaderGone if the reader has closed the pipe. The latter requires
/// that SIGPIPE is ignored.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// The hidden file, open to read and write, for a format that is not written from front to back
  /// with write(). Throws OutputError if the output is written to directly: there is none then.
  int descriptor_of_file() const;
  /// The file's name in messages.
  const std::string& shown_name() const { return shown_name_; }
  void commit();

 private:
  void open_path(const std::filesystem::path& path);
  void open_directly(const std::filesystem::path& path);
  void open_beside(const std::filesystem::path& target);
  void flush();
  [[noreturn]] void refuse(const std::string& action) const;
  void abandon() noexcept;

  std::string shown_name_;
  std::filesystem::path target_;  ///< commit()'s new name; empty when written directly
  int descriptor_ = -1;
  bool owns_descriptor_ = false;
  int slot_ = -1;  ///< the hidden file's index in the list of unfinished ones
  std::string buffer_;
};

/// Takes text in parts, so that a table of ten million rows is never held in memory.
using TextSink = std::function<void(std::string_view)>;

/// Writes one text with OutputFile.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Where a file of this name is written: symbolic links followed, also one whose file does not
/// exist yet. `path` itself where they lead nowhere.
std::filesystem::path destination_of(const std::filesystem::path& path);

/// Why no file of this name can be written, as "No such file or directory"; empty if one can. A
/// pipe is not tried, because its reader would see its end.
std::string why_unwritable(const std::filesystem::path& path);

/// Removes the hidden files of all unfinished outputs. It is safe in a signal handler: handlers for
/// SIGINT and SIGTERM call it before the program ends.
void remove_unfinished_outputs() noexcept;

}  // namespace gearlash
