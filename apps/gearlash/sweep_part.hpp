// The unfinished file of a sweep, and the record of its progress.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "base/checksum.hpp"
#include "output/grid_description.hpp"
#include "question/family/evaluation.hpp"

namespace gearlash {

/// The progress of an unfinished sweep.
struct SweepRecord {
  RowCount count;   ///< of the points done
  Checksum data{};  ///< of their values
};

/// OUTPUT.part and OUTPUT.part.json, beside the file that a symbolic link leads to.
std::array<std::filesystem::path, 2> unfinished_files(const std::filesystem::path& output);

/// The unfinished files. While one exists, no other program can have one of the same files.
/// Existing files of these names are used only if the record shows that they come from a sweep.
/// Others, and symbolic links, are refused and not touched. A record has a checksum of itself.
class SweepPart {
 public:
  /// Throws OutputError if the files cannot be made. Throws InvalidInput if OUTPUT exists but is no
  /// regular file, if another program writes OUTPUT.part, or if a file does not come from a sweep.
  explicit SweepPart(const std::filesystem::path& output);
  /// Removes files without results, except those that existed before and were not begun.
  ~SweepPart() { let_go(); }
  SweepPart(const SweepPart&) = delete;
  SweepPart& operator=(const SweepPart&) = delete;

  /// Whether there is a sweep to resume.
  bool is_begun() const { return is_begun_; }
  /// Its progress. Throws InvalidInput if it is of another sweep or version, or if the record has
  /// changed.
  SweepRecord read_record(const GridContents& contents) const;
  /// Writes the record, whole or not at all. The first one is written before the data, so that
  /// there are never data without a record.
  void write_record(const GridContents& contents, const SweepRecord& record);
  /// Gives the data their name.
  void finish();

  const std::filesystem::path& data() const { return data_; }
  /// Bytes of the data on the disk.
  std::size_t bytes() const;
  const std::string& shown_output() const { return shown_output_; }
  /// "a.nc.part and a.nc.part.json"
  std::string shown_files() const;
  /// Throws InvalidInput about the files.
  [[noreturn]] void refuse(const std::string& permitted) const;
  [[noreturn]] void refuse_changed() const { refuse("must be unchanged since the sweep stopped"); }

 private:
  void hold();
  void let_go() noexcept;
  void require_own_files();
  [[noreturn]] void refuse_foreign(const std::filesystem::path& file) const;

  std::filesystem::path output_;  ///< a symbolic link stays in place
  std::filesystem::path data_;
  std::filesystem::path record_;
  std::string shown_output_;  ///< as it was given
  int descriptor_ = -1;       ///< of the data, locked
  bool is_begun_ = false;
  bool may_remove_data_ = false;  ///< made here, without results
  bool may_remove_record_ = false;
};

}  // namespace gearlash
