#include "output/drive_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/decimal.hpp"
#include "base/lists.hpp"
#include "base/overloaded.hpp"
#include "base/range_check.hpp"
#include "gearlash/output.hpp"
#include "input/utf8.hpp"
#include "model/parameters.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"
#include "output/json_writer.hpp"
#include "question/drive_notes.hpp"

namespace gearlash {
namespace {

std::string toml_text(std::string_view text) {
  // TOML's basic strings have JSON's escapes.
  return text.empty() ? "\"\"" : json_text(as_utf8(text));
}

/// How numbers are written: the shortest decimals, or with digits by which readers see that they
/// stand for others (Drive::is_rounded).
enum class Decimals : bool { shortest, rounded };

/// A number as TOML, whose integers end at 2⁶³.
std::string bare_text(double value, Decimals decimals = Decimals::shortest) {
  if (decimals == Decimals::rounded && value != 0.0 && std::isfinite(value)) {
    return long_text(value);
  }
  constexpr double least_without_integer = 0x1p63;
  const bool is_long = std::abs(value) >= least_without_integer && std::isfinite(value);
  return is_long ? shortest_scientific_text(value) : exact_text(value);
}

std::string list_text(const std::vector<double>& numbers, Decimals decimals) {
  return "[" + listed(numbers, [&](double one) { return bare_text(one, decimals); }) + "]";
}

std::string number_text(double value, const Dimension* dimension,
                        Decimals decimals = Decimals::shortest) {
  if (dimension == nullptr) {
    const std::string text = bare_text(value, decimals);
    return text == "inf" ? toml_text(text) : text;
  }
  const bool is_rounded = decimals == Decimals::rounded && value != 0.0;
  return toml_text((is_rounded ? long_text(value) : exact_text(value)) + " " +
                   std::string(dimension->unit));
}

Decimals decimals_of(const Parameter& parameter, const Drive& drive) {
  const bool is_rounded = drive.is_rounded && may_be_rounded(parameter, drive);
  return is_rounded ? Decimals::rounded : Decimals::shortest;
}

ParameterValue value_of(const Parameter& parameter, const Drive& drive) {
  const Slot slot = parameter.slot(const_cast<Drive&>(drive));
  if (const auto* choice = std::get_if<Choice>(&slot)) {
    return std::string(parameter.choices[choice->chosen(drive)]);
  }
  if (auto* const* list = std::get_if<std::vector<double>*>(&slot)) return **list;
  if (auto* const* rows = std::get_if<Rows*>(&slot)) return **rows;
  if (auto* const* text = std::get_if<std::string*>(&slot)) return as_utf8(**text);
  const std::optional<double> number = number_in(parameter, drive);
  return number ? ParameterValue(*number) : ParameterValue();
}

/// The value as TOML; empty if it is not given and has no default.
std::string value_text(const Parameter& parameter, const Drive& drive) {
  const Decimals decimals = decimals_of(parameter, drive);
  return std::visit(
      Overloaded{
          [](std::monostate) { return std::string(); },
          [&](double number) { return number_text(number, parameter.dimension(drive), decimals); },
          [](const std::string& text) { return text.empty() ? "" : toml_text(text); },
          [&](const std::vector<double>& list) { return list_text(list, decimals); },
          [&](const Rows& rows) {
            return "[" + listed(rows, [&](const auto& row) { return list_text(row, decimals); }) +
                   "]";
          }},
      value_of(parameter, drive));
}

const Distribution* distribution_of(const Parameter& parameter, const TolerancedDrive& drive) {
  for (const ParameterTolerance& varied : drive.varied) {
    if (find_parameter(varied.path, drive.nominal) == &parameter) return &varied.distribution;
  }
  return nullptr;
}

/// The value with its tolerance as TOML, in one of the forms of input/toleranced_value.hpp.
std::string toleranced_text(const Distribution& varies, const Parameter& parameter,
                            const Drive& drive) {
  const auto number = [&](double value) {
    return number_text(value, parameter.dimension(drive), decimals_of(parameter, drive));
  };
  if (const auto* exact = std::get_if<ExactValue>(&varies)) return number(exact->value);
  if (const auto* about = std::get_if<UniformAbout>(&varies)) {
    return fmt::format("{{ value = {}, tolerance = {} }}", number(about->nominal),
                       number(about->tolerance));
  }
  if (const auto* between = std::get_if<UniformBetween>(&varies)) {
    const double nominal = number_in(parameter, drive).value_or(between->min);
    return fmt::format("{{ value = {}, min = {}, max = {} }}", number(nominal),
                       number(between->min), number(between->max));
  }
  if (const auto* normal = std::get_if<Normal>(&varies)) {
    const auto end = [&](const char* name, const std::optional<double>& value) {
      return value ? fmt::format(", {} = {}", name, number(*value)) : std::string();
    };
    return fmt::format("{{ value = {}, normal = {}{}{} }}", number(normal->mean),
                       number(normal->standard_deviation), end("min", normal->min),
                       end("max", normal->max));
  }
  const auto lot_text = [&](const Lot& lot) {
    return fmt::format("{{ value = {}, weight = {} }}", number(lot.value), bare_text(lot.weight));
  };
  return fmt::format("{{ lots = [{}] }}", listed(std::get<DiscreteLots>(varies).lots, lot_text));
}

/// A drive with the same parts and kinds, and defaults for everything else.
Drive with_defaults(const Drive& drive) {
  Drive fresh;
  fresh.is_rounded = drive.is_rounded;
  if (drive.servo) fresh.servo.emplace();
  if (drive.sampling) fresh.sampling.emplace();
  if (drive.reference) fresh.reference.emplace(0.0);
  if (drive.load_torque) fresh.load_torque.emplace(0.0);
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!parameter.is_required && parameter.path != "contact.kind") continue;
    Slot slot = parameter.slot(fresh);
    if (auto* choice = std::get_if<Choice>(&slot)) choice->choose(fresh, choice->chosen(drive));
  }
  return fresh;
}

