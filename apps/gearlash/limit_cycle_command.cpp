// gearlash limit-cycle: does it hunt, how big and how fast?
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "command.hpp"
#include "input/units.hpp"
#include "machine_faults.hpp"
#include "output/attractor_report.hpp"
#include "output/change_report.hpp"
#include "output/limit_cycle_report.hpp"
#include "output/output_file.hpp"
#include "picture/picture.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

constexpr char examples[] =
    "  gearlash limit-cycle examples/elinco-fd162.toml --plot hunting.svg\n"
    "  gearlash limit-cycle examples/elinco-fd162.toml --backlash \"12 arcmin\"\n"
    "  gearlash limit-cycle --damping 0.19 --inertia-ratio 2 --friction-ratio 1/10 --backlash 0.3\n"
    "  gearlash limit-cycle examples/elinco-fd162.toml --sensitivities --plot tornado=size.svg\n"
    "  gearlash limit-cycle examples/normalized.toml --format json | jq .cycles[0].size\n"
    "  gearlash limit-cycle examples/robot-joint.toml\n";

struct LimitCycleOptions {
  ServoOptions servo;
  std::string format = "text";
  std::string plot;
  bool margins = false;
  bool sensitivities = false;
};

constexpr std::string_view tornado = "tornado=";

/// The file of --plot without what is drawn into it.
std::string plot_file(const LimitCycleOptions& options) {
  return options.plot.starts_with(tornado) ? options.plot.substr(tornado.size()) : options.plot;
}

/// A number that is easily said, not far above `value`.
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= factor * power) return factor * power;
  }
  return 10.0 * power;
}

/// A step from rest, large enough that the way to the cycle is seen and small enough that the cycle
/// is too. Its size is free: everything scales with the backlash.
struct Step {
  double size;   ///< rad
  double until;  ///< normalised
};

Step step_to_draw(const LimitCycleReport& report) {
  const NormalizedServo& servo = report.servo;
  const AngleUnit& unit = report.units.angle;
  const auto rounded = [&](double size) {
    return unit.radians * round_up(unit.from_radians(size));
  };
  constexpr double turn = 2.0 * std::numbers::pi;
  if (const LimitCycle* cycle = largest_stable(report.analysis)) {
    // Until a disturbance has died to a hundredth, which the lines of the cycle hide; but of a
    // cycle that is reached slowly no more than can be told apart.
    const double periods = std::log(0.01) / std::log(std::abs(cycle->multiplier));
    return {rounded(1.8 * std::max(cycle->size, cycle->motor_size)),
            cycle->period * std::clamp(std::ceil(periods), 4.0, 8.0)};
  }
  const double settling_time =
      servo.damping < 1.0 ? 5.0 / std::max(servo.damping, 0.01) : 10.0 * servo.damping;
  return {servo.backlash > 0.0 ? rounded(4.0 * servo.backlash) : 1.0,
          servo.damping < 1.0 ? std::clamp(settling_time, 2.0 * turn, 20.0 * turn) : settling_time};
}

/// From rest on a face; but where the faces may come to rest together after such a step, small
/// motion in the gap, which grows into the cycle.
ServoState start_to_draw(const LimitCycleReport& report, const Step& step) {
  const LimitCycle* cycle = largest_stable(report.analysis);
  if (cycle == nullptr || !report.analysis.rests_engaged) {
    return engaged_start(report.servo, 0.0, 0.0, step.size);
  }
  constexpr double share = 0.2;
  const ServoState& start = cycle->start;
  const double load_position = step.size + share * start.load_position;
  return {load_position + (start.motor_position - start.load_position), share * start.motor_speed,
          load_position, share * start.load_speed};
}

std::string draw(const LimitCycleReport& report, PictureFormat format) {
  const Step step = step_to_draw(report);
  MotionPicture picture{.title = verdict_line(report),
                        .servo = report.servo,
                        .trajectory = simulate(report.servo, start_to_draw(report, step),
                                               {.until = step.until, .reference = step.size}),
                        .reference = step.size,
                        .cycle = std::nullopt,
                        .units = report.units};
  if (const LimitCycle* cycle = largest_stable(report.analysis)) picture.cycle = *cycle;
  return draw_phase_plane(picture, format);
}

