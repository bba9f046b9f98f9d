#include "grid_options.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "gearlash/io/axis_text.hpp"
#include "gearlash/servo/range_check.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr std::size_t most_points = 10'000'000;  // a gigabyte

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

/// By the ending of its name, in small or capital letters.
GridFile read_grid_file(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".csv") return GridFile::csv;
  if (ending == ".json") return GridFile::json;
  if (ending == ".svg" || ending == ".png" || ending == ".pdf") return GridFile::picture;
  throw InvalidInput(
      {{"--output", shown(file), "must end in .svg, .png, .pdf, .csv or .json", ""}});
}

/// No picture has room for infinity.
void require_finite_axes(const std::vector<Axis>& axes, const std::vector<std::string>& fields,
                         Faults& faults) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (std::isfinite(axes[i].values.back())) continue;
    faults.add({fields[i], exact_text(axes[i].values.back()),
                "must be finite in a picture; tables (.csv, .json) may have it", ""});
  }
}

void work_out(const ServoGrid& grid, const std::string& what, CycleTable& cycles) {
  Progress progress(what, grid.size(), "servos");
  evaluate(grid, 0, grid.size(), cycles.columns(), {.going_on = [&](std::size_t done) {
             progress.show_done(done);
             return true;
           }});
}

}  // namespace

void add_grid_options(CLI::App& command, GridOptions& options) {
  command
      .add_option("--quantity", options.quantity,
                  "what is drawn: size (default), period, growth_at_rest, …")
      ->type_name("NAME");
  command
      .add_option("--output", options.output, "picture (.svg, .png, .pdf) or table (.csv, .json)")
      ->type_name("FILE")
      ->required();
  add_servo_options(command, options.servo);
}

GridTask read_grid_task(const GridOptions& options, const std::vector<AxisOption>& typed_axes) {
  Faults faults;
  std::vector<Axis> axes;
  std::vector<std::string> fields;
  for (const AxisOption& option : typed_axes) {
    Axis axis = faults.collect([&] { return read_axis(option.field, option.text); }, Axis{});
    if (axis.values.empty()) continue;
    axes.push_back(std::move(axis));
    fields.push_back(option.field);
  }
  GridTask task;
  task.file = options.output;
  task.quantity = read_quantity(options.quantity, faults);
  task.kind = faults.collect([&] { return read_grid_file(options.output); }, GridFile::csv);
  if (task.kind == GridFile::picture) require_finite_axes(axes, fields, faults);
  faults.require_distinct({{"SERVO.toml", options.servo.file}, {"--output", options.output}});
  task.grid.servo = read_fixed_inputs(options.servo, axes, fields, faults);
  faults.require_none();
  task.grid.axes = std::move(axes);
  require_none(validate(task.grid, fields));
  if (task.grid.size() > most_points) {
    throw InvalidInput({{"points", std::to_string(task.grid.size()),
                         "must be at most " + std::to_string(most_points) +
                             " on both axes together: they are held in memory",
                         ""}});
  }
  return task;
}

void make_grid_file(const GridTask& task, const std::string& what, const Provenance& provenance,
                    const std::function<void(GridTable&)>& complete,
                    const std::function<std::string(const GridTable&, PictureFormat)>& draw) {
  OutputFile output(task.file);  // before the work: it may not be permitted
  const auto sink = [&](std::string_view text) { output.write(text); };
  GridTable table{
      .grid = task.grid, .cycles = CycleTable(task.grid.size()), .provenance = provenance};
  work_out(task.grid, what, table.cycles);
  complete(table);
  switch (task.kind) {
    case GridFile::picture:
      output.write(draw(table, picture_format("--output", task.file)));
      break;
    case GridFile::csv:
      write_grid_csv(table, sink);
      break;
    case GridFile::json:
      write_grid_json(table, sink);
      break;
  }
  output.commit();
}

}  // namespace gearlash::cli
