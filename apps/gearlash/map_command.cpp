// gearlash map: contours over two parameters of the drive, and where hunting ends.
#include <array>
#include <memory>

#include "command.hpp"
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
    "      --output table.json\n";

struct MapOptions {
  GridOptions grid;
  std::string x;
  std::string y;
};

void require_an_area(const GridTask& task) {
  Faults faults;
  constexpr std::array fields = {"--y", "--x"};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (task.grid.axes[i].values.size() > 1) continue;
    faults.add({fields[i], "1 value",
                "must have two values or more; gearlash chart draws a single line", ""});
  }
  faults.require_none();
}

ExitStatus run(const MapOptions& options, const Provenance& provenance) {
  GridTask task =
      read_grid_task(options.grid, {{"--y", options.y}, {"--x", options.x}}, "map", {"map"});
  task.has_boundary = true;
  require_an_area(task);
  LimitedWork work(task.limits);
  return make_grid_files(task, work, provenance, [&](const GridTable& table, PictureFormat format) {
    return draw_grid_map(table, task.quantity, format);
  });
}

}  // namespace

void add_map_command(Command& app, Action& action) {
  const auto options = std::make_shared<MapOptions>();
  Command* command = app.add_subcommand(
      "map", "Draw contours over two parameters of a drive, and where hunting ends");
  command->add_option("--x", options->x, axis_help)->type_name("AXIS")->required();
  command->add_option("--y", options->y, "Set the axis of another parameter")
      ->type_name("AXIS")
      ->required();
  add_grid_options(*command, options->grid,
                   "Draw map=FILE, contours of the quantity, or its value at each point\n"
                   "if drives are searched;");
  command->footer(
      "Without --backlash, amplitudes are in backlashes, because they are proportional to it.\n\n" +
      help_footer(map_examples));
  set_action(*command, action, options, run);
}

}  // namespace gearlash::cli
