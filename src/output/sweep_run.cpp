#include "output/sweep_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/checksum.hpp"
#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "output/file_safety.hpp"
#include "output/grid_netcdf.hpp"

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

namespace {

/// The progress of an unfinished sweep.
struct SweepRecord {
  RowCount count;       ///< of the points done
  Checksum data{};      ///< of their values
  std::string command;  ///< that began it, which is written into the data
};

/// The unfinished files. While one exists, no other program can have one of the same files.
/// Existing files of these names are used only if the record shows that they come from a sweep.
/// Others, and symbolic links, are refused and not touched. A record has a checksum of itself.
class SweepPart {
 public:
  /// Throws OutputError if the files cannot be made. Throws InvalidInput if OUTPUT exists but is no
  /// regular file, if another program writes OUTPUT.part, or if a file does not come from a sweep.
  explicit SweepPart(const fs::path& output)
      : output_(destination_of(output)),
        data_(unfinished_files(output)[0]),
        record_(unfinished_files(output)[1]),
        shown_output_(whole_name(output)) {
    std::error_code error;
    const fs::file_status status = fs::status(output_, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
      refuse_output("must be a regular file, or a new one");
    }
    try {
      hold();
      require_own_files();
    } catch (...) {  // no destructor will run
      let_go();
      throw;
    }
  }
  /// Removes files without results, except those that existed before and were not begun.
  ~SweepPart() { let_go(); }
  SweepPart(const SweepPart&) = delete;
  SweepPart& operator=(const SweepPart&) = delete;

  /// Whether there is a sweep to resume.
  bool is_begun() const { return is_begun_; }
  /// Its progress. Throws InvalidInput if it is of another sweep or version, or if the record has
  /// changed.
  SweepRecord read_record(const GridContents& contents) const {
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
              .data = Checksum(json.at("checksum_of_data").get<std::uint64_t>()),
              .command = json.at("command")};
    } catch (const Json::exception&) {  // it has the checksum of a record, and is none
      refuse_changed();
    }
  }
  /// Writes the record, whole or not at all. The first one is written before the data, so that
  /// there are never data without a record.
  void write_record(const GridContents& contents, const SweepRecord& record) {
    const RowCount& count = record.count;
    Json json = {{"kind", kind},
                 {"version", contents.provenance.version},
                 {"command", contents.provenance.command},
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
  /// Gives the data their name.
  void finish() {
    std::error_code error;
    const fs::path folder = folder_of(output_);  // nothing may fail for want of memory after this
    fs::rename(data_, output_, error);
    if (error) throw OutputError(shown_output_ + ": cannot be written: " + error.message());
    may_remove_data_ = false;
    fs::remove(record_, error);
    bring_names_to_disk(folder);
  }

  const std::filesystem::path& data() const { return data_; }
  /// Of the data, open to read and write.
  int descriptor() const { return descriptor_; }
  /// Bytes of the data on the disk.
  std::size_t bytes() const {
    constexpr std::size_t block = 512;  // as stat counts
    struct stat held {};
    return fstat(descriptor_, &held) == 0 ? static_cast<std::size_t>(held.st_blocks) * block : 0;
  }
  const std::string& shown_output() const { return shown_output_; }
  /// "a.nc.part and a.nc.part.json"
  std::string shown_files() const {
    return shown_output_ + ".part and " + shown_output_ + ".part.json";
  }
  [[noreturn]] void refuse_output(const std::string& permitted) const {
    throw InvalidInput({{"--output", shown_output_, permitted, ""}});
  }
  /// Throws InvalidInput about the files.
  [[noreturn]] void refuse(const std::string& permitted) const {
    throw InvalidInput(
        {{"--resume", shown_files(), permitted + "; remove both to start again", ""}});
  }
  [[noreturn]] void refuse_changed() const { refuse("must be unchanged since the sweep stopped"); }

 private:
  void hold() {
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
    refuse_output("must not be written by another sweep at the same time");
  }
  void let_go() noexcept {
    std::error_code ignored;
    if (may_remove_data_) fs::remove(data_, ignored);
    if (may_remove_record_) fs::remove(record_, ignored);
    if (descriptor_ >= 0) close(descriptor_);
  }
  /// An empty file may be used, because it has nothing to lose.
  void require_own_files() {
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
  [[noreturn]] void refuse_foreign(const fs::path& file) const {
    refuse_output("must have no foreign file beside it: " + whole_name(file) +
                  " does not come from a sweep and is not touched; rename or remove it");
  }

  std::filesystem::path output_;  ///< a symbolic link stays in place
  std::filesystem::path data_;
  std::filesystem::path record_;
  std::string shown_output_;  ///< as it was given
  int descriptor_ = -1;       ///< of the data, locked
  bool is_begun_ = false;
  bool may_remove_data_ = false;  ///< made here, without results
  bool may_remove_record_ = false;
};

/// Points that are held in memory, written and recorded together: 50 MB.
constexpr std::size_t longest_piece = std::size_t{1} << 19U;

void require_room(const SweepPart& part, std::size_t bytes) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(part.data(), error);
  const std::size_t taken = part.bytes();
  if (error || bytes <= taken || bytes - taken <= space.available) return;
  constexpr double gigabyte = 1e9;
  throw OutputError(fmt::format("{}: cannot be written: needs {:.3g} GB, {:.3g} GB are free",
                                part.shown_output(), static_cast<double>(bytes - taken) / gigabyte,
                                static_cast<double>(space.available) / gigabyte));
}

/// Point by point, so that the checksum does not depend on the blocks.
void add(Checksum& checksum, const Table& table, const std::vector<Quantity>& quantities) {
  const auto columns = of_each(quantities, [&](Quantity quantity) { return table[quantity]; });
  for (std::size_t row = 0; row < table.rows(); ++row) {
    checksum.add(static_cast<std::uint64_t>(table.verdict(row)));
    for (const auto& column : columns) checksum.add(std::bit_cast<std::uint64_t>(column[row]));
  }
}

/// The data of an unfinished sweep, which must be those that were recorded.
GridNetcdf reopened(const SweepPart& part, const GridContents& contents,
                    const SweepRecord& recorded) {
  try {
    GridNetcdf file = GridNetcdf::reopen(part.descriptor(), part.shown_output(), contents);
    Checksum found;
    Table table;
    const std::size_t done = recorded.count.points();
    for (std::size_t first = 0; first < done; first += table.rows()) {
      table = Table(std::min(done - first, longest_piece), contents.quantities);
      file.read(first, table);
      add(found, table, contents.quantities);
    }
    if (found.value() != recorded.data.value()) part.refuse_changed();
    return file;
  } catch (const OutputError&) {
    part.refuse("must be the complete files of an unfinished sweep");
  }
}

}  // namespace