enum class Followers : bool { left_out, written };

/// Whether the parameter has the value of another one, because none is given.
bool follows(const Parameter& parameter, const Drive& drive) {
  if (parameter.otherwise.empty()) return false;
  const Slot slot = parameter.slot(const_cast<Drive&>(drive));
  const auto* given = std::get_if<std::optional<double>*>(&slot);
  return given != nullptr && !**given;
}

/// A drive whose tables TOML can name. One that it cannot, whose name is not UTF-8, is written with
/// its points.
Drive with_writable_tables(Drive drive) {
  for (std::optional<Signal>* signal : {&drive.reference, &drive.load_torque}) {
    auto* table = *signal ? std::get_if<TableSignal>(&**signal) : nullptr;
    if (table != nullptr && as_utf8(table->file) != table->file) table->file.clear();
  }
  return drive;
}

std::string toml_of(const TolerancedDrive& toleranced, Followers followers) {
  const Drive drive = with_writable_tables(toleranced.nominal);
  std::string text;
  std::string_view section;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (!exists(parameter, drive)) continue;
    if (followers == Followers::left_out && follows(parameter, drive)) continue;
    const Distribution* varies = distribution_of(parameter, toleranced);
    const std::string value = varies == nullptr ? value_text(parameter, drive)
                                                : toleranced_text(*varies, parameter, drive);
    if (value.empty()) continue;
    if (parameter.section() != section) {
      section = parameter.section();
      text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
    }
    text += fmt::format("{} = {}\n", parameter.key(), value);
  }
  return text;
}

}  // namespace

std::string to_toml(const Drive& drive) { return to_toml(TolerancedDrive{drive, {}}); }

std::string to_toml(const TolerancedDrive& drive) { return toml_of(drive, Followers::written); }

std::string given_toml(const TolerancedDrive& drive) { return toml_of(drive, Followers::left_out); }

