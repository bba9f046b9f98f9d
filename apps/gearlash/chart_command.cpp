// gearlash chart: a family of curves over any input of the servo.
#include <memory>

#include "command.hpp"
#include "grid_options.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash chart --x inertia-ratio=1/9:9:200:log --curves damping=0.1:0.6:6 \\\n"
    "      --friction-ratio 0.1 --backlash 0.3 --output figure-7.svg\n"
    "  gearlash chart --x friction-ratio=0:1:101 --curves inertia-ratio=1/4,1,4 \\\n"
    "      --damping 0.1 --quantity period --output period.pdf\n"
    "  gearlash chart --x restitution=0:0.5:51 examples/elinco-fd162.toml --output table.csv\n";

struct ChartOptions {
  GridOptions grid;
  std::string x;
  std::string curves;
};

ExitStatus run(const ChartOptions& options, const Provenance& provenance) {
  std::vector<AxisOption> axes;
  if (!options.curves.empty()) axes.push_back({"--curves", options.curves});
  axes.push_back({"--x", options.x});
  const GridTask task = read_grid_task(options.grid, axes);
  make_grid_file(task, "Chart", provenance, [&](const GridTable& table, PictureFormat format) {
    return draw_line_chart(chart_of(table, task.quantity), format);
  });
  return ExitStatus::done;
}

}  // namespace

void add_chart_command(Command& app, Action& action) {
  const auto options = std::make_shared<ChartOptions>();
  Command* command = app.add_subcommand("chart", "a family of curves over any input of the servo");
  command
      ->add_option("--x", options->x,
                   "axis: NAME=FROM:TO:COUNT, NAME=FROM:TO:COUNT:log or\n"
                   "NAME=A,B,C; an input of the servo, below")
      ->type_name("AXIS")
      ->required();
  command->add_option("--curves", options->curves, "a curve for each value of this axis")
      ->type_name("AXIS");
  add_grid_options(*command, options->grid);
  command->footer(
      "Without --backlash sizes are in backlashes, to which they are proportional.\n\n" +
      help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
