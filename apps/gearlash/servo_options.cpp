#include "servo_options.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char drive_group[] = "Drive";
constexpr char servo_group[] = "Servo of 1960, without a file";

/// The help and the type of an option for each of normal_form_numbers, which describe a servo
/// without a file.
constexpr std::pair<const char*, const char*> number_options[] = {
    {"Set the damping ratio: 0, or 1e-15 to 1000", "NUMBER"},
    {"Set the inertia ratio, load to motor: 0 to inf", "NUMBER"},
    {"Set the friction ratio, load to total: 0 to 1", "NUMBER"},
    {"Set the backlash at the load, face to face, also of a file's drive: \"12 arcmin\"; of a "
     "normal "
     "form a bare number is in rad",
     "ANGLE"},
    {"Set the restitution: 0 (plastic, the default) to 1 (elastic)", "NUMBER"}};

struct SpecificationOption {
  const char* name;
  const char* path;
  const char* help;
};

/// They are settings of the drive.
constexpr SpecificationOption specification_options[] = {
    {"--specification", "specification.error",
     "Set the error of the load that is permitted in the end: \"2 arcmin\""},
    {"--step", "specification.step",
     "Set the step of the reference whose response is measured; default 1 deg, of a normal form 1 "
     "rad"},
    {"--band", "specification.band",
     "Set the distance within which a motion has settled; default the specification, else a step "
     "of the encoder at the load, else 1 % of the step"}};

/// Whether the number is one of the ratios that a drive with [motor] has not by itself.
bool is_ratio(const NormalFormNumber& number) {
  return number.path.starts_with("servo.") && number.path != "servo.backlash";
}

struct TypedNumber {
  const NormalFormNumber& number;
  const std::string& text;
};

/// The numbers of the normal form that options give.
std::vector<TypedNumber> typed_numbers(const ServoOptions& options) {
  std::vector<TypedNumber> typed;
  for (std::size_t i = 0; i < options.numbers.size(); ++i) {
    if (options.numbers[i]) typed.push_back({normal_form_numbers[i], *options.numbers[i]});
  }
  return typed;
}

/// As --set would give it. A bare backlash of a normal form is in radians.
Setting setting_of(const TypedNumber& typed, bool is_normal_form) {
  const std::string path(path_of(typed.number, is_normal_form));
  const bool is_bare = path == "servo.backlash" && bare_number(typed.text);
  return {path, typed.text + (is_bare ? " rad" : "")};
}

std::string permitted_without_file(std::string_view field) {
  if (field == "backlash") return "must be an angle such as 0.1 (rad) or \"12 arcmin\"";
  return "must be " + permitted_values(field);
}

/// The text of a drive, the name of its source, and the folder of the files that it names.
struct Source {
  std::string text;
  std::string name;
  std::filesystem::path folder;
};

/// The file, or the normal form that options describe.
Source source_of(const ServoOptions& options) {
  if (options.file == "-") return {read_standard_input(largest_drive_file), "standard input", {}};
  if (!options.file.empty()) {
    const std::filesystem::path path = options.file;
    return {read_text_file(path, largest_drive_file), path.string(), path.parent_path()};
  }
  return {"[servo]\n", "the command line", {}};
}

/// Of --set.
std::vector<Setting> settings_of(const ServoOptions& options, Faults& faults) {
  std::vector<Setting> settings;
  for (const std::string& text : options.settings) {
    faults.collect([&] { return settings.push_back(read_setting(text)), 0; }, 0);
  }
  for (std::size_t i = 0; i < options.asked.size(); ++i) {
    if (!options.asked[i]) continue;
    const auto& [name, path, help] = specification_options[i];
    const std::string& text = *options.asked[i];
    const auto read = [&] { return to_si(name, text, dimensions::angle); };
    const double angle = faults.collect(read, std::nan(""));
    const bool may_be_negative = std::string_view(path) == "specification.step";
    if (angle == 0.0 || (angle < 0.0 && !may_be_negative)) {
      faults.add(name, shown(text),
                 may_be_negative ? "must be an angle other than 0" : "must be an angle above 0");
    } else if (!std::isnan(angle)) {
      settings.push_back({path, text});
    }
  }
  return settings;
}

}  // namespace

void add_set_option(const Command& command, ServoOptions& options) {
  command.add_option("--set PATH=VALUE", options.settings,
                     "Set any parameter of the drive by its path, with its unit: "
                     "gearbox.backlash=\"12 arcmin\"; repeatable; gearlash show lists the paths",
                     {.group = drive_group, .takes_one_word = true});
}

