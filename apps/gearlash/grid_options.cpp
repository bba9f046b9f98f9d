#include "grid_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>

#include "analysis/grid/hunting_boundary.hpp"
#include "base/range_check.hpp"
#include "input/axis_text.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr std::size_t most_points = 10'000'000;  // a gigabyte

using TypedInput = std::optional<std::string> ServoOptions::*;

/// The option of a servo's input.
TypedInput option_of(Input input) {
  switch (input) {
    case Input::inertia_ratio:
      return &ServoOptions::inertia_ratio;
    case Input::friction_ratio:
      return &ServoOptions::friction_ratio;
    case Input::backlash:
      return &ServoOptions::backlash;
    case Input::restitution:
      return &ServoOptions::restitution;
    case Input::damping:
      break;
  }
  return &ServoOptions::damping;
}

/// The axes that can be read, and what the options call them.
struct TypedAxes {
  std::vector<Axis> axes;
  std::vector<std::string> fields;
  bool all_sound = true;
};

TypedAxes read_axes(const std::vector<AxisOption>& options, Faults& faults) {
  TypedAxes typed;
  for (const AxisOption& option : options) {
    Axis axis = faults.collect([&] { return read_axis(option.field, option.text); }, Axis{});
    if (axis.values.empty()) {
      typed.all_sound = false;
      continue;
    }
    typed.axes.push_back(std::move(axis));
    typed.fields.push_back(option.field);
  }
  return typed;
}

/// The servo but for what stands on the axes, which no option may give besides. Sizes are in
/// backlashes where none is given. Where an axis cannot be read it may be the one that gives what
/// else is missing.
NormalizedServo read_fixed_inputs(const ServoOptions& options, const TypedAxes& axes,
                                  Faults& faults) {
  ServoOptions completed = options;
  const auto leave_to_axis = [&](Input input) {
    std::optional<std::string>& text = completed.*option_of(input);
    if (options.file.empty() && !text) text = "0.5";  // of no matter
  };
  for (std::size_t i = 0; i < axes.axes.size(); ++i) {
    const Input input = axes.axes[i].input;
    if (const std::optional<std::string>& text = options.*option_of(input)) {
      faults.add({option_name(name_of(input)), shown(*text),
                  "must be left out: " + axes.fields[i] + " varies it", ""});
    }
    leave_to_axis(input);
  }
  if (options.file.empty() && !completed.backlash) completed.backlash = "1";
  if (!axes.all_sound) {
    for (const Input input : all_inputs) leave_to_axis(input);
  }
  return resolve_servo(completed, faults).servo;
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
  if (ending == ".nc") return GridFile::netcdf;
  if (ending == ".svg" || ending == ".png" || ending == ".pdf") return GridFile::picture;
  throw InvalidInput(
      {{"--output", shown(file), "must end in .svg, .png, .pdf, .csv, .json or .nc", ""}});
}

/// No picture has room for infinity, for very many curves, or for the digits that tell the ends of
/// a very narrow axis apart.
void require_drawable(const TypedAxes& axes, Faults& faults) {
  constexpr std::size_t most_curves = 16;  // a longer legend leaves no room for them
  constexpr double narrowest_share =
      1e-3;  // of the larger end: else its numbers have too many digits
  for (std::size_t i = 0; i < axes.axes.size(); ++i) {
    const std::vector<double>& values = axes.axes[i].values;
    const double first = values.front();
    const double last = values.back();
    const auto refuse = [&](const std::string& value, const std::string& permitted) {
      faults.add({axes.fields[i], value,
                  "must " + permitted + " in a picture; tables (.csv, .json, .nc) may have it",
                  ""});
    };
    const bool is_curves = axes.fields[i] == "--curves";
    if (!std::isfinite(last)) {
      refuse(exact_text(last), "be finite");
    } else if (is_curves && values.size() > most_curves) {
      refuse(fmt::format("{} values", values.size()), fmt::format("be at most {}", most_curves));
    } else if (!is_curves && values.size() > 1 && last - first < narrowest_share * last) {
      refuse(exact_text(first) + " to " + exact_text(last),
             fmt::format("span {:g} of itself or more", narrowest_share));
    }
  }
}

