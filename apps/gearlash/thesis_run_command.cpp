// gearlash thesis run: the amplitudes that the program of 1960 finds, beside the exact ones.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "thesis/chart_errors.hpp"
#include "thesis/exact_curve.hpp"
#include "thesis/mendings.hpp"
#include "thesis/settled_cycle.hpp"
#include "thesis_command.hpp"

namespace gearlash::cli {
namespace {

// --- run ---

constexpr char run_examples[] =
    "  gearlash thesis run --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1\n"
    "  gearlash thesis run examples/elinco-fd162.toml\n"
    "  gearlash thesis run --all\n"
    "  gearlash thesis run --all --machine\n"
    "  gearlash thesis run --causes\n";

std::string run_text(const NormalizedServo& servo, const thesis::SettledCycle& cycle) {
  std::string text =
      fmt::format("The program of 1960, {} s of the servo's time in steps of 0.01 s (ω_n = 1):\n",
                  significant(cycle.run_time, 4));
  if (cycle.diverged) {
    text += "  no result: its step is too long for this servo, so the numbers grow without bound\n";
  } else if (!cycle.hunts) {
    text += "  no limit cycle: for 100 s the faces have not met\n";
  } else if (cycle.cycles == 0) {
    text += "  no result: too few cycles\n";
  } else {
    text += fmt::format("  amplitude  ±{} rad{}\n", significant(cycle.amplitude, 5),
                        cycle.settled ? "" : ", still changing");
    text += fmt::format(
        "             mean of {} cycles, from {} to {}; on the grid of 0.01 s no cycle repeats\n",
        cycle.cycles, significant(cycle.smallest, 5), significant(cycle.largest, 5));
    text += fmt::format("  period     {} s\n", significant(cycle.period, 5));
  }
  const LimitCycleAnalysis exact = analyse_limit_cycles(servo);
  text += "Exact:\n";
  if (exact.cycles.empty()) {
    return text + fmt::format("  no limit cycle: {}\n", name_of(exact.verdict));
  }
  const LimitCycle& one = exact.cycles.front();
  text += fmt::format("  amplitude  ±{} rad\n", significant(one.amplitude, 9));
  text += fmt::format("  period     {} s\n", significant(one.period, 9));
  if (cycle.cycles > 0) {
    text += fmt::format("The program's amplitude is off by {:+.2f} %, its period by {:+.2f} %.\n",
                        100.0 * (cycle.amplitude / one.amplitude - 1.0),
                        100.0 * (cycle.period / one.period - 1.0));
  }
  return text;
}

/// Errors of the charts in per cent, a table for each friction ratio.
std::string errors_text(const std::vector<thesis::ChartError>& errors) {
  std::string text =
      "Errors of the program's amplitudes, in per cent of the exact ones\n"
      "(·: neither hunts; then, now: only the program or only the exact servo hunts)\n";
  std::vector<double> per_cent;
  const thesis::ChartError* before = nullptr;
  for (const thesis::ChartError& error : errors) {
    const NormalizedServo& servo = error.servo;
    if (before == nullptr || before->servo.friction_ratio != servo.friction_ratio) {
      text += fmt::format("\n\nfriction ratio {:<8}", servo.friction_ratio);
      for (const char* ratio : {"1/9", "1/4", "1", "4", "9"}) text += fmt::format("{:>8}", ratio);
    }
    if (before == nullptr || before->servo.damping != servo.damping) {
      text += fmt::format("\n  damping {:<13}", servo.damping);
      const bool only_balanced = servo.inertia_ratio == 1.0;  // as in figure 3
      if (only_balanced) text += std::string(16, ' ');
    }
    const auto relative = error.relative();
    if (relative) per_cent.push_back(100.0 * *relative);
    text += fmt::format("{:>8}", relative        ? fmt::format("{:+.1f}", per_cent.back())
                                 : error.program ? "then"
                                 : error.exact   ? "now"
                                                 : "·");
    before = &error;
  }
  if (per_cent.empty()) return text + "\n";
  std::sort(per_cent.begin(), per_cent.end());
  return text + fmt::format(
                    "\n\n{} servos; {} hunt in both: median {:+.1f} %, from {:+.1f} "
                    "to {:+.1f} %\n",
                    errors.size(), per_cent.size(), per_cent[per_cent.size() / 2], per_cent.front(),
                    per_cent.back());
}

/// The effect of each property of the program on the amplitude, in per cent.
std::string causes_text() {
  const std::vector<NormalizedServo> servos = {
      {.damping = 0.1, .inertia_ratio = 1.0, .friction_ratio = 0.2, .backlash = 0.3},
      {.damping = 0.19, .inertia_ratio = 2.0, .friction_ratio = 0.1, .backlash = 0.3},
      {.damping = 0.1, .inertia_ratio = 9.0, .friction_ratio = 0.1, .backlash = 0.3},
      {.damping = 0.4, .inertia_ratio = 1.0, .friction_ratio = 0.6, .backlash = 0.3},
      {.damping = 0.6, .inertia_ratio = 9.0, .friction_ratio = 1.0, .backlash = 0.3}};
  const auto row = [&](const char* name, double NormalizedServo::*input) {
    std::string text = fmt::format("  {:<54}", name);
    for (const NormalizedServo& servo : servos) text += fmt::format("{:>7}", servo.*input);
    return text + "\n";
  };
  std::string text = "Errors of the program's amplitudes, in per cent of the exact ones\n\n";
  text += row("damping", &NormalizedServo::damping) +
          row("inertia ratio", &NormalizedServo::inertia_ratio) +
          row("friction ratio", &NormalizedServo::friction_ratio) + "\n";
  for (const thesis::NamedMending& one : thesis::mendings()) {
    text += fmt::format("  {:<54}", one.name);
    for (const NormalizedServo& servo : servos) {
      const double error = thesis::amplitude_error(servo, one.mending);
      text += std::isnan(error) ? fmt::format("{:>7}", "rests")
                                : fmt::format("{:>+7.2f}", 100.0 * error);
    }
    text += "\n";
  }
  return text;
}

/// All servos of the thesis's charts, by the port or by the emulated machine.
struct AllRuns {
  std::vector<thesis::ChartError> errors;
  std::string effort;  ///< of the emulated machine, a line
};

AllRuns run_all(bool on_machine, LimitedWork& work) {
  TerminalProgress progress(work, "Charts");
  if (!on_machine) {
    const auto run = [](const thesis::ProgramParameters& parameters, Progress& of_run) {
      return thesis::run_until_settled(parameters, {}, of_run);
    };
    return {thesis::chart_errors(run, progress), ""};
  }
  const auto start = std::chrono::steady_clock::now();
  std::size_t instructions = 0;
  const auto errors = thesis::chart_errors(
      [&](const thesis::ProgramParameters& parameters, Progress& of_run) {
        const thesis::MachineRun run = thesis::run_machine_until_settled(parameters, of_run);
        instructions += run.instructions;
        return run.cycle;
      },
      progress);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  constexpr double seconds_of_1960 = 180.0;
  return {
      errors,
      fmt::format("{} runs of the emulated machine, {} instructions, {} s; the real machine took "
                  "three minutes per run, {} times as long\n",
                  errors.size(), instructions, significant(seconds, 3),
                  std::round(seconds_of_1960 * static_cast<double>(errors.size()) / seconds))};
}

thesis::SettledCycle settled(const thesis::ProgramParameters& parameters, bool on_machine,
                             LimitedWork& work) {
  TerminalProgress progress(work, "Run");
  return on_machine ? thesis::run_machine_until_settled(parameters, progress).cycle
                    : thesis::run_until_settled(parameters, {}, progress);
}

struct RunOptions : QuestionOptions {
  bool all = false;
  bool causes = false;
  bool machine = false;
};

ExitStatus run_charts(const RunOptions& options) {
  Faults faults;
  const std::vector<PlotFile> plots = read_plots(options.plots, {"errors"}, faults);
  faults.require_distinct({}, files_of(plots));
  faults.require_writable(files_of(plots));
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();
  LimitedWork work(limits);
  const AllRuns runs = run_all(options.machine, work);
  return give({.text = errors_text(runs.errors) + runs.effort,
               .unknown = fmt::format("{} of {} servos are run", runs.errors.size(),
                                      thesis::charted_servos().size())},
              work, plots, [&](const PlotFile&) { return thesis::error_plot(runs.errors); });
}

ExitStatus run_program(const RunOptions& options, const Provenance&) {
  if (options.all) return run_charts(options);
  if (options.causes) {
    write_file("-", causes_text());
    return ExitStatus::done;
  }
  Faults faults;
  const std::optional<WrittenDrive> written = resolve_charted_drive(options.servo, faults);
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();
  const NormalizedServo servo = servo_of_1960(*written, options.servo).servo;
  LimitedWork work(limits);
  const auto parameters = thesis::program_parameters(servo);
  const thesis::SettledCycle cycle = settled(parameters, options.machine, work);
  write_file("-", run_text(servo, cycle));
  return end_work(work, cycle.settled ? ExitStatus::done : ExitStatus::undecided,
                  "the amplitude had not settled");
}

}  // namespace

void add_thesis_run(const Command& thesis, Action& action) {
  const auto [command, options] = add_verb<RunOptions>(
      thesis, action, "run",
      "Find the amplitude of any servo by the program of 1960, beside the exact one",
      help_footer(run_examples), run_program);
  add_servo_options(command, options.servo);
  const std::vector<Option> servo = command.options();
  const Option all = command.add_flag(
      "--all", options.all, "Run all servos of the thesis's charts and tabulate the errors");
  add_plot_option(command, options.plots, "Draw errors=FILE, the errors of --all as a map;")
      .needs(all);
  const Option machine = command.add_flag("--machine", options.machine,
                                          "Run on the emulated CDC 1604 instead of the port");
  const Option causes =
      command.add_flag("--causes", options.causes,
                       "Show the effect of each property of the program on five amplitudes");
  for (const Option& option : servo) {
    all.excludes(option);
    causes.excludes(option);
  }
  causes.excludes(all);
  causes.excludes(machine);
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
