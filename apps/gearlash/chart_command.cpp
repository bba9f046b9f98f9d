// gearlash chart: a family of curves over any input of the servo.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "command.hpp"
#include "gearlash/io/axis_text.hpp"
#include "gearlash/io/grid_table.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash chart --x inertia-ratio=1/9:9:200:log --curves damping=0.1:0.6:6 \\\n"
    "      --friction-ratio 0.1 --backlash 0.3 --output figure-7.svg\n"
    "  gearlash chart --x friction-ratio=0:1:101 --curves inertia-ratio=1/4,1,4 \\\n"
    "      --damping 0.1 --quantity period --output period.pdf\n"
    "  gearlash chart --x restitution=0:0.5:51 examples/elinco-fd162.toml --output table.csv\n";

constexpr std::size_t most_points = 10'000'000;  // a gigabyte

struct ChartOptions {
  ServoOptions servo;
  std::string x;
  std::string curves;
  std::string quantity = "size";
  std::string output;
};

/// The option of a servo's input.
std::optional<std::string>& typed(ServoOptions& options, Input input) {
  switch (input) {
    case Input::inertia_ratio:
      return options.inertia_ratio;
    case Input::friction_ratio:
      return options.friction_ratio;
    case Input::backlash:
      return options.backlash;
    case Input::restitution:
      return options.restitution;
    case Input::damping:
      break;
  }
  return options.damping;
}

/// The servo but for what stands on the axes, which no option may give besides. Sizes are in
/// backlashes where none is given.
NormalizedServo read_fixed_inputs(ServoOptions options, const std::vector<Axis>& axes,
                                  const std::vector<std::string>& fields, Faults& faults) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    std::optional<std::string>& text = typed(options, axes[i].input);
    if (text) {
      faults.add({option_name(name_of(axes[i].input)), shown(*text),
                  "must be left out: " + fields[i] + " varies it", ""});
    }
    if (options.file.empty()) text = "0.5";  // of no matter
  }
  if (options.file.empty() && !options.backlash) options.backlash = "1";
  return resolve_servo(options, faults).servo;
}

CycleQuantity read_quantity(const std::string& text, Faults& faults) {
  if (const auto quantity = quantity_named(text)) return *quantity;
  std::vector<std::string> names;
  for (const CycleQuantity quantity : all_quantities) names.emplace_back(name_of(quantity));
  faults.require_choice("--quantity", text, names);
  return CycleQuantity::size;
}

/// What the output is, by its ending.
enum class Kind { picture, csv, json };

Kind read_kind(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".csv") return Kind::csv;
  if (ending == ".json") return Kind::json;
  if (ending == ".svg" || ending == ".png" || ending == ".pdf") return Kind::picture;
  throw InvalidInput(
      {{"--output", shown(file), "must end in .svg, .png, .pdf, .csv or .json", ""}});
}

CycleTable work_out(const ServoGrid& grid) {
  CycleTable cycles(grid.size());
  Progress progress("Chart");
  const auto points = static_cast<double>(grid.size());
  evaluate(grid, 0, grid.size(), cycles.columns(), {.going_on = [&](std::size_t done) {
             progress.show(static_cast<double>(done) / points);
             return true;
           }});
  return cycles;
}

void write(const GridTable& table, Kind kind, CycleQuantity quantity, const std::string& file) {
  if (kind == Kind::picture) {
    write_file(file, draw_line_chart(chart_of(table, quantity), picture_format("--output", file)));
    return;
  }
  OutputFile output(file);
  const auto sink = [&](std::string_view text) { output.write(text); };
  kind == Kind::csv ? write_grid_csv(table, sink) : write_grid_json(table, sink);
  output.commit();
}

ExitStatus run(const ChartOptions& options, const Provenance& provenance) {
  Faults faults;
  std::vector<Axis> axes;
  std::vector<std::string> fields;
  const auto add_axis = [&](const char* field, const std::string& text) {
    const Axis axis = faults.collect([&] { return read_axis(field, text); }, Axis{});
    if (axis.values.empty()) return;
    axes.push_back(axis);
    fields.emplace_back(field);
  };
  if (!options.curves.empty()) add_axis("--curves", options.curves);
  add_axis("--x", options.x);
  const CycleQuantity quantity = read_quantity(options.quantity, faults);
  const Kind kind = faults.collect([&] { return read_kind(options.output); }, Kind::csv);
  faults.require_distinct({{"SERVO.toml", options.servo.file}, {"--output", options.output}});
  const ServoGrid grid{read_fixed_inputs(options.servo, axes, fields, faults), axes};
  faults.require_none();
  require_none(validate(grid, fields));
  if (grid.size() > most_points) {
    throw InvalidInput({{"points", std::to_string(grid.size()),
                         "must be at most " + std::to_string(most_points) +
                             " on both axes together: a chart is held in memory",
                         ""}});
  }

  write({grid, work_out(grid), provenance}, kind, quantity, options.output);
  return ExitStatus::done;
}

}  // namespace

void add_chart_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ChartOptions>();
  CLI::App* command = app.add_subcommand("chart", "a family of curves over any input of the servo");
  command
      ->add_option("--x", options->x,
                   "axis: NAME=FROM:TO:COUNT, NAME=FROM:TO:COUNT:log or\n"
                   "NAME=A,B,C; an input of the servo, below")
      ->type_name("AXIS")
      ->required();
  command->add_option("--curves", options->curves, "a curve for each value of this axis")
      ->type_name("AXIS");
  command
      ->add_option("--quantity", options->quantity,
                   "what is drawn: size (default), period, growth_at_rest, …")
      ->type_name("NAME");
  command
      ->add_option("--output", options->output, "picture (.svg, .png, .pdf) or table (.csv, .json)")
      ->type_name("FILE")
      ->required();
  add_servo_options(*command, options->servo);
  command->footer(
      "Without --backlash sizes are in backlashes, to which they are proportional.\n\n" +
      help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