ByName<ParameterValue> parameter_values(const Drive& drive) {
  ByName<ParameterValue> values;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (exists(parameter, drive)) values.emplace_back(parameter.path, value_of(parameter, drive));
  }
  return values;
}

std::vector<std::string> defaults_taken(const Drive& drive) {
  const Drive fresh = with_defaults(drive);
  std::vector<std::string> paths;
  for (const Parameter& parameter : all_parameters_of_drives()) {
    if (parameter.is_required || !exists(parameter, drive) || !exists(parameter, fresh)) continue;
    // "The other parameter's value" is a default too.
    const bool follows =
        !parameter.otherwise.empty() &&
        value_text(parameter, drive) == value_text(*find_parameter(parameter.otherwise), drive);
    if (follows || value_text(parameter, drive) == value_text(parameter, fresh)) {
      paths.emplace_back(parameter.path);
    }
  }
  return paths;
}

namespace {

/// The gains at both shafts, and what the drive's answers note.
std::string further_remarks(const Drive& drive) {
  const auto gain_text = [](const PlacedGain& gain) {
    return fmt::format("{} {:.4g} {} at the joint, {:.4g} {} at the motor",
                       gain.path.substr(gain.path.find('.') + 1), gain.at_joint, gain.unit,
                       gain.at_motor, gain.unit);
  };
  const std::string gains = listed(placed_gains(drive), gain_text, "; ");
  std::string remarks = gains.empty() ? "" : wrapped("Gains: " + gains + ".", usual_columns, "# ");
  for (const Note& note : notes_on(drive)) remarks += wrapped(note.text, usual_columns, "# ");
  return remarks;
}

/// The registers as a controller in SI units; nothing without a firmware.
std::optional<ConvertedFirmware> converted_firmware(const Drive& drive) {
  if (!drive.controller.firmware) return std::nullopt;
  const FirmwareFacts& facts = all_firmwares()[drive.controller.firmware->index()];
  const Conversion conversion = converted(drive);
  const auto shaft = static_cast<std::size_t>(conversion.controller.shaft);
  return ConvertedFirmware{.name = facts.name,
                           .source = facts.source,
                           .left_out = facts.left_out,
                           .shaft = find_parameter("controller.shaft")->choices[shaft],
                           .gains = conversion.gains};
}

}  // namespace

std::string show_text(const Drive& drive) {
  std::string remark;
  if (const auto closed = proportional_servo(drive)) {
    const NormalizedServo& servo = closed->servo;
    remark = fmt::format(
        "# Normal form: damping {:.4g}, inertia ratio {:.4g}, friction ratio {:.4g}, natural "
        "frequency {:.4g} rad/s.\n",
        servo.damping, servo.inertia_ratio, servo.friction_ratio, closed->natural_frequency);
  } else {
    const drive::TimeScales scales = drive::time_scales(reduce(drive));
    remark = fmt::format(
        "# Linear loop with the gap closed: slowest swing {:.4g} s, settling time constant {:.4g} "
        "s.\n",
        scales.swing, scales.settling);
  }
  return remark + further_remarks(drive) + to_toml(drive);
}

ShownDrive shown_drive(const Drive& drive, const Provenance& provenance) {
  ShownDrive shown{.drive = drive,
                   .gains = placed_gains(drive),
                   .firmware = converted_firmware(drive),
                   .notes = notes_on(drive),
                   .provenance = provenance};
  if (const auto closed = proportional_servo(drive)) {
    const NormalizedServo& servo = closed->servo;
    shown.normal_form = {.damping = servo.damping,
                         .inertia_ratio = servo.inertia_ratio,
                         .friction_ratio = servo.friction_ratio,
                         .backlash = servo.backlash,
                         .restitution = servo.restitution,
                         .natural_frequency = closed->natural_frequency};
  } else {
    shown.linear_loop = drive::time_scales(reduce(drive));
  }
  return shown;
}

}  // namespace gearlash
