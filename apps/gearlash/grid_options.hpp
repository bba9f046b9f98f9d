// Axes, drive, quantity and outputs of the commands that evaluate a grid: chart and map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "output/grid_netcdf.hpp"
#include "output/grid_table.hpp"
#include "verb.hpp"

namespace gearlash::cli {

/// As typed.
struct GridOptions : QuestionOptions {
  std::string quantity = "amplitude";
  std::string target;  ///< of a map; empty: none
  std::string output;
  bool proved = false;
};

/// An axis as typed after its option, "--x".
struct AxisOption {
  std::string field;
  std::string text;
};

/// Help of an option that takes an AXIS.
inline constexpr char axis_help[] =
    "Set the axis: PATH=FROM:TO:COUNT, PATH=FROM:TO:COUNT:log or\n"
    "PATH=A,B,C, with units; PATH is any number or choice of the drive,\n"
    "or damping, inertia-ratio, … of the normal form";

/// Precedes the examples in the help.
inline constexpr char backlashes_explanation[] =
    "Without --backlash, amplitudes are in backlashes, because they are proportional to it.\n\n";

/// --quantity, --output, --plot (whose kind draws `drawing`) and the options of the drive.
void add_grid_options(const Command& command, GridOptions& options, const std::string& drawing);

/// A table without its answers, and what to make of it.
struct GridTask : GridTable {
  std::string title{};  ///< of the work
  Quantity quantity = Quantity::amplitude;
  bool has_boundary = false;  ///< computes where hunting ends
  std::string table_file{};   ///< in .csv, .json or .nc; empty: none
  std::vector<PlotFile> plots{};
  Limits limits{};
};

/// The drive without the parameters on the axes, which no option may give. Without a backlash,
/// amplitudes are in backlashes. If not all axes could be read, one of those may be that of a
/// missing parameter, so nothing is then reported as missing.
std::optional<WrittenDrive> read_fixed_drive(const ServoOptions& options,
                                             const std::vector<AxisText>& axes, bool are_all_there,
                                             const std::vector<FileUse>& outputs, Faults& faults);

/// The task that the options describe. A normal form without a backlash has amplitudes in
/// backlashes. `kinds` are those of its pictures, that of --output first. Throws InvalidInput with
/// all faults, among them too many points for the memory.
GridTask read_grid_task(const GridOptions& options, const std::vector<AxisOption>& axes,
                        const std::string& title, const std::vector<std::string>& kinds);

/// A quantity of numbers; a fault of --quantity otherwise, and amplitude.
Quantity read_quantity(const std::string& text, Faults& faults);

/// Adds a fault for each axis of a single value. `fields` name the axes.
void require_an_area(const Grid& grid, const std::vector<std::string>& fields, Faults& faults);

/// "20 servos, 18 solved side by side, 2 one by one"
/// The first point of a grid whose drive has faults, and its fault, where any was refused: for
/// report_lines().
std::string refused_text(const Grid& grid, const RowCount& count);

std::string solved_text(const RowCount& count);

struct WorkedOut {
  GridTable table{};
  RowCount count{};
};
/// The grid's answers and its borders, with progress. What a stop leaves out is unknown.
WorkedOut work_out(const GridTask& task, LimitedWork& work, const Provenance& provenance);

using GridPlot = Plot (*)(const GridTable& table, Quantity quantity);

/// Evaluates the grid, writes its table, draws its pictures of `plot` and prints a summary. A
/// picture that fails does not withhold the rest. Points that a limit leaves out are undecided in
/// the files; a signal leaves all files as they were.
ExitStatus make_grid_files(const GridTask& task, LimitedWork& work, const Provenance& provenance,
                           GridPlot plot);

}  // namespace gearlash::cli
