// gearlash tolerance: how a production run behaves.
#include <fmt/format.h>

#include "model/proportional_servo.hpp"
#include "output/tolerance_report.hpp"
#include "picture/report_pictures.hpp"
#include "question/series/toleranced_drive.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char tolerance_examples[] =
    "  gearlash tolerance examples/toleranced.toml\n"
    "  gearlash tolerance examples/toleranced.toml --target \"amplitude <= 1 deg\" --yield \"95 "
    "%\"\n"
    "  gearlash tolerance examples/toleranced.toml --samples 10000000 --format json | jq "
    ".study.hunting\n"
    "  gearlash tolerance examples/toleranced.toml --error \"0.1 %\"\n"
    "  gearlash tolerance examples/toleranced-joint.toml --target \"motor-amplitude <= 0.3 deg\"\n";

constexpr char tolerance_explanation[] =
    "The numbers of DRIVE.toml carry tolerances:\n"
    "  inertia = \"0.61 oz in2 ± 10 %\"                       uniform\n"
    "  backlash = { min = \"5 arcmin\", max = \"12 arcmin\" }   uniform\n"
    "  friction = { value = \"2 mN m s/rad\", normal = \"5 %\", min = \"1 mN m s/rad\" }\n"
    "  ratio = { lots = [40, { value = 50, weight = 3 }] }\n\n";

struct ToleranceOptions : QuestionOptions {
  std::string samples;
  std::string error;
  std::string amplitude;
  std::string seed = "1960";
  std::string target;
  std::string yield;
};

struct ToleranceRequest {
  TolerancedDrive drive;
  SamplePlan sampling;
  StudyQuestions questions;
  double error = 0.0;  ///< asked for; 0: none
  double yield = 0.0;  ///< demanded; 0: none
  WorstSearch worst_search;
  std::vector<PlotFile> plots;
  Limits limits;
};

/// Whether each sample is searched.
bool are_searched(const WrittenDrive& written) {
  return is_searched({written.drive, written.tolerances});
}

void read_sampling(const ToleranceOptions& options, ToleranceRequest& task, Faults& faults) {
  if (!options.samples.empty()) {
    task.sampling = sampling_of(
        collect_whole("--samples", options.samples, 32, SamplePlan::most_samples, faults));
  }
  task.sampling.seed = collect_whole("--seed", options.seed, 0, std::uint64_t{1} << 53U, faults);
  if (!options.error.empty()) {
    task.error =
        faults.collect([&] { return gearlash::read_share("--error", options.error); }, 0.5);
    if (!(task.error >= 1e-6 && task.error <= 0.5)) {
      faults.add("--error", shown(options.error), "must be from 0.0001 % to 50 %");
    }
  }
}

/// The samples, and a search for the worst of them that takes no longer.
void choose_effort(const ToleranceOptions& options, ToleranceRequest& task) {
  if (may_bounce(task.drive)) task.worst_search.samples = 256;
  if (is_searched(task.drive)) {
    task.worst_search = {.samples = 8, .starts = 1, .amplitude = task.questions.amplitude};
  }
  if (!options.samples.empty()) return;
  const std::uint64_t seed = task.sampling.seed;
  task.sampling = usual_sampling(task.drive, task.questions);
  task.sampling.seed = seed;
}

/// Of a searched drive the motor's, which may hunt within the gap while the load stands still.
void read_amplitude(const ToleranceOptions& options, bool is_searched, ToleranceRequest& task,
                    Faults& faults) {
  if (!options.amplitude.empty()) {
    faults.require_choice("--amplitude", options.amplitude, {"load", "motor"});
  }
  const bool is_of_motor = options.amplitude.empty() ? is_searched : options.amplitude == "motor";
  task.questions.amplitude = is_of_motor ? Quantity::motor_amplitude : Quantity::amplitude;
  task.worst_search.amplitude = task.questions.amplitude;
}

void read_questions(const ToleranceOptions& options, const Drive* drive, ToleranceRequest& task,
                    Faults& faults) {
  if (!options.target.empty()) {
    task.questions.target = collect_target(options.target, drive, faults);
  }
  if (options.yield.empty()) return;
  task.yield = read_share("--yield", options.yield, faults);
  if (options.target.empty()) {
    faults.add("--target", "", "must be given: --yield is the share of samples that meet it");
  }
}

ToleranceRequest read_task(const ToleranceOptions& options) {
  ToleranceRequest task;
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "json"});
  task.plots = read_plots(options.plots, {"distribution", "yield", "indices"}, faults);
  const std::optional<WrittenDrive> written =
      resolve_drive(options.servo, files_of(task.plots), faults);
  const bool is_searched = written && are_searched(*written);
  read_sampling(options, task, faults);
  read_amplitude(options, is_searched, task, faults);
  read_questions(options, written ? &written->drive : nullptr, task, faults);
  if (is_searched && !options.yield.empty()) {
    faults.add("--yield", options.yield,
               std::string("must be left out: for it a drive ") + permitted_with_servo);
  }
  task.limits = read_limits(options.limits, faults);
  faults.require_none();
  task.drive = {is_searched ? written->drive : without_ended_signals(written->drive),
                written->tolerances};
  if (task.drive.varied.empty()) {
    refuse("DRIVE.toml", options.servo.file,
           "must have a number with a tolerance, such as \"0.61 oz in2 ± 10 %\"");
  }
  choose_effort(options, task);
  return task;
}

