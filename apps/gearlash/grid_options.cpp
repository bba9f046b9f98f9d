#include "grid_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "gearlash/input.hpp"
#include "picture/grid_chart.hpp"
#include "picture/grid_map.hpp"
#include "question/family/evaluation.hpp"

namespace gearlash::cli {
namespace {

constexpr std::size_t most_points = 10'000'000;  // a gigabyte

/// The index of the normal form's number that an option gives for a path; their count for any
/// other.
std::size_t number_with(std::string_view path) {
  std::size_t i = 0;
  while (i < normal_form_numbers.size() && path != normal_form_numbers[i].path &&
         path != path_of(normal_form_numbers[i], false)) {
    ++i;
  }
  return i;
}

/// A value for a parameter on an axis, which no option gives without a file.
void put_in_stand_in(ServoOptions& options, std::size_t number) {
  std::optional<std::string>& typed = options.numbers[number];
  if (options.file.empty() && !typed) typed = "0.5";
}

std::vector<AxisText> split_axes(const std::vector<AxisOption>& options, Faults& faults) {
  std::vector<AxisText> texts;
  for (const AxisOption& option : options) {
    AxisText text =
        faults.collect([&] { return split_axis(option.field, option.text); }, AxisText{});
    if (!text.name.empty()) texts.push_back(std::move(text));
  }
  return texts;
}

/// Refuses options and settings for a parameter on an axis.
void refuse_given(const ServoOptions& options, const AxisText& axis, const std::string& path,
                  Faults& faults) {
  const std::string permitted = "must be left out: " + axis.field + " varies it";
  const std::size_t number = number_with(path);
  const bool is_number = number < options.numbers.size();
  if (is_number && options.numbers[number]) {
    faults.add(option_name(normal_form_numbers[number].name), shown(*options.numbers[number]),
               permitted);
  }
  if (path == "sensor.position" && options.sensor) {
    faults.add("--sensor", shown(*options.sensor), permitted);
  }
  for (const std::string& setting : options.settings) {
    if (setting.substr(0, setting.find('=')) != path) continue;
    faults.add("--set", shown(setting), permitted);
  }
}

}  // namespace

std::optional<WrittenDrive> read_fixed_drive(const ServoOptions& options,
                                             const std::vector<AxisText>& axes, bool are_all_there,
                                             const std::vector<FileUse>& outputs, Faults& faults) {
  ServoOptions completed = options;
  const Drive any = normal_form(0.5, 1.0, 0.5);
  for (const AxisText& axis : axes) {
    const std::string path = path_named(axis.name, any);
    are_all_there = are_all_there && parameter_of({.path = path}, any) != nullptr;
    refuse_given(options, axis, path, faults);
    const std::size_t number = number_with(path);
    if (number < completed.numbers.size()) put_in_stand_in(completed, number);
  }
  if (!has_drive(completed)) return resolve_drive(completed, outputs, faults);
  const bool has_backlash =
      completed.backlash() || any_of(options.settings, [](const std::string& setting) {
        return setting.starts_with("servo.backlash");
      });
  if (options.file.empty() && !has_backlash) completed.backlash() = "1";
  for (std::size_t i = 0; i < completed.numbers.size() && !are_all_there; ++i) {
    if (normal_form_numbers[i].path != "contact.restitution") put_in_stand_in(completed, i);
  }
  return resolve_drive(completed, outputs, faults);
}

namespace {

/// Reads --plot, and --output by its extension.
void read_outputs(const GridOptions& options, const std::vector<std::string>& kinds, GridTask& task,
                  Faults& faults) {
  const std::string& kind = kinds.front();
  task.plots = read_plots(options.plots, kinds, faults);
  const std::string ending = ending_of(options.output);
  if (contains(picture_endings, ending)) {
    task.plots.push_back({kind, options.output, picture_format("--output", options.output)});
  } else if (ending == ".csv" || ending == ".json" || ending == ".nc") {
    task.table_file = options.output;
  } else if (!options.output.empty()) {
    faults.add("--output", shown(options.output),
               "must end in .svg, .png, .pdf, .csv, .json or .nc");
  } else if (options.plots.empty()) {
    faults.add("--output", "", "must be given, or --plot " + kind + "=FILE");
  }
}

void read_map_target(const GridOptions& options, bool is_known, GridTask& task, Faults& faults) {
  if (options.target.empty()) return;
  task.target_text = options.target;
  task.target = collect_target(options.target, is_known ? &task.grid.drive : nullptr, faults);
}

void require_room(const Grid& grid) {
  if (grid.size() <= most_points) return;
  refuse("points", std::to_string(grid.size()),
         "must be at most " + std::to_string(most_points) +
             " on both axes together; gearlash sweep has room for more");
}

/// All quantities for a table; only the needed ones for pictures alone.
std::vector<Quantity> quantities_of(const GridTask& task) {
  if (task.table_file.empty()) {
    return quantities_drawn(task.grid, task.quantity, task.has_boundary && !task.target);
  }
  const auto known = quantities_known(Family(task.grid).engines());
  std::vector<Quantity> all(known.begin(), known.end());
  if (!contains(all, task.quantity)) all.push_back(task.quantity);
  return all;
}

void write_table(const GridTask& task, const GridTable& table, const RowCount& count,
                 OutputFile& output) {
  const auto sink = [&](std::string_view text) { output.write(text); };
  if (ending_of(task.table_file) == ".csv") return write_grid_csv(table, sink);
  if (ending_of(task.table_file) == ".json") return write_grid_json(table, sink);
  GridNetcdf file = GridNetcdf::create(output.descriptor_of_file(), output.shown_name(),
                                       {task.grid, quantities_of(task), table.provenance, ""});
  file.write({0, table.table, count});
  if (table.target) file.write_target(table.kinds);
  if (table.hunting_boundary) file.write_boundary(*table.hunting_boundary);
}

}  // namespace

void add_grid_options(const Command& command, GridOptions& options, const std::string& drawing) {
  command.add_option("--quantity NAME", options.quantity,
                     "Draw this quantity: amplitude (default), period, growth_at_rest, …");
  command.add_option("--output FILE", options.output,
                     "Write this table (.csv, .json, .nc) or picture (.svg, .png, .pdf)");
  add_plot_option(command, options.plots, drawing);
  command.add_flag("--proved", options.proved,
                   "Prove each verdict by interval arithmetic, for servos as that of 1960 with "
                   "plastic contact; verdicts that it cannot prove are undecided");
  add_limit_options(command, options.limits);
  add_servo_or_drive_options(command, options.servo);
}

Quantity read_quantity(const std::string& text, Faults& faults) {
  const std::optional<Quantity> quantity = find_quantity(text);
  if (quantity && info_of(*quantity).kind == QuantityKind::number) return *quantity;
  faults.require_choice("--quantity", text, names_of_quantities(QuantityKind::number));
  return Quantity::amplitude;
}

void require_an_area(const Grid& grid, const std::vector<std::string>& fields, Faults& faults) {
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    if (grid.axes[i].values.size() > 1) continue;
    faults.add(fields[i], "1 value",
               "must have two values or more; gearlash chart draws a single line");
  }
}

