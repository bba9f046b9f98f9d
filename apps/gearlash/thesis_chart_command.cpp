// gearlash thesis figure, all, chart-reading and extension: the charts of 1960 and later ones.
#include <fmt/format.h>

#include <filesystem>

#include "base/lists.hpp"
#include "base/progress_part.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "thesis/chart_reading.hpp"
#include "thesis/exact_curve.hpp"
#include "thesis/extensions.hpp"
#include "thesis/figures.hpp"
#include "thesis_command.hpp"

namespace gearlash::cli {
namespace {

// --- figures ---

constexpr char figure_examples[] =
    "  gearlash thesis figure 7\n"
    "  gearlash thesis figure 12 --output phase.pdf\n"
    "  gearlash thesis all --output figures\n";

int read_figure_number(const std::string& text) {
  const auto names =
      of_each(thesis::figure_numbers(), [](int number) { return std::to_string(number); });
  if (contains(names, text)) return std::stoi(text);
  refuse("N", text, "must be the number of a figure: " + alternatives(names));
}

// --- chart-reading ---

constexpr char chart_reading_examples[] =
    "  gearlash thesis chart-reading --damping .19 --inertia-ratio 2 --friction-ratio .1 \\\n"
    "      --backlash .1\n"
    "  gearlash thesis chart-reading examples/elinco-fd162.toml\n";

std::string chart_reading_text(const NormalizedServo& servo, const thesis::ChartReading& reading) {
  std::string text = "Reading the charts of 1960 (Appendix C of the thesis)\n\n";
  text += fmt::format("  1. The variables: damping {}, inertia ratio {}, friction ratio {}\n",
                      significant(servo.damping, 4), significant(servo.inertia_ratio, 4),
                      significant(servo.friction_ratio, 4));
  text += fmt::format("  2. The chart of the nearest friction ratio: figure {}, for {}\n",
                      reading.chart->figure, significant(reading.chart->friction_ratio, 2));
  const auto read_text = [](double amplitude) {
    return amplitude > 0.0 ? "at " + significant(amplitude, 3) : std::string("absent (0)");
  };
  text += fmt::format(
      "  3. At inertia ratio {} its curve for damping {} is {}, the curve for {} is {};\n"
      "     interpolated at {}: ±{} rad for a backlash of 0.3 rad\n",
      significant(servo.inertia_ratio, 4), reading.neighbours[0], read_text(reading.read[0]),
      reading.neighbours[1], read_text(reading.read[1]), significant(servo.damping, 4),
      significant(reading.chart_amplitude, 3));
  text += fmt::format("  4. For this backlash: {} × {}/0.3 = ±{} rad\n",
                      significant(reading.chart_amplitude, 3), significant(servo.backlash, 4),
                      significant(reading.amplitude, 3));
  const LimitCycleAnalysis exact = analyse_limit_cycles(servo);
  if (exact.cycles.empty()) {
    return text + fmt::format("\nExact: no limit cycle, {}\n", name_of(exact.verdict));
  }
  const double amplitude = exact.cycles.front().amplitude;
  text += fmt::format("\nExact: ±{} rad; the reading is off by {:+.1f} %\n",
                      significant(amplitude, 6), 100.0 * (reading.amplitude / amplitude - 1.0));
  const auto error = thesis::reading_error(servo, reading);
  if (!error) return text;
  const auto row = [](const char* cause, double part) {
    return fmt::format("  {:<56}{:+.1f} %\n", cause, 100.0 * part);
  };
  return text + row("a friction ratio other than the chart's", error->friction_ratio) +
         row("a straight line between the curves of two dampings", error->damping) +
         row("curves drawn through five inertia ratios", error->inertia_ratio) +
         row("the program's amplitudes", error->program);
}

// --- extensions ---

constexpr char extension_examples[] =
    "  gearlash thesis extension 2\n"
    "  gearlash thesis extension 4 --output restitution.pdf\n";

// --- the verbs ---

/// The picture of --output, else of that name.
PlotFile read_output(const std::string& typed, const std::string& otherwise, Faults& faults) {
  PlotFile file = read_picture("--output", typed.empty() ? otherwise : typed, faults);
  faults.require_writable({{"--output", file.file}});
  return file;
}

struct FigureOptions {
  std::string number;
  std::string output;
};

ExitStatus draw_figure(const FigureOptions& typed, const Provenance&) {
  Faults faults;
  const int number = faults.collect([&] { return read_figure_number(typed.number); }, 2);
  const PlotFile file = read_output(typed.output, fmt::format("figure-{}.svg", number), faults);
  faults.require_none();
  write_plot(file, thesis::figure_plot(number).value());
  return ExitStatus::done;
}

struct FolderOptions {
  std::string folder = "thesis-figures";
  LimitOptions limits;
};

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return;
  refuse("--output", folder.string(),
         "must be a folder that exists or can be made (" + error.message() + ")");
}

ExitStatus draw_all(const FolderOptions& typed, const Provenance&) {
  Faults faults;
  const Limits limits = read_limits(typed.limits, faults);
  faults.require_none();
  const std::filesystem::path folder = typed.folder;
  make_folder(folder);
  const std::vector<int> numbers = thesis::figure_numbers();
  const auto file = [&](std::size_t i) {
    return (folder / fmt::format("figure-{}.svg", numbers[i])).string();
  };
  faults.require_writable({{"--output", file(0)}});
  faults.require_none();
  LimitedWork work(limits);
  TerminalProgress progress(work, "Figures");
  std::size_t drawn = 0;
  while (drawn < numbers.size()) {
    ProgressPart part(progress, drawn, numbers.size());
    const Plot plot = thesis::figure_plot(numbers[drawn], part).value();
    if (!work.go_on()) break;
    write_plot({.file = file(drawn++)}, plot);
  }
  return end_work(work, ExitStatus::done,
                  fmt::format("{} of {} figures are drawn", drawn, numbers.size()));
}

ExitStatus read_charts(const ServoOptions& typed, const Provenance&) {
  Faults faults;
  const std::optional<WrittenDrive> written = resolve_charted_drive(typed, faults);
  faults.require_none();
  const NormalizedServo servo = servo_of_1960(*written, typed).servo;
  write_file("-", fitted_to_output(chart_reading_text(servo, thesis::read_chart(servo))));
  return ExitStatus::done;
}

struct ExtensionOptions : FigureOptions {
  LimitOptions limits;
};

ExitStatus draw_extension(const ExtensionOptions& typed, const Provenance&) {
  Faults faults;
  if (typed.number != "2" && typed.number != "3" && typed.number != "4") {
    faults.add("N", shown(typed.number),
               "must be 2, 3 or 4 (recommendation 1 is gearlash thesis run)");
  }
  const PlotFile file = read_output(typed.output, "extension-" + typed.number + ".svg", faults);
  const Limits limits = read_limits(typed.limits, faults);
  faults.require_none();
  LimitedWork work(limits);
  const thesis::Extension extension = thesis::extension(
      std::stoi(typed.number), TerminalProgress(work, "Extension " + typed.number).as_argument());
  std::vector<PlotFile> pictures;
  if (!work.is_stopped()) pictures.push_back(file);
  return give(
      {.text = fitted_to_output(wrapped(fmt::format("{}. {}", extension.number, extension.wish)) +
                                "\n" + wrapped(extension.lesson)),
       .unknown = "the chart is not drawn"},
      work, pictures, [&](const PlotFile&) { return extension.plot; });
}

}  // namespace