/// One question after another, up to the one at which the work is stopped.
void work_out(const ToleranceRequest& task, LimitedWork& work, ToleranceReport& report) {
  std::optional<TerminalProgress> progress;
  const auto begin = [&](const char* what, std::size_t count,
                         const char* name = "drives") -> Progress& {
    progress.reset();
    return progress.emplace(work, what, count, name);
  };
  const std::size_t samples = task.sampling.samples();
  report.study = task.error > 0.0 ? study_tolerances_to(task.error, task.drive, task.sampling,
                                                        task.questions, begin("Study", samples))
                                  : study_tolerances(task.drive, task.sampling, task.questions,
                                                     begin("Study", samples));
  if (work.is_stopped()) return;
  SensitivityStudy sensitivities =
      study_sensitivities(task.drive, task.sampling, task.questions,
                          begin("Indices", samples * (task.drive.varied.size() + 2)));
  if (work.is_stopped()) return;
  report.sensitivities = std::move(sensitivities);
  if (task.yield > 0.0) {
    const auto backlash =
        widest_backlash(task.drive, {.target = task.questions.target, .yield = task.yield},
                        task.sampling, begin("Backlash", samples));
    if (work.is_stopped()) return;
    report.demanded_yield = task.yield;
    report.backlash = backlash;
  }
  WorstCorner worst = worst_corner(task.drive, task.worst_search, {},
                                   begin("Worst sample", 2 * task.worst_search.starts, "climbs"));
  if (work.is_stopped()) return;
  report.worst = std::move(worst);
  report.proved = ceiling_of_all(task.drive, task.questions.amplitude, begin("Proof", 0, ""));
}

/// What is not known where the work was stopped.
std::string unknown_text(const ToleranceReport& report) {
  const ToleranceStudy& study = report.study;
  const std::size_t samples = study.sampling.samples();
  if (study.stopped) {
    return fmt::format("{} of {} samples are not answered", samples - study.answered, samples);
  }
  if (report.sensitivities.numbers.empty())
    return "what decides is not known, nor the worst sample";
  return report.worst.numbers.empty() ? "the worst sample is not known"
                                      : "the bound of all samples is not the best";
}

ExitStatus run(const ToleranceOptions& options, const Provenance& provenance) {
  const ToleranceRequest task = read_task(options);
  LimitedWork work(task.limits);
  ToleranceReport report{.drive = task.drive,
                         .target_text = options.target,
                         .amplitude = task.questions.amplitude,
                         .provenance = provenance};
  work_out(task, work, report);
  report.stopped = work.is_stopped();
  return give({.text = options.format == "json" ? tolerance_json(report)
                                                : fitted_to_output(tolerance_text(report)),
               .unknown = unknown_text(report)},
              work, task.plots, [&](const PlotFile& plot) {
                if (report.sensitivities.numbers.empty()) refuse_to_draw(plot);
                if (plot.kind == "indices") {
                  return indices_plot(report.study, report.sensitivities);
                }
                return tolerance_plot(
                    plot.kind == "yield" ? PictureKind::yield : PictureKind::distribution,
                    report.study, report.drive.nominal.angle_unit);
              });
}

}  // namespace

void add_tolerance_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<ToleranceOptions>(
      app, action, "tolerance", "Predict how many samples of a production run hunt, and why",
      tolerance_explanation + help_footer(tolerance_examples), run);
  add_servo_or_drive_options(command, options.servo);
  command.add_option("--samples N", options.samples,
                     "Set the least number of samples, rounded up to 16 times a power of two; at "
                     "most 16777216; default 65536, 512 or 64, fewer the longer a sample takes");
  command.add_option("--error SHARE", options.error,
                     "Take as many samples as the probability of hunting and the yield need to be "
                     "known to within this share: \"1 %\"");
  command.add_option("--amplitude SHAFT", options.amplitude,
                     "Choose whose amplitude is reported: load, or motor; default load for a servo "
                     "as that of 1960, motor for any other drive");
  command.add_option("--seed N", options.seed, "Set the seed of the random shifts; default 1960");
  command.add_option("--target TARGET", options.target,
                     "Report the yield of this target, written as for design");
  command.add_option("--yield SHARE", options.yield,
                     "Find the largest backlash that may be accepted so that this share of the "
                     "samples meets the target: \"95 %\" or 0.95");
  add_plot_option(command, options.plots,
                  "Draw distribution=FILE, the samples by amplitude, yield=FILE, the yield over a "
                  "limit of the amplitude, or indices=FILE, which parameter decides;");
  add_format_option(command, options.format);
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
