// The unfinished file of a sweep, and the record of how far it has come.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "input/sweep_file.hpp"
#include "output/report_units.hpp"
#include "sweep_run.hpp"

namespace gearlash {

/// What is known of the work on an unfinished sweep.
struct SweepRecord {
  SweepRun run;
  std::uint64_t checksum_of_data = 0;
};

/// OUTPUT.part and OUTPUT.part.json, beside the file that a symbolic link leads to.
std::array<std::filesystem::path, 2> unfinished_files(const std::filesystem::path& output);

/// The unfinished files. While one exists, no other program can have one of the same
/// files. Files of these names are taken only where the record says that a sweep has left them;
/// others, and symbolic links, are refused and left alone. A record has a checksum of itself.
class SweepPart {
 public:
  /// Throws OutputError where the files cannot be made, and InvalidInput where OUTPUT is there but
  /// is no regular file, where another program writes OUTPUT.part, or where one of the files is no
  /// sweep's.
  explicit SweepPart(const std::filesystem::path& output);
  /// What holds no result is removed, unless it was there before and nothing was begun.
  ~SweepPart();
  SweepPart(const SweepPart&) = delete;
  SweepPart& operator=(const SweepPart&) = delete;

  /// Whether there is something to go on with.
  bool is_begun() const { return is_begun_; }
  /// How far that has come. Throws InvalidInput where it is of another sweep or version, or where
  /// the record is not as it was written.
  SweepRecord read_record(const SweepFile& sweep, const Provenance& provenance) const;
  /// Brought to the disk, whole or not at all. The first is written before the data are made, so
  /// that there are never data without one.
  void write_record(const SweepFile& sweep, const Provenance& provenance,
                    const SweepRecord& record);
  /// Gives the data their name.
  void finish();

  const std::filesystem::path& data() const { return data_; }
  /// Bytes that the data take on the disk.
  std::size_t bytes() const;
  const std::string& shown_output() const { return shown_output_; }
  /// "a.nc.part and a.nc.part.json"
  std::string shown_files() const;
  /// The files are not what they should be.
  [[noreturn]] void refuse(const std::string& permitted) const;

 private:
  void hold();
  void let_go() noexcept;
  void require_own_files();
  [[noreturn]] void refuse_foreign(const std::filesystem::path& file) const;

  std::filesystem::path output_;  ///< of which a symbolic link keeps its place
  std::filesystem::path data_;
  std::filesystem::path record_;
  std::string shown_output_;  ///< as it was given
  int descriptor_ = -1;       ///< of the data, locked
  bool is_begun_ = false;
  bool may_remove_data_ = false;  ///< they were made here, and hold no result
  bool may_remove_record_ = false;
};

}  // namespace gearlash
