// gearlash sweep: a drive over up to six parameters into a NetCDF file, in little memory.
#include <fmt/format.h>

#include <filesystem>

#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "grid_options.hpp"
#include "output/sweep_run.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char sweep_examples[] =
    "  gearlash sweep examples/sweep.toml --output sweep.nc\n"
    "  gearlash sweep examples/sweep.toml --output sweep.nc --resume\n"
    "  python3 -c 'import xarray; print(xarray.open_dataset(\"sweep.nc\"))'\n";

constexpr char sweep_explanation[] =
    "SWEEP.toml has the axes, and the drive without the parameters on them:\n"
    "  [sweep]\n"
    "  axes = [\"damping=0.05:0.6:56\", \"inertia-ratio=1/9:9:100:log\"]\n"
    "  quantities = [\"amplitude\", \"period\"]   # all if left out\n"
    "  [servo]\n"
    "  friction_ratio = 0.1          # without backlash, amplitudes are in backlashes\n\n"
    "During the sweep FILE.part holds the results so far, and FILE.part.json their number. "
    "Both remain for --resume if the sweep is stopped or killed. FILE appears when it is "
    "complete. A sweep has at most 1,000,000,000 points. gearlash.distributed, in Python, goes "
    "past that, and past one machine.\n\n";

struct SweepOptions {
  std::string file;
  std::string output;
  bool resume = false;
  LimitOptions limits;
};

void require_netcdf(const std::string& output, Faults& faults) {
  if (std::filesystem::path(output).extension() == ".nc") return;
  faults.add("--output", shown(output), "must end in .nc");
}

/// The command without --resume, so that a resumed sweep writes the same file.
Provenance provenance_of(const SweepOptions& options, const Provenance& typed) {
  return {typed_command({"sweep", options.file, "--output", options.output}), typed.version};
}

void report_stop(std::size_t done, std::size_t points, const std::string& output) {
  report_lines(
      done == 0
          ? fmt::format("stopped before the first of {} points: there is nothing to resume", points)
          : fmt::format("stopped after {} of {} points, saved in {}.part; --resume continues", done,
                        points, shown(output, std::string::npos)));
}

ExitStatus run(const SweepOptions& options, const Provenance& provenance) {
  Faults faults;
  const SweepFile sweep =
      faults.collect([&] { return read_sweep_file(options.file); }, SweepFile{});
  require_netcdf(options.output, faults);
  std::vector<FileUse> outputs = {{"--output", options.output}};
  for (const std::filesystem::path& file : unfinished_files(options.output)) {
    outputs.push_back({"--output, while unfinished", file.string()});
  }
  std::vector<FileUse> inputs = files_of_tables(sweep.grid.drive, options.file);
  inputs.push_back({"SWEEP.toml", options.file});
  faults.require_distinct(std::move(inputs), outputs);
  faults.require_writable({outputs.front()});
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();

  for (const std::string& line : sweep.left_out) report_lines(line);
  LimitedWork work(limits);
  const RowCount done = run_sweep(
      sweep, provenance_of(options, provenance), options.output,
      options.resume ? SweepStart::resume : SweepStart::anew,
      TerminalProgress(work, "Sweep", sweep.grid.size(), "points").as_argument(), steady_seconds);
  if (done.points() < sweep.grid.size()) {
    report_stop(done.points(), sweep.grid.size(), options.output);
    work.end();
    return ExitStatus::undecided;
  }
  report_lines(refused_text(sweep.grid, done));
  write_file("-", shown(options.output, std::string::npos) + ": " + solved_text(done) + "\n");
  return ExitStatus::done;
}

}  // namespace

void add_sweep_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<SweepOptions>(
      app, action, "sweep", "Analyse a drive over up to six parameters, into a NetCDF file",
      sweep_explanation + help_footer(sweep_examples), run);
  command.add_option("SWEEP.toml", options.file, "Read the axes and the drive from this file",
                     {.is_required = true});
  command.add_option("--output FILE", options.output, "Write this NetCDF file (.nc)",
                     {.is_required = true});
  command.add_flag("--resume", options.resume, "Continue a sweep that was stopped or killed");
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