GridTask read_grid_task(const GridOptions& options, const std::vector<AxisOption>& typed_axes,
                        const std::string& title, const std::vector<std::string>& kinds) {
  Faults faults;
  const std::vector<AxisText> texts = split_axes(typed_axes, faults);
  GridTask task;
  task.title = title;
  task.quantity = read_quantity(options.quantity, faults);
  task.limits = read_limits(options.limits, faults);
  read_outputs(options, kinds, task, faults);
  std::vector<FileUse> outputs = files_of(task.plots);
  if (!task.table_file.empty()) outputs.push_back({"--output", task.table_file});
  const std::optional<WrittenDrive> written =
      read_fixed_drive(options.servo, texts, texts.size() == typed_axes.size(), outputs, faults);
  const bool is_known = written || options.servo.file.empty();
  task.grid.proved = options.proved;
  task.grid.drive = drive_of_axes(written ? written->drive : normal_form(0.5, 1.0, 0.5), texts);
  const auto read_one = [&](const AxisText& text, std::string* left_out) {
    return read_axis(text, task.grid.drive, left_out);
  };
  if (is_known) task.grid.axes = collect_axes(texts, read_one, faults);
  const bool is_map = task.grid.axes.size() == 2 && typed_axes.front().field == "--y";
  if (is_map && !options.servo.file.empty()) task.present = place_on_map(task.grid);
  read_map_target(options, written.has_value(), task, faults);
  const bool are_read = task.grid.axes.size() == typed_axes.size();
  const std::vector<std::string> fields = of_each(texts, &AxisText::field);
  if (!task.plots.empty() && are_read) {
    faults.add(faults_of_picture(task.grid, fields, fields.front() == "--curves"));
  }
  faults.require_none();
  require_none(gearlash::faults(task.grid, fields));
  require_room(task.grid);
  return task;
}

