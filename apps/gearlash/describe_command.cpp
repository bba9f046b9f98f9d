// gearlash describe: what describing functions predict, beside the exact cycle.
#include "base/lists.hpp"
#include "gearlash/analyse.hpp"
#include "gearlash/units.hpp"
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
    "A cycle is predicted where the loop's gain meets -1/N(A). N is the gain of a nonlinearity "
    "for a sine of amplitude A. Each nonlinearity is described by itself, without the others.\n\n";

struct DescribeOptions : QuestionOptions {
  std::string part;
};

void check_part(const DescribeOptions& options, Faults& faults) {
  if (options.part.empty()) return;
  faults.require_choice("--part", options.part, parts_to_draw());
  if (options.plots.empty()) {
    faults.add({"--part", shown(options.part), "must come with --plot: it chooses what to draw"});
  }
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
  const Answer answer = analyse(written->drive, {.ceiling = true, .causes = true},
                                TerminalProgress(work, "Searching").as_argument());
  const DescribeReport report = describe_report_of(written->drive, answer, provenance);
  const bool decided = answer.verdict != Verdict::undecided;
  return give({.text = options.format == "json" ? describe_json(report)
                                                : with_bold_headline(describe_text(report)),
               .remark = decided ? "" : "the exact answer is undecided",
               .is_decided = decided,
               .unknown = "the search is not complete"},
              work, plots, [&](const PlotFile&) { return nyquist_plot(report, options.part); });
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