std::string text_for_terminal(const LimitCycleReport& report) {
  const std::string text = limit_cycle_text(report);
  const std::size_t end_of_verdict = text.find('\n');
  return emphasized(text.substr(0, end_of_verdict)) + text.substr(end_of_verdict);
}

/// Verdicts that need a number which the search did not find are no answer.
bool is_decided(const LimitCycleAnalysis& analysis) {
  switch (analysis.verdict) {
    case Verdict::hunts:
    case Verdict::hunts_if_disturbed:
    case Verdict::hunts_irregularly:
      return largest_stable(analysis) != nullptr || std::isfinite(analysis.irregular_size);
    case Verdict::undecided:
      return false;
    default:
      return true;
  }
}

/// Then margins take no time: contact is plastic.
bool has_closed_form(const NormalizedServo& servo) {
  return servo.damping > 0.0 && servo_dynamics(servo).plastic_contact();
}

/// Options that change normalised numbers leave a data sheet behind.
ChangeableDrive drive_of(ServoFile file, const ServoOptions& options) {
  if (options.damping || options.inertia_ratio || options.friction_ratio) file.datasheet.reset();
  return changeable_drive(file);
}

DriveSensitivity sensitivity_of(const ServoFile& file, const ChangeableDrive& drive) {
  return drive.is_normalized() ? drive_sensitivity(drive)
                               : datasheet_sensitivity(datasheet_of(file));
}

std::string draw(const LimitCycleReport& report, const LimitCycleOptions& options,
                 PictureFormat format) {
  if (!options.plot.starts_with(tornado)) return draw(report, format);
  const BarChart chart = tornado_of(*report.sensitivity);
  if (chart.bars.empty()) {
    throw InvalidInput({{"--plot", shown(options.plot),
                         "must be left out: there are no sensitivities of this servo", ""}});
  }
  return draw_bar_chart(chart, format);
}

/// Proved of the data of the file: of a data sheet's numbers with their units, or of the decimals
/// of a normalised servo.
LimitCycleAnalysis proved_analysis(const ServoFile& file, const ChangeableDrive& drive,
                                   bool is_drive) {
  if (!drive.is_normalized()) return enclose_limit_cycles(file.servo, drive.box().servo);
  if (is_drive && file.drivetrain) {
    return enclose_limit_cycles(file.servo, box_between(*file.drivetrain, *file.drivetrain).servo);
  }
  // Of a data sheet with options some numbers are typed, the others worked out.
  const bool is_typed = !is_drive && !file.datasheet;
  return enclose_limit_cycles(file.servo, is_typed ? Reading::decimal : Reading::converted);
}

/// `is_drive`: it was described as a drive, whose closed form this is.
ExitStatus analyse_servo(const ServoFile& file, bool is_drive, const LimitCycleOptions& options,
                         PictureFormat picture_kind, const Provenance& provenance) {
  const ChangeableDrive drive = drive_of(file, options.servo);
  LimitCycleReport report{.servo = file.servo,
                          .analysis = proved_analysis(file, drive, is_drive),
                          .units = report_units(file),
                          .provenance = provenance,
                          .is_drive = is_drive};
  // At the very ends of the ranges rounding may put the drive's ratios beyond them.
  const bool is_sound = validate(drive.drivetrain()).empty();
  if (is_sound && (options.margins || has_closed_form(file.servo))) {
    Progress progress("Margins");
    report.drive = drive;
    report.margin = hunting_margin(drive, [&](double share) { progress.show(share); });
  }
  if (options.sensitivities || options.plot.starts_with(tornado)) {
    report.sensitivity = is_sound ? sensitivity_of(file, drive) : DriveSensitivity{};
  }
  Extras extras;
  if (!options.plot.empty()) {
    extras.make([&] { write_file(plot_file(options), draw(report, options, picture_kind)); });
  }
  write_file("-", options.format == "json" ? limit_cycle_json(report) : text_for_terminal(report));
  if (is_decided(report.analysis)) return extras.status(ExitStatus::done);
  report_lines(verdict_line(report));
  return extras.status(ExitStatus::undecided);
}

