// gearlash limit-cycle: whether a drive hunts, with the amplitude and frequency.
#include <numbers>

#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "output/answer_report.hpp"
#include "picture/answer_picture.hpp"
#include "picture/report_pictures.hpp"
#include "question/analyse.hpp"
#include "question/change/derivatives.hpp"
#include "question/change/margins.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char limit_cycle_examples[] =
    "  gearlash limit-cycle examples/robot-joint.toml --brief\n"
    "  gearlash limit-cycle examples/elinco-fd162.toml --plot phase=hunting.svg\n"
    "  gearlash limit-cycle examples/elinco-fd162.toml --backlash \"12 arcmin\"\n"
    "  gearlash limit-cycle --damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3\n"
    "  gearlash limit-cycle examples/elinco-fd162.toml --sensitivities --plot "
    "tornado=amplitude.svg\n"
    "  gearlash limit-cycle examples/normalized.toml --format json | jq "
    ".cycles[0].amplitude\n"
    "  gearlash limit-cycle examples/robot-joint.toml --set controller.kp=\"0.8 V/deg\" --brief\n"
    "  gearlash limit-cycle examples/elinco-fd162.toml --specification \"10 arcmin\"\n"
    "  gearlash limit-cycle examples/robot-joint.toml --measured \"0.2 deg, 1.1 Hz\"\n"
    "  gearlash limit-cycle examples/robot-joint.toml --margins --parameters "
    "gearbox.backlash,load.inertia,motor.coulomb\n";

struct LimitCycleOptions : QuestionOptions {
  std::string measured;
  bool brief = false;
  bool verbose = false;
  bool margins = false;
  std::vector<std::string> parameters;  ///< of the margins
  bool sensitivities = false;
};

/// An answer with its report.
struct Result {
  Analysis analysis{};
  AnswerReport report{};
};

Plot plot_of(const Result& result, const std::string& kind, LimitedWork& work) {
  if (kind == "tornado") return tornado_plot(*result.report.sensitivity);
  if (kind == "ceiling") return ceiling_plot(result.report);
  if (kind == "time") return time_plot(response_picture(result.report, result.analysis));
  return phase_plot(phase_picture(result.report, result.analysis,
                                  TerminalProgress(work, "Basins").as_argument()));
}

/// The parameters of the margins; none: the usual ones.
std::vector<Axis> read_parameters(const LimitCycleOptions& options, const Drive& drive,
                                  Faults& faults) {
  std::vector<Axis> axes = collect_axes_to_search(options.parameters, drive, faults);
  if (!options.parameters.empty() && !options.margins) {
    faults.add("--parameters", options.parameters.front(), "must come with --margins");
  }
  return axes;
}

/// Of the drive along these axes; none: the usual ones.
void add_margins(Result& result, const Drive& drive, const std::vector<Axis>& axes,
                 LimitedWork& work) {
  if (!has_margins(result.analysis)) return;
  TerminalProgress progress(work, "Margins");
  result.report.margin = margins(drive, axes, progress);
}

Result analysed(const WrittenDrive& written, const Provenance& provenance, LimitedWork& work) {
  Wanted wanted = wanted_of_report();
  wanted.motion_bytes = bytes_of_motion(work.limits());
  Result result{.analysis = analyse_in_full(written.drive, wanted,
                                            TerminalProgress(work, "Searching").as_argument())};
  result.report = report_of(written.drive, result.analysis.answer, provenance);
  return result;
}

/// "0.2 rad, 0.9 Hz", or with a period: "0.2 rad, 1.1 s".
std::optional<MeasuredHunting> read_hunting(const std::string& text) {
  if (text.empty()) return std::nullopt;
  constexpr char field[] = "--measured";
  const std::vector<std::string_view> parts = split(text, ",");
  if (parts.size() != 2) {
    refuse(field, text, "must be an amplitude and a frequency or a period: \"0.2 rad, 0.9 Hz\"");
  }
  MeasuredHunting measured{.amplitude = read_measured(field, parts[0], dimensions::angle).si};
  try {
    measured.frequency = 1.0 / to_si(field, parts[1], dimensions::time);
  } catch (const InvalidInput&) {
    measured.frequency =
        to_si(field, parts[1], dimensions::angular_frequency) / (2.0 * std::numbers::pi);
  }
  if (!(measured.amplitude > 0.0) || !(measured.frequency > 0.0)) {
    refuse(field, text, "must have an amplitude and a frequency above 0");
  }
  return measured;
}