void add_drive_options(const Command& command, ServoOptions& options,
                       const std::string& sensor_help) {
  add_set_option(command, options);
  command.add_option("--sensor SHAFT", options.sensor, sensor_help, {.group = drive_group});
  for (std::size_t i = 0; i < options.asked.size(); ++i) {
    const SpecificationOption& option = specification_options[i];
    command.add_option(std::string(option.name) + " ANGLE", options.asked[i], option.help,
                       {.group = drive_group});
  }
  for (std::size_t i = 0; i < options.numbers.size(); ++i) {
    const auto& [help, type] = number_options[i];
    const std::string name = option_name(normal_form_numbers[i].name) + " " + type;
    command.add_option(name, options.numbers[i], help, {.group = servo_group});
  }
}

namespace {

namespace fs = std::filesystem;

bool may_be_lost(const fs::path& file) {
  std::error_code error;
  const bool is_device = fs::exists(file, error) && !fs::is_regular_file(file, error);
  return !file.empty() && file != "-" && !is_device;
}

bool is_same_file(const fs::path& one, const fs::path& other) {
  std::error_code error;
  const auto whole = [&](const fs::path& path) {
    return destination_of(fs::absolute(path, error));
  };
  return whole(one) == whole(other) || fs::equivalent(one, other, error);
}

}  // namespace

std::string option_name(std::string field) {
  std::replace(field.begin(), field.end(), '_', '-');
  return "--" + field;
}

void add_servo_options(const Command& command, ServoOptions& options) {
  command.add_option("DRIVE.toml", options.file,
                     "Read the servo from this file: a data sheet or normalised servo "
                     "(docs/reference/data-sheets.md); - is standard input");
  add_drive_options(command, options, "Set the shaft with the position sensor: load");
}

void add_servo_or_drive_options(const Command& command, ServoOptions& options) {
  command.add_option(
      "DRIVE.toml", options.file,
      "Read the drive from this file: a data sheet or normalised servo "
      "(docs/reference/data-sheets.md), or any drive (docs/reference/drives.md); - is "
      "standard input");
  add_drive_options(command, options,
                    "Set the shaft with the position sensor: load, motor or both (position of the "
                    "load, speed of the motor)");
}

void Faults::add(Fault fault) {
  if (!contains(faults_, fault)) faults_.push_back(std::move(fault));
}

void Faults::require_choice(const std::string& field, const std::string& value,
                            const std::vector<std::string>& choices) {
  if (contains(choices, value)) return;
  add(field, shown(value), "must be " + alternatives(choices) + guess_of(choices, value));
}

void Faults::refuse_beside_brief(const std::vector<std::pair<const char*, std::string>>& options) {
  for (const auto& [option, value] : options) {
    if (value.empty()) continue;
    add(option, shown(value), "must be left out, or --brief, which prints the headline alone");
  }
}

void Faults::require_distinct(std::vector<FileUse> others, const std::vector<FileUse>& outputs) {
  for (const FileUse& output : outputs) {
    if (!may_be_lost(output.file)) continue;
    const FileUse* same = first_of(
        others, [&](const FileUse& other) { return is_same_file(output.file, other.file); });
    if (same != nullptr) {
      add(output.use, shown(output.file),
          std::string("must not be the file of ") + (same->use == output.use ? "another " : "") +
              same->use + ", " + shown(same->file));
    }
    others.push_back(output);
  }
}

void Faults::require_writable(const std::vector<FileUse>& outputs) {
  for (const FileUse& output : outputs) {
    if (output.file.empty() || output.file == "-") continue;
    const std::string why = why_unwritable(output.file);
    if (why.empty()) continue;
    add(output.use, shown(output.file, std::string::npos),
        "must be a file that can be written (" + why + ")");
  }
}

Axis collect_axis(const std::function<Axis(std::string* left_out)>& read, Faults& faults) {
  std::string left_out;
  Axis axis = faults.collect([&] { return read(&left_out); }, Axis{});
  report_lines(left_out);
  return axis;
}

std::vector<FileUse> files_of_tables(Drive drive, const std::string& file) {
  return of_each(named_tables(drive), [&](const NamedTable& table) {
    return FileUse{std::string(table.path), (fs::path(file).parent_path() / *table.file).string()};
  });
}

