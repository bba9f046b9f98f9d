#include "sweep_part.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "input/sweep_file.hpp"
#include "input/text_file.hpp"
#include "input/units.hpp"
#include "output/file_safety.hpp"
#include "output/output_file.hpp"

namespace gearlash {
namespace {

using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

std::string whole_name(const fs::path& path) { return shown(path.string(), std::string::npos); }

fs::path with_ending(fs::path path, const char* ending) { return path += ending; }

/// Marks a record as that of a sweep.
constexpr char kind[] = "unfinished gearlash sweep";
/// A record has the text of the sweep file, with escapes.
constexpr std::size_t largest_record = 16 * largest_sweep_file;

std::string text_of(const Json& record) {
  return record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Over everything except the checksum itself.
std::uint64_t checksum_of_record(Json record) {
  record.erase("checksum");
  return checksum_of(text_of(record));
}

Json read_json(const fs::path& file) {
  try {
    return Json::parse(read_text_file(file, largest_record), nullptr, false);
  } catch (const InvalidInput&) {  // unreadable: no record
    return {};
  }
}

}  // namespace

std::array<fs::path, 2> unfinished_files(const fs::path& output) {
  const fs::path target = destination_of(output);
  return {with_ending(target, ".part"), with_ending(target, ".part.json")};
}

SweepPart::SweepPart(const fs::path& output)
    : output_(destination_of(output)),
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
  std::error_code ignored;
  const fs::file_type type = fs::symlink_status(record_, ignored).type();
  const bool has_record = type != fs::file_type::not_found;
  if (has_record) {
    const Json record = type == fs::file_type::regular ? read_json(record_) : Json();
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

SweepRecord SweepPart::read_record(const GridContents& contents) const {
  const Json json = read_json(record_);
  try {
    if (json.at("checksum") != checksum_of_record(json)) refuse_changed();
    if (json.at("version") != contents.provenance.version) {
      refuse("must be of the same version of gearlash");
    }
    if (json.at("sweep") != contents.source_text) refuse("must be of the same sweep file");
    return {.count = {.solved = {.side_by_side = json.at("side_by_side"),
                                 .one_by_one = json.at("one_by_one")},
                      .searched = json.at("searched"),
                      .refused = json.at("refused"),
                      .unproved = json.at("unproved")},
            .data = Checksum(json.at("checksum_of_data").get<std::uint64_t>())};
  } catch (const Json::exception&) {  // it has the checksum of a record, and is none
    refuse_changed();
  }
}

void SweepPart::write_record(const GridContents& contents, const SweepRecord& record) {
  const RowCount& count = record.count;
  Json json = {{"kind", kind},
               {"version", contents.provenance.version},
               {"points", contents.grid.size()},
               {"points_done", count.points()},
               {"side_by_side", count.solved.side_by_side},
               {"one_by_one", count.solved.one_by_one},
               {"searched", count.searched},
               {"refused", count.refused},
               {"unproved", count.unproved},
               {"sweep", contents.source_text},
               {"checksum_of_data", record.data.value()}};
  json["checksum"] = checksum_of_record(json);
  may_remove_data_ = may_remove_record_ = count.points() == 0;
  write_file(record_, text_of(json));
}

void SweepPart::finish() {
  std::error_code error;
  const fs::path folder = folder_of(output_);  // nothing may fail for want of memory after this
  fs::rename(data_, output_, error);
  if (error) throw OutputError(shown_output_ + ": cannot be written: " + error.message());
  may_remove_data_ = false;
  fs::remove(record_, error);
  bring_names_to_disk(folder);
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
