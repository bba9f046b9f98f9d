// gearlash map: contours over two inputs of the servo, and where hunting ends.
#include <array>
#include <memory>

#include "command.hpp"
#include "grid_options.hpp"
#include "picture/grid_map.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash map --x inertia-ratio=0.05:20:200:log --y damping=0.02:1:200 \\\n"
    "      --friction-ratio 0.2 --output hunting.svg\n"
    "  gearlash map --x friction-ratio=0:1:100 --y damping=0.05:0.8:100 --inertia-ratio 2 \\\n"
    "      --quantity period --output period.pdf\n"
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
    faults.add({fields[i], "1 value", "must be two or more; gearlash chart draws one", ""});
  }
  faults.require_none();
}

ExitStatus run(const MapOptions& options, const Provenance& provenance) {
  GridTask task = read_grid_task(options.grid, {{"--y", options.y}, {"--x", options.x}});
  task.boundary = GridBoundary::hunting;
  require_an_area(task);
  make_grid_file(task, "Map", provenance, [&](const GridTable& table, PictureFormat format) {
    return draw_contour_map(map_of(table, task.quantity), format);
  });
  return ExitStatus::done;
}

}  // namespace

void add_map_command(Command& app, Action& action) {
  const auto options = std::make_shared<MapOptions>();
  Command* command =
      app.add_subcommand("map", "contours over two inputs of the servo, and where hunting ends");
  command
      ->add_option("--x", options->x,
                   "axis: NAME=FROM:TO:COUNT, NAME=FROM:TO:COUNT:log or\n"
                   "NAME=A,B,C; an input of the servo, below")
      ->type_name("AXIS")
      ->required();
  command->add_option("--y", options->y, "axis of another input")->type_name("AXIS")->required();
  add_grid_options(*command, options->grid);
  command->footer(
      "Without --backlash sizes are in backlashes, to which they are proportional.\n\n" +
      help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
