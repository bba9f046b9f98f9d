#include "map_to_file.hpp"

#include <stdlib.h>
#include <sys/resource.h>
#include <sys/time.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "gearlash/output.hpp"
#include "gearlash/version.hpp"
#include "output/grid_netcdf.hpp"
#include "question/map/grid_pieces.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash::benchmarks {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* title = "Map/to file";
constexpr const char* file_name = "map.nc";
constexpr const char* command_text =
    "gearlash map --x inertia-ratio=0.1111111111111111:9:1000:log --y damping=0.05:0.6:1000 "
    "--friction-ratio 0.1 --output map.nc";
/// All cores and the disk are seldom idle together.
constexpr int often = 15;

Grid grid_of_map() {
  constexpr std::size_t values = 1000;
  return {.drive = normal_form(0.0, 1.0, 0.1, 1.0),
          .axes = {spaced_axis("y", "servo.damping", 0.05, 0.6, values, Spacing::linear),
                   spaced_axis("x", "servo.inertia_ratio", 1.0 / 9.0, 9.0, values,
                               Spacing::logarithmic)}};
}

/// A new folder, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "gearlash-map.XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), name);
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What something took, in seconds: by the clock, and of all processors together.
struct Spent {
  double clock = std::numeric_limits<double>::infinity();
  double processors = 0.0;

  Spent operator+(const Spent& other) const {
    return {clock + other.clock, processors + other.processors};
  }
  Spent operator-(const Spent& other) const {
    return {clock - other.clock, processors - other.processors};
  }
};

double seconds_of(const timeval& time) {
  constexpr double microsecond = 1e-6;
  return static_cast<double>(time.tv_sec) + microsecond * static_cast<double>(time.tv_usec);
}

/// `whose`: RUSAGE_SELF, or RUSAGE_CHILDREN for the processes that it has waited for.
template <class Work>
Spent spent_on(const Work& work, int whose = RUSAGE_SELF) {
  const auto of_processors = [&] {
    rusage usage{};
    getrusage(whose, &usage);
    return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  };
  const double processors = of_processors();
  const Clock::time_point begin = Clock::now();
  work();
  const std::chrono::duration<double> clock = Clock::now() - begin;
  return {clock.count(), of_processors() - processors};
}

/// The fastest of several, each by itself.
struct MapTimes {
  Spent servos;    ///< all pieces, which nobody writes
  Spent boundary;  ///< hunting_boundary() of them
  Spent file;      ///< both and writing
  Spent commit;    ///< to the disk, and renaming
  Spent command;   ///< the tool itself, from its start to its end
  std::uintmax_t bytes = 0;

  Spent computing() const { return servos + boundary; }
  Spent whole() const { return file + commit; }
};

/// What the map before has left is given back, so that it is new again to the next one, as it is
/// to a new process.
void give_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void keep_faster(Spent& fastest, const Spent& other) {
  if (other.clock < fastest.clock) fastest = other;
}

constexpr std::size_t points_at_a_time = std::size_t{1} << 15U;  // as `gearlash map` does

void compute_only(const Grid& grid, MapTimes& fastest) {
  give_memory_back();
  std::vector<double> growth;
  growth.reserve(grid.size());
  keep_faster(fastest.servos, spent_on([&] {
                evaluate_in_pieces(grid, solved_quantities, 0, points_at_a_time,
                                   [&](const GridPiece& piece) {
                                     const auto& column = piece.table[Quantity::growth_at_rest];
                                     growth.insert(growth.end(), column.begin(), column.end());
                                   });
              }));
  keep_faster(fastest.boundary,
              spent_on([&] { benchmark::DoNotOptimize(hunting_boundary(grid, growth)); }));
}

void make_file(const Grid& grid, MapTimes& fastest) {
  give_memory_back();
  const TemporaryFolder folder;
  OutputFile output(folder.path() / file_name);
  const Spent file = spent_on([&] {
    const std::vector<Quantity> quantities(solved_quantities.begin(), solved_quantities.end());
    GridNetcdf netcdf = GridNetcdf::create(
        output.descriptor_of_file(), output.shown_name(),
        {.grid = grid, .quantities = quantities, .provenance = {command_text, version}});
    std::vector<double> growth;
    growth.reserve(grid.size());
    evaluate_in_pieces(grid, quantities, 0, points_at_a_time, [&](const GridPiece& piece) {
      netcdf.write(piece);
      const auto& column = piece.table[Quantity::growth_at_rest];
      growth.insert(growth.end(), column.begin(), column.end());
    });
    netcdf.write_boundary(hunting_boundary(grid, growth));
  });
  const Spent commit = spent_on([&] { output.commit(); });
  if ((file + commit).clock < fastest.whole().clock) {
    fastest.file = file;
    fastest.commit = commit;
  }
  fastest.bytes = fs::file_size(folder.path() / file_name);
}

void call_tool(MapTimes& fastest) {
  const TemporaryFolder folder;
  const std::string line = "cd '" + folder.path().string() +
                           "' && PATH='" GEARLASH_TOOL_FOLDER "' " + command_text + " > /dev/null";
  keep_faster(fastest.command, spent_on(
                                   [&] {
                                     if (std::system(line.c_str()) != 0) {
                                       throw std::runtime_error(line + ": failed");
                                     }
                                   },
                                   RUSAGE_CHILDREN));
}

void print(const MapTimes& map) {
  constexpr double megabyte = 1e6;
  std::printf("\n**A map, from command to file** (1000 × 1000 servos, %.1f MB)\n\n",
              static_cast<double>(map.bytes) / megabyte);
  std::printf(
      "| | by the clock, ms | share, %% | of processors, ms | share, %% |\n"
      "|---|--:|--:|--:|--:|\n");
  const auto line = [&](const char* name, const Spent& spent) {
    constexpr double percent = 100.0;
    std::printf("| %s | %.1f | %.0f | %.1f | %.0f |\n", name, 1e3 * spent.clock,
                percent * spent.clock / map.whole().clock, 1e3 * spent.processors,
                percent * spent.processors / map.whole().processors);
  };
  line("the servos, evaluate_in_pieces()", map.servos);
  line("the boundary, hunting_boundary()", map.boundary);
  line("**computing**, both", map.computing());
  line("the same while it is written", map.file);
  line("to the disk and renaming, OutputFile::commit()", map.commit);
  line("**the whole map**, both", map.whole());
  line("**writing**: what it takes longer than computing", map.whole() - map.computing());
  line("the whole command as a process", map.command);
  std::printf("\n`%s`\n", command_text);
}

}  // namespace

ReportPart enter_map_to_file() {
  const auto fastest = std::make_shared<MapTimes>();
  benchmark::RegisterBenchmark(title,
                               [fastest, grid = grid_of_map()](benchmark::State& state) {
                                 for (auto _ : state) {
                                   compute_only(grid, *fastest);
                                   make_file(grid, *fastest);
                                   call_tool(*fastest);
                                 }
                               })
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1)
      ->Repetitions(often);
  return [fastest](const FastestTimes& times) {
    if (!std::isnan(times.of(title))) print(*fastest);
  };
}

}  // namespace gearlash::benchmarks
