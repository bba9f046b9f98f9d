// Output files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gearlash {

/// Output that could not be produced; what() is one line that names the file and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program that read our output through a pipe has had enough of it: no fault of anyone.
class ReaderGone : public std::runtime_error {
 public:
  ReaderGone() : std::runtime_error("the reader of the pipe has gone") {}
};

/// A file being written. Until commit() nothing is seen under its name: the text goes to a hidden
/// file beside it (".NAME.gearlash-XXXXXX"), which commit() brings to the disk (fsync) and then
/// renames. Without commit() the hidden file is removed; those that a killed program has left are
/// removed by the next that writes the same file. An existing file keeps its permissions, and a
/// symbolic link its place.
///
/// "-" and everything that is no regular file (/dev/stdout, a pipe, a terminal, a device) is
/// written to directly: there is no whole to wait for.
///
/// Every member throws OutputError where the system refuses (no such directory, no permission,
/// disk full), and ReaderGone where a pipe was closed at its other end, which needs SIGPIPE to be
/// ignored.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// The hidden file, for libraries that write into a file by its name, in place of write(). Throws
  /// OutputError where there is none, because the output is written to directly.
  std::filesystem::path hidden_file() const;
  /// What messages call the file.
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
  std::filesystem::path target_;  ///< what commit() renames to; empty when written directly
  int descriptor_ = -1;
  bool owns_descriptor_ = false;
  int slot_ = -1;  ///< of the hidden file in the list of unfinished ones
  std::string buffer_;
};

/// Takes text piece by piece: a table of ten million rows is never held in memory.
using TextSink = std::function<void(std::string_view)>;

/// OutputFile of one text.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Removes the hidden files of all outputs under way. Calls nothing that a signal handler may not:
/// a program that installs handlers for SIGINT and SIGTERM calls it there before it dies.
void remove_unfinished_outputs() noexcept;

}  // namespace gearlash
