// What the commands that work out a grid of servos share: their axes, servo, quantity and output.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "output/grid_netcdf.hpp"
#include "output/grid_table.hpp"
#include "servo_options.hpp"

namespace gearlash::cli {

/// As typed.
struct GridOptions {
  ServoOptions servo;
  std::string quantity = "size";
  std::string output;
  bool proved = false;
};

/// An axis as typed after its option, "--x".
struct AxisOption {
  std::string field;
  std::string text;
};

/// --quantity, --output and the options of the servo.
void add_grid_options(Command& command, GridOptions& options);

/// What the output is.
enum class GridFile { picture, csv, json, netcdf };

struct GridTask {
  ServoGrid grid;
  CycleQuantity quantity = CycleQuantity::size;
  GridFile kind = GridFile::csv;
  GridBoundary boundary = GridBoundary::none;
  std::string file;
};

/// What is to be worked out; without a backlash sizes are in backlashes. Throws InvalidInput with
/// all that is wrong, more points than memory has room for included.
GridTask read_grid_task(const GridOptions& options, const std::vector<AxisOption>& axes);

/// "20 servos, 18 solved side by side, 2 one by one"
std::string solved_text(const GridCount& count);

using GridPicture = std::function<std::string(const GridTable&, PictureFormat)>;

/// Works the grid out, with progress under the name `what`, and writes its file: the table, or the
/// picture drawn of it. Prints how the servos were solved.
void make_grid_file(const GridTask& task, const std::string& what, const Provenance& provenance,
                    const GridPicture& draw);

}  // namespace gearlash::cli
