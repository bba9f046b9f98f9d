#include "map_to_file.hpp"

#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <system_error>

#include "gearlash/chart/hunting_boundary.hpp"
#include "gearlash/io/grid_netcdf.hpp"
#include "gearlash/io/large_table.hpp"
#include "gearlash/version.hpp"

namespace gearlash::benchmarks {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* steps_title = "Map/steps";
constexpr const char* command_title = "Map/command";
constexpr const char* file_name = "map.nc";
constexpr const char* command_text =
    "gearlash map --x inertia-ratio=0.1111111111111111:9:1000:log --y damping=0.05:0.6:1000 "
    "--friction-ratio 0.1 --output map.nc";
/// All cores and the disk are seldom idle together.
constexpr int often = 15;

ServoGrid grid_of_map() {
  constexpr std::size_t values = 1000;
  return {.servo = {.friction_ratio = 0.1, .backlash = 1.0},
          .axes = {spaced_axis("y", Input::damping, 0.05, 0.6, values, Spacing::linear),
                   spaced_axis("x", Input::inertia_ratio, 1.0 / 9.0, 9.0, values,
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

enum class Step { memory, servos, boundary, writing, commit };
constexpr std::size_t step_count = 5;
constexpr std::array<const char*, step_count> step_names = {
    "memory for the answers, large_cycle_table()", "the servos, evaluate()",
    "the boundary, hunting_boundary()", "writing, write_grid_netcdf()",
    "to the disk and renaming, OutputFile::commit()"};

/// How long each step took, in seconds, when all of them together took least.
struct MapTimes {
  std::array<double, step_count> seconds = {};
  std::uintmax_t bytes = 0;  ///< of the file

  double of(Step step) const { return seconds[static_cast<std::size_t>(step)]; }
  double sum() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }
};

/// Memory that the map before has left is new again to the next one, as it is to a new process.
void give_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// As apps/gearlash/grid_options.cpp does it.
MapTimes make_map(const ServoGrid& grid) {
  give_memory_back();
  const TemporaryFolder folder;
  MapTimes times;
  Clock::time_point begin = Clock::now();
  const auto finish = [&](Step step) {
    const Clock::time_point end = Clock::now();
    times.seconds[static_cast<std::size_t>(step)] =
        std::chrono::duration<double>(end - begin).count();
    begin = end;
  };
  OutputFile output(folder.path() / file_name);
  GridTable table{.grid = grid,
                  .cycles = large_cycle_table(grid.size()),
                  .provenance = {command_text, version}};
  finish(Step::memory);
  evaluate(grid, 0, grid.size(), table.cycles.columns());
  finish(Step::servos);
  table.hunting_boundary = hunting_boundary(grid, table.cycles[CycleQuantity::growth_at_rest]);
  finish(Step::boundary);
  write_grid_netcdf(table, output);
  finish(Step::writing);
  output.commit();
  finish(Step::commit);
  times.bytes = fs::file_size(folder.path() / file_name);
  return times;
}

std::shared_ptr<const MapTimes> enter_steps() {
  const auto fastest = std::make_shared<MapTimes>();
  fastest->seconds.fill(std::numeric_limits<double>::infinity());
  benchmark::RegisterBenchmark(steps_title,
                               [fastest, grid = grid_of_map()](benchmark::State& state) {
                                 for (auto _ : state) {
                                   const MapTimes times = make_map(grid);
                                   state.SetIterationTime(times.sum());
                                   if (times.sum() < fastest->sum()) *fastest = times;
                                 }
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(often);
  return fastest;
}

/// The tool itself, from its start to its end.
double seconds_of_command() {
  const TemporaryFolder folder;
  const std::string line = "cd '" + folder.path().string() +
                           "' && PATH='" GEARLASH_TOOL_FOLDER "' " + command_text + " > /dev/null";
  const Clock::time_point begin = Clock::now();
  const int status = std::system(line.c_str());
  const Clock::time_point end = Clock::now();
  if (status != 0) throw std::runtime_error(line + ": failed");
  return std::chrono::duration<double>(end - begin).count();
}

void enter_command() {
  benchmark::RegisterBenchmark(command_title,
                               [](benchmark::State& state) {
                                 for (auto _ : state) state.SetIterationTime(seconds_of_command());
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(often);
}

void print(const MapTimes& map, double command) {
  constexpr double megabyte = 1e6;
  std::printf("\n**A map, from command to file** (1000 × 1000 servos, %.1f MB; by the clock)\n\n",
              static_cast<double>(map.bytes) / megabyte);
  std::printf("| | ms | share, %% |\n|---|--:|--:|\n");
  const auto line = [&](const char* name, double seconds) {
    std::printf("| %s | %.1f | %.0f |\n", name, 1e3 * seconds, 100.0 * seconds / map.sum());
  };
  for (std::size_t i = 0; i < step_count; ++i) line(step_names[i], map.seconds[i]);
  line("**all**", map.sum());
  line("computing: servos and boundary", map.of(Step::servos) + map.of(Step::boundary));
  line("writing: NetCDF and disk", map.of(Step::writing) + map.of(Step::commit));
  if (!std::isnan(command)) {
    line("the whole command as a process", command);
    std::printf("| of which writing | | %.0f |\n",
                100.0 * (map.of(Step::writing) + map.of(Step::commit)) / command);
  }
  std::printf("\n`%s`\n", command_text);
}

}  // namespace

ReportPart enter_map_to_file() {
  const std::shared_ptr<const MapTimes> fastest = enter_steps();
  enter_command();
  return [fastest](const FastestTimes& times) {
    if (std::isnan(times.of(steps_title))) return;
    print(*fastest, times.of(command_title));
  };
}

}  // namespace gearlash::benchmarks
