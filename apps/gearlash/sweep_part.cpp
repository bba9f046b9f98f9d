#include "sweep_part.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "input/units.hpp"
#include "output/json_values.hpp"
#include "output/output_file.hpp"

namespace gearlash {
namespace {

namespace fs = std::filesystem;

std::string whole_name(const fs::path& path) { return shown(path.string(), std::string::npos); }

fs::path target_of(const fs::path& output) {
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(output, error);
  return error ? output : resolved;
}

fs::path with_ending(fs::path path, const char* ending) { return path += ending; }

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// The lock belongs to the descriptor: that HDF5 opens, locks and closes the file does not touch
/// it.
bool lock(int descriptor) {
#ifdef F_OFD_SETLK
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
#else
  return true;
#endif
}

std::size_t count_in(const Json& record, const char* key) {
  const Json& value = record.at(key);
  if (!value.is_number_unsigned()) throw std::out_of_range(key);
  return value.get<std::size_t>();
}

std::size_t points_counted(const GridCount& count) {
  return count.solved.side_by_side + count.solved.one_by_one + count.refused;
}

}  // namespace

SweepPart::SweepPart(const fs::path& output)
    : output_(target_of(output)),
      data_(with_ending(output_, ".part")),
      record_(with_ending(output_, ".part.json")),
      shown_output_(whole_name(output)) {
  std::error_code error;
  const fs::file_status status = fs::status(output_, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InvalidInput({{"--output", shown_output_, "must be a regular file, or a new one", ""}});
  }
  hold();
  std::error_code ignored;
  is_begun_ = is_there(record_) && fs::file_size(data_, ignored) > 0;
}

void SweepPart::hold() {
  constexpr mode_t permissions = 0666;
  descriptor_ = open(data_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, permissions);
  if (descriptor_ < 0) {
    throw OutputError(whole_name(data_) +
                      ": cannot be written: " + std::generic_category().message(errno));
  }
  struct stat held {};
  struct stat named {};
  // Another sweep may have finished between the two calls, and the file have its name by now.
  const bool is_ours = lock(descriptor_) && fstat(descriptor_, &held) == 0 &&
                       stat(data_.c_str(), &named) == 0 && held.st_ino == named.st_ino;
  if (is_ours) return;
  close(descriptor_);
  throw InvalidInput(
      {{"--output", shown_output_, "must not be written by another sweep at the same time", ""}});
}

SweepPart::~SweepPart() {
  std::error_code ignored;
  if (!is_finished_ && !is_there(record_)) fs::remove(data_, ignored);
  close(descriptor_);
}

SweepRun SweepPart::read_record(const SweepFile& sweep, const Provenance& provenance) const {
  std::ifstream stream(record_, std::ios::binary);
  const Json record = Json::parse(stream, nullptr, false);
  try {
    if (record.at("provenance").at("version") != provenance.version) {
      refuse("must be of the same version of gearlash");
    }
    if (record.at("sweep") != sweep.text || count_in(record, "points") != sweep.grid.size()) {
      refuse("must be of the same sweep file");
    }
    const SweepRun run{.count = {.solved = {.side_by_side = count_in(record, "side_by_side"),
                                            .one_by_one = count_in(record, "one_by_one")},
                                 .refused = count_in(record, "refused")},
                       .points_done = count_in(record, "points_done")};
    if (run.points_done <= sweep.grid.size() && points_counted(run.count) == run.points_done) {
      return run;
    }
  } catch (const Json::exception&) {  // told below
  } catch (const std::out_of_range&) {
  }
  refuse("must say how far the sweep has come");
}

void SweepPart::remove_record() {
  std::error_code error;
  fs::remove(record_, error);
  if (error) throw OutputError(whole_name(record_) + ": cannot be removed: " + error.message());
}

void SweepPart::write_record(const SweepFile& sweep, const Provenance& provenance,
                             const SweepRun& run) {
  const Json record = {{"provenance", json_provenance(provenance)},
                       {"points", sweep.grid.size()},
                       {"points_done", run.points_done},
                       {"side_by_side", run.count.solved.side_by_side},
                       {"one_by_one", run.count.solved.one_by_one},
                       {"refused", run.count.refused},
                       {"sweep", sweep.text}};
  write_file(record_, record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void SweepPart::finish() {
  std::error_code error;
  fs::rename(data_, output_, error);
  if (error) throw OutputError(shown_output_ + ": cannot be written: " + error.message());
  is_finished_ = true;
  fs::remove(record_, error);
}

std::size_t SweepPart::bytes() const {
  constexpr std::size_t block = 512;  // as stat counts
  struct stat held {};
  return fstat(descriptor_, &held) == 0 ? static_cast<std::size_t>(held.st_blocks) * block : 0;
}

std::string SweepPart::shown_files() const {
  return shown_output_ + ".part and " + shown_output_ + ".part.json";
}

void SweepPart::refuse(const std::string& permitted) const {
  throw InvalidInput({{"--resume", shown_files(), permitted + "; remove both to start again", ""}});
}

}  // namespace gearlash