std::string printed(const Result& result, const LimitCycleOptions& options) {
  if (options.format == "json") return answer_json(result.report);
  if (options.brief) return fitted_to_output(headline(result.report) + "\n");
  return with_bold_headline(
      answer_text(result.report, options.verbose ? Detail::all : Detail::usual));
}

ExitStatus run(const LimitCycleOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "json"});
  if (options.brief) {
    faults.refuse_beside_brief({{"--margins", options.margins ? "yes" : ""},
                                {"--sensitivities", options.sensitivities ? "yes" : ""},
                                {"--measured", options.measured},
                                {"--format", options.format == "text" ? "" : options.format}});
  }
  const std::vector<PlotFile> plots =
      read_plots(options.plots, {"phase", "time", "tornado", "ceiling"}, faults);
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, files_of(plots), faults);
  const Limits limits = read_limits(options.limits, faults);
  const auto measured = faults.collect([&] { return read_hunting(options.measured); },
                                       std::optional<MeasuredHunting>());
  std::vector<Axis> axes;
  if (written) axes = read_parameters(options, written->drive, faults);
  faults.require_none();

  LimitedWork work(limits);
  Result result = analysed(*written, provenance, work);
  result.report.measured = measured;
  if (options.margins) add_margins(result, written->drive, axes, work);
  if (options.sensitivities || has_kind(plots, "tornado")) {
    result.report.sensitivity = sensitivities(
        written->drive, result.analysis, TerminalProgress(work, "Sensitivities").as_argument());
  }
  const bool decided = is_decided(result.report.answer);
  const std::string open = decided ? "" : headline(result.report);
  return give({.text = printed(result, options),
               .remark = work.is_stopped() ? "" : open,
               .is_decided = decided,
               .unknown = decided ? "margins or bounds are missing" : open},
              work, plots, [&](const PlotFile& plot) { return plot_of(result, plot.kind, work); });
}

}  // namespace

void add_limit_cycle_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<LimitCycleOptions>(
      app, action, "limit-cycle", "Report whether a drive hunts, with the amplitude and frequency",
      help_footer(limit_cycle_examples), run);
  add_servo_or_drive_options(command, options.servo);
  add_format_option(command, options.format);
  command.add_flag("--brief", options.brief, "Print the headline alone");
  command.add_flag("--verbose", options.verbose,
                   "Print every number of every motion, of the ceiling and of the drive");
  add_limit_options(command, options.limits);
  command.add_option(
      "--measured AMPLITUDE,FREQUENCY", options.measured,
      "Add how far hunting that was measured at the load, half of its peak to peak and "
      "its frequency or period, is from each motion found: \"0.2 rad, 0.9 Hz\"");
  add_plot_option(command, options.plots,
                  "Draw phase=FILE, the limit cycles in the phase plane and motions that lead to "
                  "them, time=FILE, such a motion over time, tornado=FILE, the sensitivities of "
                  "the amplitude, or ceiling=FILE, what the proved bound of every motion is made "
                  "of;");
  command.add_flag("--margins", options.margins,
                   "Add how far each parameter may change before hunting ends or begins, and all "
                   "of them together; for most drives this takes seconds to minutes");
  command.add_option("--parameters NAMES", options.parameters,
                     "List the parameters of --margins, by path, separated by commas: any number "
                     "or choice of the drive, searched from 0.1 to 10 times its present value or "
                     "over PATH=FROM:TO:COUNT[:log]; default the backlash and the controller's "
                     "numbers, of a servo as that of 1960 those of design",
                     {.delimiter = ','});
  command.add_flag("--sensitivities", options.sensitivities,
                   "Add sensitivities to every parameter, in per cent for one per cent; not for a "
                   "sampled controller or an encoder");
}

}  // namespace gearlash::cli