namespace {

/// Renames faults to the options that caused them.
std::vector<Fault> named_as_typed(std::vector<Fault> faults, const ServoOptions& options) {
  const bool has_file = !options.file.empty();
  for (Fault& fault : faults) {
    if (!has_file) fault.where.clear();
    if (options.sensor && (fault.path == "sensor.position" || fault.path == "loop.sensor")) {
      fault.path = "--sensor";
      fault.where.clear();
    }
    for (std::size_t i = 0; i < options.asked.size(); ++i) {
      if (!options.asked[i] || fault.path != specification_options[i].path) continue;
      fault.path = specification_options[i].name;
      fault.where.clear();
    }
    for (std::size_t i = 0; i < options.numbers.size(); ++i) {
      const std::optional<std::string>& typed = options.numbers[i];
      const NormalFormNumber& number = normal_form_numbers[i];
      const bool is_it = fault.path == number.path || fault.path == path_of(number, false) ||
                         fault.path == number.name;
      if (!is_it || (has_file && !typed)) continue;
      fault.path = option_name(number.name);
      fault.where.clear();
      if (typed) {
        fault.value = shown(*typed);
      } else {
        fault.permitted = permitted_without_file(number.name) + "; or give DRIVE.toml";
      }
      break;
    }
  }
  return faults;
}

/// The normal form of a drive with the numbers changed by options. The natural frequency stays.
WrittenDrive changed_normal_form(const WrittenDrive& written, const ServoOptions& options) {
  const std::optional<Drive> form = normal_form_of(written.drive);
  WrittenDrive changed{.drive = form.value_or(written.drive), .tolerances = {}};
  changed.drive.angle_unit = written.drive.angle_unit;
  Faults faults;
  for (const TypedNumber& typed : typed_numbers(options)) {
    if (!is_ratio(typed.number)) continue;
    const std::string field = option_name(typed.number.name);
    const auto set_number = [&] {
      return set(changed.drive, typed.number.path, read_number(field, typed.text)), 0;
    };
    if (form) {
      faults.collect(set_number, 0);
    } else {
      faults.add(field, shown(typed.text),
                 "must be left out: the drive has no normal form with this number");
    }
  }
  faults.require_none();
  require_none(gearlash::faults(changed.drive));
  return changed;
}

WrittenDrive read_drive_as_typed(const ServoOptions& options, std::vector<Setting> settings) {
  const Source source = source_of(options);
  bool is_normal_form = false;
  const auto settings_of_form = [&](bool is_form) {
    is_normal_form = is_form;
    std::vector<Setting> numbers;
    for (const TypedNumber& typed : typed_numbers(options)) {
      if (is_form || !is_ratio(typed.number)) numbers.push_back(setting_of(typed, is_form));
    }
    // The last one holds: --set changes a servo of options, which change the drive of a file.
    const auto place = options.file.empty() ? settings.begin() : settings.end();
    settings.insert(place, numbers.begin(), numbers.end());
    if (options.sensor) settings.push_back({"sensor.position", *options.sensor});
    return settings;
  };
  const WrittenDrive written =
      parse_drive_by_form(source.text, source.name, source.folder, settings_of_form);
  const bool has_ratio =
      any_of(typed_numbers(options), [](const TypedNumber& one) { return is_ratio(one.number); });
  return is_normal_form || !has_ratio ? written : changed_normal_form(written, options);
}

}  // namespace

Target collect_target(const std::string& text, const Drive* drive, Faults& faults) {
  const bool has_time = drive == nullptr || !is_normalized(*drive);
  const bool has_unit = drive != nullptr && !drive->servo;
  return faults.collect(
      [&] {
        return read_target("--target", text, has_time ? TimeScale::known : TimeScale::unknown,
                           has_unit ? BareNumbers::refused : BareNumbers::in_si);
      },
      Target{});
}

std::uint64_t collect_whole(const char* field, const std::string& text, std::uint64_t least,
                            std::uint64_t most, Faults& faults) {
  return faults.collect([&] { return read_whole(field, text, least, most); }, least);
}

std::vector<Axis> collect_axes(const char* field, const std::vector<std::string>& texts,
                               const Drive& drive, AxisReader read, Faults& faults) {
  const auto read_one = [&](const std::string& text, std::string* left_out) {
    return read(field, text, drive, left_out);
  };
  return collect_axes(texts, read_one, faults);
}