void add_thesis_figure(const Command& thesis, Action& action) {
  const auto [command, options] =
      add_verb<FigureOptions>(thesis, action, "figure",
                              "Draw one of figures 2 to 15: the program's points, the exact curves",
                              help_footer(figure_examples), draw_figure);
  command.add_option("N", options.number, "Choose the figure: 2 to 15", {.is_required = true});
  command.add_option("--output FILE", options.output,
                     "Write this picture, .svg, .png or .pdf; default figure-N.svg");
}

void add_thesis_all(const Command& thesis, Action& action) {
  const auto [command, options] =
      add_verb<FolderOptions>(thesis, action, "all", "Draw all figures into a folder, as SVG",
                              help_footer(figure_examples), draw_all);
  command.add_option("--output DIR", options.folder,
                     "Write into this folder, and make it if missing; default thesis-figures");
  add_limit_options(command, options.limits);
}

void add_thesis_chart_reading(const Command& thesis, Action& action) {
  const auto [command, options] = add_verb<ServoOptions>(
      thesis, action, "chart-reading", "Read the amplitude off the charts, beside the exact one",
      help_footer(chart_reading_examples), read_charts);
  add_servo_options(command, options);
}

void add_thesis_extension(const Command& thesis, Action& action) {
  const auto [command, options] = add_verb<ExtensionOptions>(
      thesis, action, "extension", "Draw the chart of recommendation 2, 3 or 4 of the thesis",
      help_footer(extension_examples), draw_extension);
  command.add_option("N", options.number, "Choose the recommendation: 2, 3 or 4",
                     {.is_required = true});
  command.add_option("--output FILE", options.output,
                     "Write this picture, .svg, .png or .pdf; default extension-N.svg");
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
