// gearlash describe: what describing functions predict, beside the exact cycle.
#include <algorithm>

#include "gearlash/analyse.hpp"
#include "input/units.hpp"
#include "output/describe_report.hpp"
#include "picture/nyquist_picture.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char describe_examples[] =
    "  gearlash describe examples/elinco-fd162.toml --plot nyquist=nyquist.svg\n"
    "  gearlash describe --damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3\n"
    "  gearlash describe examples/normalized.toml --format json | jq .analyses[].cycles\n";

constexpr char describe_explanation[] =
    "A cycle is predicted where the loop's gain meets -1/N(A). N is the gain of a nonlinearity\n"
    "for a sine of amplitude A. Each nonlinearity is described by itself, without the others.\n\n";

struct DescribeOptions {
  ServoOptions servo;
  std::string format = "text";
  LimitOptions limits;
  std::vector<std::string> plots;
  std::string part;
};

drive::DescribedPart part_of(const std::string& name) {
  using drive::DescribedPart;
  if (name == "elastic-gap") return DescribedPart::elastic_gap;
  if (name == "torque-limit") return DescribedPart::torque_limit;
  if (name == "coulomb-friction") return DescribedPart::coulomb_friction;
  if (name == "dead-band") return DescribedPart::dead_band;
  if (name == "relay") return DescribedPart::relay;
  return DescribedPart::gap_load_held;
}

/// The answer of limit-cycle.
Answer searched(const Drive& drive, LimitedWork& work) {
  TerminalProgress progress(work, "Searching");
  return analyse(drive, {.ceiling = true, .quantization = true}, progress);
}

void check_part(const DescribeOptions& options, Faults& faults) {
  if (options.part.empty()) return;
  faults.require_choice(
      "--part", options.part,
      {"gap", "elastic-gap", "torque-limit", "coulomb-friction", "dead-band", "relay"});
  if (options.plots.empty()) {
    faults.add(
        {"--part", shown(options.part), "must come with --plot: it chooses what to draw", ""});
  }
}

/// The analyses to draw: those of --part, else those of the first part in a loop.
std::vector<drive::DescribingAnalysis> analyses_to_draw(
    const std::vector<drive::DescribingAnalysis>& analyses, const DescribeOptions& options) {
  if (!options.part.empty()) return loop_analyses(analyses, part_of(options.part));
  const auto first = std::find_if(analyses.begin(), analyses.end(), drive::is_in_loop);
  return first == analyses.end() ? std::vector<drive::DescribingAnalysis>{}
                                 : loop_analyses(analyses, first->part);
}

const char* title_of(drive::DescribedPart part) {
  switch (part) {
    case drive::DescribedPart::elastic_gap:
      return "A gap with elastic faces by its describing function";
    case drive::DescribedPart::torque_limit:
      return "The torque limit by its describing function";
    case drive::DescribedPart::coulomb_friction:
      return "Coulomb friction by its describing function";
    case drive::DescribedPart::dead_band:
      return "The dead band by its describing function";
    case drive::DescribedPart::relay:
      return "The relay by its describing function";
    default:
      return "The gap by its describing functions";
  }
}

Plot plot_of(const DescribeReport& report, const DescribeOptions& options) {
  const auto drawn = analyses_to_draw(report.analyses, options);
  if (drawn.empty()) {
    throw InvalidInput(
        {options.part.empty()
             ? Fault{"--plot", "nyquist", "must be left out: this drive feeds nothing back", ""}
             : Fault{"--part", shown(options.part),
                     "must be a part that the drive has inside its loop", ""}});
  }
  return nyquist_plot({.title = title_of(drawn.front().part),
                       .analyses = drawn,
                       .exact = drive::exact_motions(report.answer),
                       .angle = report.angle,
                       .is_normalized = report.is_normalized});
}

ExitStatus run(const DescribeOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "json"});
  const std::vector<PlotFile> plots = read_plots(options.plots, {"nyquist"}, faults);
  check_part(options, faults);
  const std::optional<WrittenDrive> written = resolve_drive(options.servo, files_of(plots), faults);
  const Limits limits = read_limits(options.limits, faults);
  faults.require_none();

  LimitedWork work(limits);
  const Answer answer = searched(written->drive, work);
  const DescribeReport report =
      describe_report_of(written->drive, answer, written->angle, provenance);
  const bool decided = answer.verdict != Verdict::undecided;
  return give({.text = options.format == "json" ? describe_json(report)
                                                : with_bold_headline(describe_text(report)),
               .remark = decided ? "" : "the exact answer is undecided",
               .is_decided = decided,
               .unknown = "the search is not complete"},
              work, plots, [&](const PlotFile&) { return plot_of(report, options); });
}

}  // namespace

void add_describe_command(const Command& app, Action& action) {
  const auto [command, options] = add_verb<DescribeOptions>(
      app, action, "describe", "Compare what describing functions predict with the exact cycle",
      describe_explanation + help_footer(describe_examples), run);
  add_servo_or_drive_options(command, options.servo);
  add_format_option(command, options.format);
  add_plot_option(command, options.plots,
                  "Draw nyquist=FILE, the loop's gain against -1/N, with the exact cycle;");
  command.add_option(
      "--part PART", options.part,
      "Draw this part: gap, elastic-gap, torque-limit, coulomb-friction, dead-band or "
      "relay; default the first part in the loop");
  add_limit_options(command, options.limits);
}

}  // namespace gearlash::cli
