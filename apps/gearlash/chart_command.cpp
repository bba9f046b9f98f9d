// gearlash chart: a family of curves over any parameters of the drive.
#include <memory>

#include "command.hpp"
#include "grid_options.hpp"
#include "picture/grid_chart.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash chart --x inertia-ratio=1/9:9:200:log --curves damping=0.1:0.6:6 \\\n"
    "      --friction-ratio 0.1 --backlash 0.3 --plot curves=figure-7.svg\n"
    "  gearlash chart --x friction-ratio=0:1:101 --curves inertia-ratio=1/4,1,4 \\\n"
    "      --damping 0.1 --quantity period --plot curves=period.pdf\n"
    "  gearlash chart --x restitution=0:0.5:51 examples/elinco-fd162.toml --output table.csv\n"
    "  gearlash chart --x controller.proportional=\"0.5 V/deg:2 V/deg:4:log\" \\\n"
    "      examples/robot-joint.toml --plot curves=gain.svg --output gain.csv\n";

struct ChartOptions {
  GridOptions grid;
  std::string x;
  std::string curves;
};

ExitStatus run(const ChartOptions& options, const Provenance& provenance) {
  std::vector<AxisOption> axes;
  if (!options.curves.empty()) axes.push_back({"--curves", options.curves});
  axes.push_back({"--x", options.x});
  const GridTask task = read_grid_task(options.grid, axes, "chart", "curves");
  return make_grid_files(task, provenance, [&](const GridTable& table, PictureFormat format) {
    return draw_line_chart(chart_of(table, task.quantity), format);
  });
}

}  // namespace

void add_chart_command(Command& app, Action& action) {
  const auto options = std::make_shared<ChartOptions>();
  Command* command =
      app.add_subcommand("chart", "Draw a family of curves over any parameters of a drive");
  command->add_option("--x", options->x, axis_help)->type_name("AXIS")->required();
  command->add_option("--curves", options->curves, "Draw one curve for each value of this axis")
      ->type_name("AXIS");
  add_grid_options(*command, options->grid, "Draw curves=FILE, the quantity over --x;");
  command->footer(
      "Without --backlash, amplitudes are in backlashes, because they are proportional to it.\n\n" +
      help_footer(examples));
  set_action(*command, action, options, run);
}

}  // namespace gearlash::cli
