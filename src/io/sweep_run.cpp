#include "gearlash/io/sweep_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <future>
#include <memory>
#include <system_error>
#include <thread>

#include "gearlash/io/grid_netcdf.hpp"
#include "gearlash/io/large_table.hpp"
#include "gearlash/io/output_file.hpp"
#include "gearlash/io/units.hpp"
#include "json_values.hpp"

namespace gearlash {
namespace {

namespace fs = std::filesystem;

/// Points that are held in memory, written and recorded at a time: 50 MB; where faces bounce, as
/// many as keep every core busy for about a second.
std::size_t points_of_a_piece(const ServoGrid& grid) {
  constexpr std::size_t plastic = std::size_t{1} << 19U;
  constexpr std::size_t bouncing_a_core = 128;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  return grid.may_bounce() ? bouncing_a_core * cores : plastic;
}

/// A symbolic link keeps its place.
fs::path target_of(const fs::path& output) {
  std::error_code error;
  const fs::path resolved = fs::weakly_canonical(output, error);
  return error ? output : resolved;
}

/// The unfinished file, and the record of how far it has come.
struct PartFiles {
  explicit PartFiles(const fs::path& output)
      : whole(target_of(output)), data(whole), record(whole) {
    data += ".part";
    record += ".part.json";
  }
  bool exist() const { return fs::exists(data) && fs::exists(record); }
  std::string shown_data() const { return shown(data.string(), std::string::npos); }