std::string refused_text(const Grid& grid, const RowCount& count) {
  std::vector<double> values(grid.axes.size());
  for (std::size_t point = 0; point < grid.size() && count.refused > 0; ++point) {
    std::string place;
    for (std::size_t i = grid.axes.size(), rest = point; i-- > 0;) {
      const Axis& axis = grid.axes[i];
      values[i] = axis.values[rest % axis.values.size()];
      rest /= axis.values.size();
      place = axis.path + " = " + text_of(axis, grid.drive, values[i]) +
              (place.empty() ? "" : ", ") + place;
    }
    const std::vector<Fault> found = faults(drive_with(grid.drive, grid.axes, values));
    if (found.empty()) continue;
    return fmt::format("{} of {} points refused, the first at {}: {}", count.refused,
                       count.points(), place, to_string(found.front()));
  }
  return "";
}

std::string solved_text(const RowCount& count) {
  const std::size_t servos = count.solved.side_by_side + count.solved.one_by_one;
  std::string text = fmt::format("{} {}", count.points(), count.searched > 0 ? "drives" : "servos");
  if (servos > 0 || count.searched == 0) {
    text += fmt::format(", {} solved side by side, {} one by one", count.solved.side_by_side,
                        count.solved.one_by_one);
  }
  if (count.searched > 0) text += fmt::format(", {} searched", count.searched);
  if (count.refused > 0) text += fmt::format(", {} refused", count.refused);
  if (count.unproved > 0) text += fmt::format(", {} left undecided by the proof", count.unproved);
  return text;
}

WorkedOut work_out(const GridTask& task, LimitedWork& work, const Provenance& provenance) {
  WorkedOut done{.table = task};
  done.table.table = Table(task.grid.size(), quantities_of(task));
  done.table.provenance = provenance;
  done.count = gearlash::work_out(
      done.table, TerminalProgress(work, task.title, task.grid.size(), "points").as_argument());
  if (task.has_boundary) {
    add_borders(done.table, TerminalProgress(work, "Borders").as_argument());
  }
  return done;
}

ExitStatus make_grid_files(const GridTask& task, LimitedWork& work, const Provenance& provenance,
                           GridPlot plot) {
  std::optional<OutputFile> output;
  if (!task.table_file.empty()) output.emplace(task.table_file);
  WorkedOut done;
  Extras extras;
  std::vector<std::string> made;
  const bool is_streamed =
      task.plots.empty() && !task.target && ending_of(task.table_file) == ".nc";
  if (is_streamed) {
    TerminalProgress progress(work, task.title, task.grid.size(), "points");
    done.count = write_grid_netcdf(
        output->descriptor_of_file(), output->shown_name(),
        {.grid = task.grid, .quantities = quantities_of(task), .provenance = provenance},
        task.has_boundary, progress, steady_seconds);
  } else {
    done = work_out(task, work, provenance);
  }
  const RowCount& count = done.count;
  const GridTable& table = done.table;
  const ExitStatus status =
      end_work(work, ExitStatus::done,
               count.points() < task.grid.size()
                   ? fmt::format("{} of {} points are known", count.points(), task.grid.size())
                   : "some of their quantities, or borders, are missing");
  if (output) {
    extras.make([&] {
      if (!is_streamed) write_table(task, table, count, *output);
      output->commit();
      made.push_back(output->shown_name());
    });
  }
  for (const PlotFile& file : task.plots) {
    extras.make([&] {
      write_plot(file, plot(table, task.quantity));
      made.push_back(shown(file.file, std::string::npos));
    });
  }
  report_lines(refused_text(task.grid, count));
  extras.print((made.empty() ? "" : listed(made) + ": ") + solved_text(count) + "\n");
  return extras.status(status);
}

}  // namespace gearlash::cli
