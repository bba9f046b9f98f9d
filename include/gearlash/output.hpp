// Writes drives and answers as text; text for terminals; files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/tolerance.hpp"

namespace gearlash {

/// How a file was made, with enough detail to make it again.
struct Provenance {
  std::string command{};  ///< on one line, as typed into a shell; empty from a program
  std::string version{};  ///< of Gearlash
};

/// A file of the drive with all defaults filled in, in SI units. Numbers read back exactly.
[[nodiscard]] std::string to_toml(const Drive& drive);

/// The same with tolerances, as read_toleranced_drive() takes them. A file has one nominal value:
/// of a distribution about a value, or of lots, it is that of the distribution.
[[nodiscard]] std::string to_toml(const TolerancedDrive& drive);

/// The output of `gearlash limit-cycle --format json`.
[[nodiscard]] std::string to_json(const Drive& drive, const Answer& answer);

/// The answer in one line, as `gearlash limit-cycle` prints it, in the unit of angles of the drive:
/// "hunts: ±1.79 arcmin at 1.95 Hz (found from 20 starts)".
[[nodiscard]] std::string headline(const Drive& drive, const Answer& answer);

/// The report in full, as `gearlash limit-cycle` prints it.
[[nodiscard]] std::string to_text(const Drive& drive, const Answer& answer);

/// The answer in one line, in s.
std::ostream& operator<<(std::ostream& stream, const Answer& answer);

/// Writes a file that appears whole or not at all. Throws std::runtime_error if it cannot.
void save(const std::filesystem::path& path, std::string_view text);

// ---- text for a terminal ------------------------------------------------------------------------

/// The number of columns that the text takes; bytes that continue a UTF-8 character take none.
std::size_t width_in_columns(const std::string& text);

/// The cells of rows. A row may end early.
using TextRow = std::vector<std::string>;
using TextRows = std::vector<TextRow>;

/// Rows of cells in aligned columns, two blanks before each, no blanks at the ends of lines.
std::string table_text(const TextRows& rows);

/// The paragraph broken between words into lines of at most so many columns, each after a prefix;
/// ends with a newline.
inline constexpr std::size_t usual_columns = 92;
std::string wrapped(const std::string& paragraph, std::size_t columns = usual_columns,
                    const std::string& prefix = "");
/// The paragraph of these sentences, of which some may be empty; nothing if all are.
std::string sentences(const std::vector<std::string>& parts);
/// An empty line and the paragraph; nothing if it is empty.
std::string further_paragraph(const std::string& paragraph);

/// A text of such paragraphs and tables for a terminal of so many columns. Paragraphs are wrapped
/// again. A row that is too long is folded under its last cell; where that begins too far to the
/// right, the table is divided into groups of columns, each after the first column; a row of two
/// cells is folded between them. A command of the tool is folded for a shell, by "\\". Only a word
/// may be longer than a line. A text whose lines fit, and are no broken paragraphs, stays as it is.
std::string fitted(const std::string& text, std::size_t columns);

// ---- files --------------------------------------------------------------------------------------

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