RowCount run_sweep(const SweepFile& sweep, const Provenance& provenance,
                   const std::filesystem::path& output, SweepStart start, Progress& progress,
                   const Stopwatch& seconds) {
  SweepPart part(output);
  if (part.is_begun() && start == SweepStart::anew) {
    part.refuse_output("must have no unfinished sweep beside it: continue " + part.shown_files() +
                       " with --resume, or remove both to start again");
  }
  GridContents contents{sweep.grid, sweep.quantities, provenance, sweep.text};
  SweepRecord recorded = part.is_begun() ? part.read_record(contents) : SweepRecord{};
  require_room(part, netcdf_bytes(contents));
  const bool is_new = recorded.count.points() == 0;
  if (!is_new) contents.provenance.command = recorded.command;
  if (is_new) part.write_record(contents, recorded);
  GridNetcdf file = is_new ? GridNetcdf::create(part.descriptor(), part.shown_output(), contents)
                           : reopened(part, contents, recorded);
  const RowCount count = evaluate_in_pieces(
      sweep.grid, sweep.quantities, recorded.count.points(), longest_piece,
      [&](const GridPiece& piece) {
        file.write(piece);
        file.flush();  // first, so that the record never runs ahead of the disk
        SweepRecord next = recorded;
        next.count.add(piece.count);
        add(next.data, piece.table, sweep.quantities);
        part.write_record(contents, next);
        recorded = next;
      },
      progress, seconds);
  if (count.stopped) return recorded.count;
  part.finish();
  return recorded.count;
}

}  // namespace gearlash
