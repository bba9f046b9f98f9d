// gearlash chart: a family of curves over any parameters of the drive.
#include <fmt/format.h>

#include "base/lists.hpp"
#include "gearlash/fault.hpp"
#include "grid_options.hpp"
#include "picture/bifurcation_picture.hpp"
#include "picture/grid_chart.hpp"

namespace gearlash::cli {
namespace {

constexpr char chart_examples[] =
    "  gearlash chart --x inertia-ratio=1/9:9:200:log --curves damping=0.1:0.6:6 \\\n"
    "      --friction-ratio 0.1 --backlash 0.3 --plot curves=figure-7.svg\n"
    "  gearlash chart --x friction-ratio=0:1:101 --curves inertia-ratio=1/4,1,4 \\\n"
    "      --damping 0.1 --quantity period --plot curves=period.pdf\n"
    "  gearlash chart --x restitution=0:0.5:51 examples/elinco-fd162.toml --output table.csv\n"
    "  gearlash chart --x controller.proportional=\"0.5 V/deg:2 V/deg:4:log\" \\\n"
    "      examples/robot-joint.toml --plot curves=gain.svg --output gain.csv\n"
    "  gearlash chart --x damping=0.1:0.5:41 --inertia-ratio 2 --friction-ratio 0.1 \\\n"
    "      --restitution 0.5 --plot bifurcation=branches.svg\n";

struct ChartOptions {
  GridOptions grid;
  std::string x;
  std::string curves;
};

/// Draws the bifurcation pictures.
ExitStatus draw_branches(const GridTask& task, const std::vector<PlotFile>& plots,
                         LimitedWork& work) {
  const BifurcationDiagram diagram = bifurcations_of(
      task.grid.drive, task.grid.axes.back(), TerminalProgress(work, "Branches").as_argument());
  Extras extras;
  if (work.is_stopped()) end_work(work, ExitStatus::undecided, "branches are missing");
  for (const PlotFile& plot : plots) {
    extras.make([&] { write_plot(plot, bifurcation_plot(diagram, task.grid, task.quantity)); });
  }
  extras.print(fmt::format("{}: {} branches, {} borders\n", listed(plots, &PlotFile::file),
                           diagram.branches.size(), diagram.borders.size()));
  return extras.status(diagram.is_complete ? ExitStatus::done : ExitStatus::undecided);
}

ExitStatus run(const ChartOptions& options, const Provenance& provenance) {
  std::vector<AxisOption> axes;
  if (!options.curves.empty()) axes.push_back({"--curves", options.curves});
  axes.push_back({"--x", options.x});
  GridTask task = read_grid_task(options.grid, axes, "Chart", {"curves", "bifurcation"});
  std::vector<PlotFile> branches;
  std::vector<PlotFile> curves;
  for (const PlotFile& plot : task.plots) {
    (plot.kind == "bifurcation" ? branches : curves).push_back(plot);
  }
  if (!branches.empty()) {
    require_none(faults_of_branches(task.grid, task.quantity, {"--curves", "--x", "--quantity"}));
  }
  LimitedWork work(task.limits);
  if (!branches.empty()) {
    const ExitStatus status = draw_branches(task, branches, work);
    if ((curves.empty() && task.table_file.empty()) || status != ExitStatus::done) return status;
  }
  task.plots = std::move(curves);
  return make_grid_files(task, work, provenance, chart_plot);
}

}  // namespace

void add_chart_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<ChartOptions>(
      app, action, "chart", "Draw a family of curves over any parameters of a drive",
      backlashes_explanation + help_footer(chart_examples), run);
  command.add_option("--x AXIS", options.x, axis_help, {.is_required = true});
  command.add_option("--curves AXIS", options.curves, "Draw one curve for each value of this axis");
  add_grid_options(command, options.grid,
                   "Draw curves=FILE, the quantity over --x, or bifurcation=FILE, all cycles over "
                   "--x as stable and unstable branches with their borders;");
}

}  // namespace gearlash::cli