  fs::path whole;
  fs::path data;
  fs::path record;
};

std::string record_of(const SweepFile& sweep, const Provenance& provenance, const SweepRun& run) {
  const Json record = {{"provenance", json_provenance(provenance)},
                       {"points", sweep.grid.size()},
                       {"points_done", run.points_done},
                       {"side_by_side", run.count.solved.side_by_side},
                       {"one_by_one", run.count.solved.one_by_one},
                       {"refused", run.count.refused},
                       {"sweep", sweep.text}};
  return record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

[[noreturn]] void refuse_part(const PartFiles& part, const std::string& problem) {
  throw InvalidInput({{"--resume", part.shown_data(), problem + "; remove it to start again", ""}});
}

/// How far the unfinished sweep has come.
SweepRun read_record(const PartFiles& part, const SweepFile& sweep, const Provenance& provenance) {
  std::ifstream stream(part.record, std::ios::binary);
  const Json record = Json::parse(stream, nullptr, false);
  try {
    if (record.at("provenance").at("version") != provenance.version) {
      refuse_part(part, "must be of the same version of gearlash");
    }
    if (record.at("sweep") != sweep.text || record.at("points") != sweep.grid.size()) {
      refuse_part(part, "must be of the same sweep file");
    }
    if (record.at("points_done") > sweep.grid.size()) {
      refuse_part(part, "must not be said to have more points than there are");
    }
    return {.count = {.solved = {record.at("side_by_side"), record.at("one_by_one")},
                      .refused = record.at("refused")},
            .points_done = record.at("points_done")};
  } catch (const Json::exception&) {
    refuse_part(part, "must have beside it the record of how far it has come");
  }
}

/// Makes the unfinished file, of which there must be none yet: another program may be at it.
void claim(const PartFiles& part) {
  constexpr mode_t permissions = 0666;
  const int descriptor =
      open(part.data.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
  if (descriptor >= 0) {
    close(descriptor);
    return;
  }
  if (errno == EEXIST) {
    throw InvalidInput({{"--output", shown(part.whole.string(), std::string::npos),
                         "must not have " + part.shown_data() +
                             " beside it, of which no record says how far it has come: if no other "
                             "sweep is writing it, remove it",
                         ""}});
  }
  throw OutputError(part.shown_data() +
                    ": cannot be written: " + std::generic_category().message(errno));
}

void require_room(const fs::path& output, const PartFiles& part, std::size_t bytes) {
  struct stat begun {};
  std::size_t taken = 0;
  if (stat(part.data.c_str(), &begun) == 0) {
    constexpr std::size_t block = 512;  // as stat counts
    taken = static_cast<std::size_t>(begun.st_blocks) * block;
  }
  std::error_code error;
  const fs::space_info space = fs::space(fs::absolute(part.whole).parent_path(), error);
  if (error || bytes <= taken || bytes - taken <= space.available) return;
  constexpr double gigabyte = 1e9;
  throw OutputError(fmt::format("{}: cannot be written: {:.3g} GB are wanting, {:.3g} GB are free",
                                shown(output.string(), std::string::npos),
                                static_cast<double>(bytes - taken) / gigabyte,
                                static_cast<double>(space.available) / gigabyte));
}

void rename_whole(const PartFiles& part, const fs::path& output) {
  std::error_code error;
  fs::rename(part.data, part.whole, error);
  if (error) {
    throw OutputError(shown(output.string(), std::string::npos) +
                      ": cannot be written: " + error.message());
  }
  fs::remove(part.record, error);
}

void add(GridCount& total, const GridCount& piece) {
  total.solved.side_by_side += piece.solved.side_by_side;
  total.solved.one_by_one += piece.solved.one_by_one;
  total.refused += piece.refused;
}

/// One sweep under way: while a piece is written, the next is worked out. It is the calling thread
/// that writes, because HDF5 prints its errors in all but the thread in which NetCDF was started.
class Sweeping {
 public:
  Sweeping(const SweepFile& sweep, const Provenance& provenance, const PartFiles& part,
           const std::string& shown_name, const SweepRun& begun, bool resumed)
      : sweep_(sweep),
        provenance_(provenance),
        part_(part),
        file_(open(shown_name, resumed)),
        recorded_(begun) {
    if (!resumed) record(begun);
  }

  /// What was written and recorded in the end.
  SweepRun run(const GoingOn& going_on) {
    const std::size_t points = sweep_.grid.size();
    std::size_t first = recorded_.points_done;
    if (going_on && !going_on(first)) return recorded_;
    std::future<GridCount> working;
    if (first < points) working = work_out(first, tables_[0], going_on);
    for (std::size_t index = 0; first < points; index = 1 - index) {
      const GridCount piece = working.get();
      if (piece.stopped) return recorded_;
      const CycleTable& table = tables_[index];
      const std::size_t next = first + table.rows();
      if (next < points) working = work_out(next, tables_[1 - index], going_on);
      file_.write(first, table);
      SweepRun run = recorded_;
      add(run.count, piece);
      run.points_done = next;
      record(run);
      first = next;
    }
    file_.close();
    return recorded_;
  }

 private:
  GridNetcdf open(const std::string& shown_name, bool resumed) const {
    const GridContents contents{sweep_.grid, sweep_.quantities, provenance_, sweep_.text};
    return resumed ? GridNetcdf::reopen(part_.data, shown_name, contents)
                   : GridNetcdf::create(part_.data, shown_name, contents);
  }

  /// The piece that starts with point `first`, into a table of as many rows as it has points.
  std::future<GridCount> work_out(std::size_t first, CycleTable& table, const GoingOn& going_on) {
    const std::size_t count = box_length(sweep_.grid, first, points_of_a_piece(sweep_.grid));
    if (table.rows() != count) table = large_cycle_table(count);
    return std::async(std::launch::async, [this, first, count, &table, &going_on] {
      return evaluate(
          sweep_.grid, first, count, table.columns(),
          {.going_on = [&](std::size_t done) { return !going_on || going_on(first + done); }});
    });
  }

  /// In this order, so that a record never tells of what is not on the disk.
  void record(const SweepRun& run) {
    file_.flush();
    write_file(part_.record, record_of(sweep_, provenance_, run));
    recorded_ = run;
  }

  const SweepFile& sweep_;
  const Provenance& provenance_;
  const PartFiles& part_;
  GridNetcdf file_;
  SweepRun recorded_;
  std::array<CycleTable, 2> tables_;
};

std::unique_ptr<Sweeping> begin_anew(const SweepFile& sweep, const Provenance& provenance,
                                     const PartFiles& part, const std::string& shown_name) {
  claim(part);
  try {
    return std::make_unique<Sweeping>(sweep, provenance, part, shown_name, SweepRun{}, false);
  } catch (...) {
    std::error_code ignored;
    if (!fs::exists(part.record, ignored)) fs::remove(part.data, ignored);
    throw;
  }
}

}  // namespace

SweepRun run_sweep(const SweepFile& sweep, const Provenance& provenance, const fs::path& output,
                   SweepStart start, const GoingOn& going_on) {
  const PartFiles part(output);
  const bool resumed = part.exist();
  SweepRun begun;
  if (resumed && start == SweepStart::anew) {
    throw InvalidInput({{"--output", shown(output.string(), std::string::npos),
                         "must not have an unfinished sweep beside it: --resume goes on with " +
                             part.shown_data() + ", or remove it to start again",
                         ""}});
  }
  if (resumed) begun = read_record(part, sweep, provenance);
  require_room(output, part, netcdf_bytes({sweep.grid, sweep.quantities, provenance, ""}));
  const auto sweeping =
      resumed ? std::make_unique<Sweeping>(sweep, provenance, part, output.string(), begun, true)
              : begin_anew(sweep, provenance, part, output.string());
  const SweepRun run = sweeping->run(going_on);
  if (run.points_done == sweep.grid.size()) rename_whole(part, output);
  return run;
}

}  // namespace gearlash