void write_table(const GridTask& task, const GridTable& table, const GridPicture& draw,
                 OutputFile& output) {
  const auto sink = [&](std::string_view text) { output.write(text); };
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
    case GridFile::netcdf:  // written as it is worked out
      break;
  }
}

}  // namespace

void add_grid_options(Command& command, GridOptions& options) {
  command
      .add_option("--quantity", options.quantity,
                  "what is drawn: size (default), period, growth_at_rest, …")
      ->type_name("NAME");
  command
      .add_option("--output", options.output,
                  "picture (.svg, .png, .pdf) or table (.csv, .json, .nc)")
      ->type_name("FILE")
      ->required();
  command.add_flag("--proved", options.proved,
                   "prove each verdict with plastic contact by interval arithmetic;\n"
                   "what this leaves open is undecided");
  add_servo_options(command, options.servo);
}

GridTask read_grid_task(const GridOptions& options, const std::vector<AxisOption>& typed_axes) {
  Faults faults;
  TypedAxes axes = read_axes(typed_axes, faults);
  GridTask task;
  task.file = options.output;
  task.quantity = read_quantity(options.quantity, faults);
  task.kind = faults.collect([&] { return read_grid_file(options.output); }, GridFile::csv);
  if (task.kind == GridFile::picture) require_drawable(axes, faults);
  faults.require_distinct({"SERVO.toml", options.servo.file}, {{"--output", options.output}});
  task.grid.servo = read_fixed_inputs(options.servo, axes, faults);
  faults.require_none();
  task.grid.axes = std::move(axes.axes);
  task.grid.proved = options.proved;
  require_none(validate(task.grid, axes.fields));
  if (task.grid.size() > most_points) {
    throw InvalidInput({{"points", std::to_string(task.grid.size()),
                         "must be at most " + std::to_string(most_points) +
                             " on both axes together; gearlash sweep has room for more",
                         ""}});
  }
  return task;
}

std::string solved_text(const GridCount& count) {
  const BatchCount& solved = count.solved;
  return fmt::format(
      "{} servos, {} solved side by side, {} one by one{}{}",
      solved.side_by_side + solved.one_by_one + count.refused, solved.side_by_side,
      solved.one_by_one, count.refused > 0 ? fmt::format(", {} refused", count.refused) : "",
      count.unproved > 0 ? fmt::format(", {} left undecided by the proof", count.unproved) : "");
}

void make_grid_file(const GridTask& task, const std::string& what, const Provenance& provenance,
                    const GridPicture& draw) {
  OutputFile output(task.file);  // before the work: it may not be permitted
  std::optional<TerminalProgress> progress;
  progress.emplace(what, task.grid.size(), "servos");
  progress->show_done(0);
  const GoingOn going_on = [&](std::size_t done) {
    progress->show_done(done);
    return true;
  };
  GridCount count;
  if (task.kind == GridFile::netcdf) {
    count = make_grid_netcdf(task.grid, task.boundary, provenance, output, going_on);
  } else {
    GridTable table{
        .grid = task.grid, .cycles = CycleTable(task.grid.size()), .provenance = provenance};
    count =
        evaluate(task.grid, 0, task.grid.size(), table.cycles.columns(), {.going_on = going_on});
    if (task.boundary == GridBoundary::hunting) {
      table.hunting_boundary =
          hunting_boundary(task.grid, table.cycles[CycleQuantity::growth_at_rest]);
      table.dissipative_boundary = dissipative_boundary(task.grid);
    }
    write_table(task, table, draw, output);
  }
  output.commit();
  progress.reset();  // wiped before anything is said
  write_file("-", output.shown_name() + ": " + solved_text(count) + "\n");
}

}  // namespace gearlash::cli