std::vector<Axis> collect_axes_to_search(const std::vector<std::string>& texts, const Drive& drive,
                                         Faults& faults) {
  std::vector<Axis> axes = collect_axes("--parameters", texts, drive, read_axis_to_search, faults);
  for (Axis axis : axes) {
    const bool is_typed =
        any_of(texts, [&](const std::string& text) { return text.starts_with(axis.path + "="); });
    const std::string unsound = is_typed ? cut_to_sound(axis, drive) : "";
    if (!unsound.empty()) report_lines("--parameters " + axis.path + ": left out: " + unsound);
  }
  return axes;
}

double read_time(const char* field, const std::string& text, Faults& faults) {
  const auto read = [&] { return read_measured(field, text, dimensions::time).si; };
  const double time = faults.collect(read, 1.0);
  if (!(time > 0.0)) faults.add(field, shown(text), "must be positive, in s");
  return time;
}

double read_share(const char* field, const std::string& text, Faults& faults) {
  const double share = faults.collect([&] { return gearlash::read_share(field, text); }, 0.5);
  if (!(share > 0.0 && share <= 1.0)) {
    faults.add(field, shown(text), "must be a share above 0 and up to 1, or \"95 %\"");
  }
  return share;
}

namespace {

/// Parameters that --set gives twice, under one name or two.
void refuse_set_twice(const std::vector<std::string>& settings, Faults& faults) {
  const auto path_in = [](const std::string& setting) {
    const std::string path(trimmed(setting.substr(0, setting.find('='))));
    const Parameter* parameter = find_parameter(path);
    return parameter == nullptr || path.ends_with(']') ? path : std::string(parameter->path);
  };
  for (std::size_t i = 0; i < settings.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (path_in(settings[j]) != path_in(settings[i])) continue;
      faults.add("--set", shown(settings[i]), "must be left out, or --set " + shown(settings[j]));
    }
  }
}

/// Options whose parameter --set gives too.
void refuse_given_twice(const ServoOptions& options, Faults& faults) {
  const auto check = [&](const std::string& option, const std::optional<std::string>& typed,
                         const std::vector<std::string_view>& paths) {
    for (const std::string& setting : options.settings) {
      const bool is_same = contains(paths, trimmed(setting.substr(0, setting.find('='))));
      if (!typed || !is_same) continue;
      faults.add(option, shown(*typed), "must be left out, or --set " + shown(setting));
    }
  };
  for (std::size_t i = 0; i < options.numbers.size(); ++i) {
    const NormalFormNumber& number = normal_form_numbers[i];
    check(option_name(number.name), options.numbers[i], {number.path, path_of(number, false)});
  }
  for (std::size_t i = 0; i < options.asked.size(); ++i) {
    check(specification_options[i].name, options.asked[i], {specification_options[i].path});
  }
  check("--sensor", options.sensor, {"sensor.position"});
  refuse_set_twice(options.settings, faults);
}

std::optional<WrittenDrive> read_drive_or_faults(const ServoOptions& options, Faults& faults) {
  try {
    return read_drive_as_typed(options, settings_of(options, faults));
  } catch (const InvalidInput& error) {
    faults.add(named_as_typed(error.faults(), options));
    return std::nullopt;
  }
}

}  // namespace

bool has_drive(const ServoOptions& options) {
  return !options.file.empty() || !options.settings.empty() || !typed_numbers(options).empty();
}

std::optional<WrittenDrive> resolve_drive(const ServoOptions& options,
                                          const std::vector<FileUse>& outputs, Faults& faults) {
  if (!has_drive(options)) {
    faults.add("DRIVE.toml", "",
               "must be a drive's file, such as examples/robot-joint.toml; or give --damping, "
               "--inertia-ratio, --friction-ratio and --backlash of a normal form");
    faults.require_writable(outputs);
    return std::nullopt;
  }
  refuse_given_twice(options, faults);
  std::optional<WrittenDrive> written = read_drive_or_faults(options, faults);
  std::vector<FileUse> inputs;
  if (written) inputs = files_of_tables(written->drive, options.file);
  if (options.file == "-") inputs.push_back({"standard input", "/dev/stdin"});
  if (!options.file.empty()) inputs.push_back({"DRIVE.toml", options.file});
  faults.require_distinct(std::move(inputs), outputs);
  faults.require_writable(outputs);
  return written;
}

ProportionalServo servo_of_1960(const WrittenDrive& written, const ServoOptions& options) {
  if (const auto servo = settled_servo(written.drive)) return *servo;
  throw InvalidInput(
      {{"drive", "not a servo as that of 1960", permitted_with_servo, shown(options.file)}});
}

}  // namespace gearlash::cli
