#include "sweep_part.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <stdexcept>
#include <system_error>

#include "base/checksum.hpp"
#include "input/text_file.hpp"
#include "input/units.hpp"
#include "output/file_safety.hpp"
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

/// Marks a record as that of a sweep.
constexpr char kind[] = "unfinished gearlash sweep";
/// The state of a sweep that keeps its border has some characters for each of its points.
constexpr std::size_t largest_record = 256 * largest_sweep_file;
constexpr char unchanged[] = "must be unchanged since the sweep stopped";

std::string text_of(const Json& record) {
  return record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string hexadecimal(std::uint64_t number) { return fmt::format("{:016x}", number); }

/// Over everything except the checksum itself.
std::string checksum_of_record(Json record) {
  record.erase("checksum");
  return hexadecimal(checksum_of(text_of(record)));
}

Json read_json(const fs::path& file) {
  try {
    return Json::parse(read_text_file(file, largest_record), nullptr, false);
  } catch (const InvalidInput&) {  // unreadable: no record
    return {};
  }
}

bool is_link(const fs::path& path) {
  std::error_code ignored;
  return fs::is_symlink(fs::symlink_status(path, ignored));
}

std::size_t count_in(const Json& record, const char* key) {
  const Json& value = record.at(key);
  if (!value.is_number_unsigned()) throw std::out_of_range(key);
  return value.get<std::size_t>();
}

std::uint64_t checksum_in(const Json& record, const char* key) {
  constexpr int base = 16;
  const std::string text = record.at(key).get<std::string>();
  std::uint64_t sum = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), sum, base);
  if (error != std::errc() || end != text.data() + text.size()) throw std::out_of_range(key);
  return sum;
}

}  // namespace

std::array<fs::path, 2> unfinished_files(const fs::path& output) {
  const fs::path target = target_of(output);
  return {with_ending(target, ".part"), with_ending(target, ".part.json")};
}

SweepPart::SweepPart(const fs::path& output)
    : output_(target_of(output)),
      data_(unfinished_files(output)[0]),
      record_(unfinished_files(output)[1]),
      shown_output_(whole_name(output)) {
  std::error_code error;
  const fs::file_status status = fs::status(output_, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InvalidInput({{"--output", shown_output_, "must be a regular file, or a new one", ""}});
  }
  try {
    hold();
    require_own_files();
  } catch (...) {  // no destructor will run
    let_go();
    throw;
  }
}