// ---- drives -------------------------------------------------------------------------------------

std::string text_for_terminal(const AttractorReport& report) {
  const std::string text = attractor_text(report);
  const std::size_t end_of_verdict = text.find('\n');
  return emphasized(text.substr(0, end_of_verdict)) + text.substr(end_of_verdict);
}

/// A drive without a closed form: what a search finds.
ExitStatus search_drive(const DriveFile& file, const LimitCycleOptions& options,
                        PictureFormat picture_kind, const Provenance& provenance) {
  AttractorReport report{.file = file, .search = {}, .provenance = provenance};
  {
    Progress progress("Searching");
    drive::AttractorOptions search;
    search.go_on = [&](double share) {
      progress.show(share);
      return true;
    };
    report.search = drive::find_attractors(file.drive, search);
  }
  Extras extras;
  if (!options.plot.empty()) {
    extras.make([&] { write_file(options.plot, draw_attractor(report, picture_kind)); });
  }
  write_file("-", options.format == "json" ? attractor_json(report) : text_for_terminal(report));
  if (drive::verdict_of(report.search) != drive::DriveVerdict::undecided) {
    return extras.status(ExitStatus::done);
  }
  report_lines(verdict_line(report));
  return extras.status(ExitStatus::undecided);
}

/// What only the closed form tells.
void refuse_for_drives(const LimitCycleOptions& options, Faults& faults) {
  const std::string why =
      "must be left out: of a drive without a closed form cycles are found, not margins and "
      "sensitivities";
  if (options.margins) faults.add({"--margins", "given", why, ""});
  if (options.sensitivities) faults.add({"--sensitivities", "given", why, ""});
  if (options.plot.starts_with(tornado)) faults.add({"--plot", shown(options.plot), why, ""});
}

ExitStatus run(const LimitCycleOptions& options, const Provenance& provenance) {
  Faults faults;
  faults.require_choice("--format", options.format, {"text", "json"});
  const PictureFormat picture_kind = faults.collect(
      [&] {
        return options.plot.empty() ? PictureFormat::svg
                                    : picture_format("--plot", plot_file(options));
      },
      PictureFormat::svg);
  faults.require_distinct({"SERVO.toml", options.servo.file}, {{"--plot", plot_file(options)}});
  const ServoOrDriveFile described = resolve_servo_or_drive(options.servo, faults);
  const auto* drive = std::get_if<DriveFile>(&described);
  const std::optional<ServoFile> closed =
      drive != nullptr && faults.none() ? closed_form_of(*drive) : std::nullopt;
  if (drive != nullptr && !closed) {
    refuse_for_drives(options, faults);
    faults.require_none();
    return search_drive(*drive, options, picture_kind, provenance);
  }
  faults.require_none();
  return analyse_servo(closed ? *closed : std::get<ServoFile>(described), closed.has_value(),
                       options, picture_kind, provenance);
}

}  // namespace

void add_limit_cycle_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<LimitCycleOptions>();
  CLI::App* command = app.add_subcommand("limit-cycle", "does it hunt, how big and how fast?");
  add_servo_or_drive_options(*command, options->servo);
  command->add_option("--format", options->format, "text (default) or json")->type_name("FORMAT");
  command
      ->add_option("--plot", options->plot,
                   "draw the cycle in the phase plane, over a step response\n"
                   "that leads to it; or, after tornado=, what its size depends on;\n"
                   "FILE ends in .svg, .png or .pdf")
      ->type_name("FILE");
  command->add_flag("--margins", options->margins,
                    "how far each number may change until hunting ends or begins; shown\n"
                    "anyway but with bounces, where it takes a minute or more");
  command->add_flag("--sensitivities", options->sensitivities,
                    "exact sensitivities to every number, in per cent for one per cent");
  command->footer(help_footer(examples));
  command->callback([options, &action] {
    action = [options](const Provenance& provenance) { return run(*options, provenance); };
  });
}

}  // namespace gearlash::cli
