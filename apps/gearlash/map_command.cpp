// gearlash map: contours over two parameters of the drive, and where hunting ends.
#include "grid_options.hpp"
#include "picture/grid_map.hpp"

namespace gearlash::cli {
namespace {

constexpr char map_examples[] =
    "  gearlash map --x inertia-ratio=0.05:20:200:log --y damping=0.02:1:200 \\\n"
    "      --friction-ratio 0.2 --plot map=hunting.svg\n"
    "  gearlash map --x friction-ratio=0:1:100 --y damping=0.05:0.8:100 --inertia-ratio 2 \\\n"
    "      --quantity period --plot map=period.pdf\n"
    "  gearlash map --x damping=0.1:0.6:50 --y restitution=0:0.5:20 examples/elinco-fd162.toml \\\n"
    "      --output table.json\n"
    "  gearlash map examples/camera-head.toml --x gearbox.backlash=\"1 arcmin\":\"10 arcmin\":40 "
    "\\\n"
    "      --y controller.proportional=50:500:40 --quantity bandwidth \\\n"
    "      --target \"amplitude <= 3 arcmin and bandwidth >= 3 Hz\" --plot map=met.svg\n";

struct MapOptions {
  GridOptions grid;
  std::string x;
  std::string y;
};

ExitStatus run(const MapOptions& options, const Provenance& provenance) {
  GridTask task =
      read_grid_task(options.grid, {{"--y", options.y}, {"--x", options.x}}, "Map", {"map"});
  task.has_boundary = true;
  Faults faults;
  require_an_area(task.grid, {"--y", "--x"}, faults);
  faults.require_none();
  LimitedWork work(task.limits);
  return make_grid_files(task, work, provenance, map_plot);
}

}  // namespace

void add_map_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<MapOptions>(
      app, action, "map", "Draw contours over two parameters of a drive, and where hunting ends",
      backlashes_explanation + help_footer(map_examples), run);
  command.add_option("--x AXIS", options.x, axis_help, {.is_required = true});
  command.add_option("--y AXIS", options.y, "Set the axis of another parameter",
                     {.is_required = true});
  command.add_option("--target TARGET", options.grid.target,
                     "Shade where the target is met, with its border, and add a column target to "
                     "tables: no-hunting, \"amplitude <= 1 deg and bandwidth >= 3 Hz\", … as of "
                     "gearlash design");
  add_grid_options(command, options.grid,
                   "Draw map=FILE, contours of the quantity, or of other drives than servos as "
                   "that of 1960 its value at each point;");
}

}  // namespace gearlash::cli