void SweepPart::hold() {
  constexpr mode_t permissions = 0666;
  descriptor_ = open(data_.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0 && errno == ELOOP) refuse_foreign(data_);
  if (descriptor_ < 0 && errno == ENOENT) {
    descriptor_ = open(data_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
    may_remove_data_ = descriptor_ >= 0;
  }
  if (descriptor_ < 0 && errno != EEXIST) {
    throw OutputError(whole_name(data_) +
                      ": cannot be written: " + std::generic_category().message(errno));
  }
  struct stat held {};
  struct stat named {};
  // Another sweep may have finished between the two calls and renamed the file.
  const bool is_ours = descriptor_ >= 0 && lock_file(descriptor_) != FileLock::elsewhere &&
                       fstat(descriptor_, &held) == 0 && lstat(data_.c_str(), &named) == 0 &&
                       held.st_ino == named.st_ino;
  if (is_ours) return;
  may_remove_data_ = false;
  throw InvalidInput(
      {{"--output", shown_output_, "must not be written by another sweep at the same time", ""}});
}

/// An empty file may be used, because it has nothing to lose.
void SweepPart::require_own_files() {
  struct stat held {};
  if (fstat(descriptor_, &held) != 0 || !S_ISREG(held.st_mode)) refuse_foreign(data_);
  const bool has_record = is_link(record_) || is_there(record_);
  if (has_record) {
    const Json record = is_link(record_) ? Json() : read_json(record_);
    if (!record.is_object() || record.value("kind", Json()) != kind) refuse_foreign(record_);
  }
  if (held.st_size > 0 && !has_record) refuse_foreign(data_);
  is_begun_ = held.st_size > 0;
}

void SweepPart::let_go() noexcept {
  std::error_code ignored;
  if (may_remove_data_) fs::remove(data_, ignored);
  if (may_remove_record_) fs::remove(record_, ignored);
  if (descriptor_ >= 0) close(descriptor_);
}

SweepPart::~SweepPart() { let_go(); }

SweepRecord SweepPart::read_record(const SweepFile& sweep, const Provenance& provenance) const {
  const Json json = read_json(record_);
  try {
    if (json.at("checksum") != checksum_of_record(json)) refuse(unchanged);
    if (json.at("provenance").at("version") != provenance.version) {
      refuse("must be of the same version of gearlash");
    }
    if (json.at("sweep") != sweep.text || count_in(json, "points") != sweep.grid.size()) {
      refuse("must be of the same sweep file");
    }
    SweepRecord record{.run = {.count = {.solved = {.side_by_side = count_in(json, "side_by_side"),
                                                    .one_by_one = count_in(json, "one_by_one")},
                                         .searched = count_in(json, "searched"),
                                         .refused = count_in(json, "refused"),
                                         .unproved = count_in(json, "unproved")},
                               .points_done = count_in(json, "points_done")},
                       .checksum_of_data = checksum_in(json, "checksum_of_data"),
                       .reduced = json.value("reduced", "")};
    const SweepRun& run = record.run;
    if (run.points_done <= sweep.grid.size() && run.count.points() == run.points_done) {
      return record;
    }
  } catch (const Json::exception&) {  // reported below
  } catch (const std::out_of_range&) {
  }
  refuse(unchanged);
}

void SweepPart::write_record(const SweepFile& sweep, const Provenance& provenance,
                             const SweepRecord& record) {
  const SweepRun& run = record.run;
  Json json = {
      {"kind", kind},
      {"provenance",
       {{"program", "gearlash"}, {"version", provenance.version}, {"command", provenance.command}}},
      {"points", sweep.grid.size()},
      {"points_done", run.points_done},
      {"side_by_side", run.count.solved.side_by_side},
      {"one_by_one", run.count.solved.one_by_one},
      {"searched", run.count.searched},
      {"refused", run.count.refused},
      {"unproved", run.count.unproved},
      {"sweep", sweep.text},
      {"checksum_of_data", hexadecimal(record.checksum_of_data)}};
  if (!record.reduced.empty()) json["reduced"] = record.reduced;
  json["checksum"] = checksum_of_record(json);
  may_remove_data_ = may_remove_record_ = run.points_done == 0;
  write_file(record_, text_of(json));
}

void SweepPart::finish() {
  std::error_code error;
  fs::rename(data_, output_, error);
  if (error) throw OutputError(shown_output_ + ": cannot be written: " + error.message());
  may_remove_data_ = false;
  fs::remove(record_, error);
  bring_name_to_disk(output_);
}

void SweepPart::begin_without_data() {
  constexpr std::string_view note = "Unfinished: the record beside this file has what is known.\n";
  if (is_begun_) return;
  if (pwrite(descriptor_, note.data(), note.size(), 0) != static_cast<ssize_t>(note.size())) {
    throw OutputError(whole_name(data_) +
                      ": cannot be written: " + std::generic_category().message(errno));
  }
  is_begun_ = true;
}

void SweepPart::finish_without_data() {
  std::error_code ignored;
  fs::remove(record_, ignored);
  fs::remove(data_, ignored);
  may_remove_data_ = may_remove_record_ = false;
}

std::size_t SweepPart::bytes() const {
  constexpr std::size_t block = 512;  // as stat counts
  struct stat held {};
  return fstat(descriptor_, &held) == 0 ? static_cast<std::size_t>(held.st_blocks) * block : 0;
}

std::string SweepPart::shown_files() const {
  return shown_output_ + ".part and " + shown_output_ + ".part.json";
}

void SweepPart::refuse_foreign(const fs::path& file) const {
  throw InvalidInput({{"--output", shown_output_,
                       "must have no foreign file beside it: " + whole_name(file) +
                           " does not come from a sweep and is not touched; rename or remove it",
                       ""}});
}

void SweepPart::refuse(const std::string& permitted) const {
  throw InvalidInput({{"--resume", shown_files(), permitted + "; remove both to start again", ""}});
}

}  // namespace gearlash
