// The unfinished file of a sweep, and the record of how far it has come.
#pragma once

#include <filesystem>
#include <string>

#include "input/sweep_file.hpp"
#include "output/report_units.hpp"
#include "sweep_run.hpp"

namespace gearlash {

/// OUTPUT.part and OUTPUT.part.json. While one exists, no other program can have one of the same
/// files.
class SweepPart {
 public:
  /// Throws OutputError where the files cannot be made, and InvalidInput where OUTPUT is there but
  /// is no regular file, or another program writes OUTPUT.part.
  explicit SweepPart(const std::filesystem::path& output);
  /// What has no record is removed.
  ~SweepPart();
  SweepPart(const SweepPart&) = delete;
  SweepPart& operator=(const SweepPart&) = delete;

  /// Whether there is something to go on with.
  bool is_begun() const { return is_begun_; }
  /// How far that has come. Throws InvalidInput where it is of another sweep or version, or where
  /// the record makes no sense.
  SweepRun read_record(const SweepFile& sweep, const Provenance& provenance) const;
  /// Of an earlier sweep: before the data are made anew.
  void remove_record();
  /// Brought to the disk, whole or not at all.
  void write_record(const SweepFile& sweep, const Provenance& provenance, const SweepRun& run);
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

  std::filesystem::path output_;  ///< of which a symbolic link keeps its place
  std::filesystem::path data_;
  std::filesystem::path record_;
  std::string shown_output_;  ///< as it was given
  int descriptor_ = -1;       ///< of the data, locked
  bool is_begun_ = false;
  bool is_finished_ = false;
};

}  // namespace gearlash
