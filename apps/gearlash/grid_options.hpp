// What the commands that work out a grid of drives share: axes, drive, quantity and outputs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "output/grid_netcdf.hpp"
#include "output/grid_table.hpp"
#include "plot_option.hpp"
#include "servo_options.hpp"

namespace gearlash::cli {

/// As typed.
struct GridOptions {
  ServoOptions servo;
  std::string quantity = "amplitude";
  std::string output;
  std::vector<std::string> plots;
  bool proved = false;
};

/// An axis as typed after its option, "--x".
struct AxisOption {
  std::string field;
  std::string text;
};

/// What an AXIS is, for --help.
inline constexpr char axis_help[] =
    "axis: PATH=FROM:TO:COUNT, PATH=FROM:TO:COUNT:log or\n"
    "PATH=A,B,C, with units; any number or word of the drive,\n"
    "or damping, inertia-ratio, … of the normal form";

/// --quantity, --output, --plot (whose kind draws `drawing`) and the options of the drive.
void add_grid_options(Command& command, GridOptions& options, const std::string& drawing);

struct GridTask {
  std::string verb;  ///< "chart", "map"
  Grid grid;
  Quantity quantity = Quantity::amplitude;
  bool has_boundary = false;  ///< with where hunting ends
  std::string table;          ///< file in .csv, .json or .nc; empty: none
  std::vector<Plot> plots;
};

/// What is to be worked out; a normal form without a backlash has amplitudes in backlashes. `kind`:
/// of its pictures. Throws InvalidInput with all that is wrong, more points than memory has room
/// for included.
GridTask read_grid_task(const GridOptions& options, const std::vector<AxisOption>& axes,
                        const std::string& verb, const std::string& kind);

/// "20 servos, 18 solved side by side, 2 one by one"
std::string solved_text(const GridCount& count);

using GridPicture = std::function<std::string(const GridTable&, PictureFormat)>;

/// Works the grid out, writes its table and draws its pictures with `draw`, and says so. A picture
/// that fails withholds nothing else.
ExitStatus make_grid_files(const GridTask& task, const Provenance& provenance,
                           const GridPicture& draw);

}  // namespace gearlash::cli
