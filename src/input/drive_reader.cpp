#include "input/drive_reader.hpp"

#include <array>
#include <map>

#include "base/lists.hpp"
#include "gearlash/units.hpp"
#include "input/foreign_words.hpp"
#include "input/number_reader.hpp"
#include "input/parameter_text.hpp"
#include "input/robot_form.hpp"
#include "input/section_kinds.hpp"
#include "input/signal_reader.hpp"
#include "model/normalized_servo.hpp"
#include "model/parameters.hpp"
#include "model/reduced_drive.hpp"
#include "question/series/distribution.hpp"

namespace gearlash {
namespace {

/// The sections that the normal form replaces.
constexpr std::array plant_sections = {"motor", "gearbox", "load", "loop", "controller"};
/// A data sheet's name for [controller] of kind "P".
constexpr char loop[] = "loop";

bool is_choice(const Slot& slot) { return std::holds_alternative<Choice>(slot); }

/// A contact with a stiffness and no kind is compliant.
void infer_kind_of_contact(const TomlDocument& document, Drive& drive) {
  const auto has = [&](const char* path) { return document.value_at(path) != nullptr; };
  const bool is_compliant =
      has("contact.stiffness") || has("contact.damping") || has("contact.law");
  if ((is_compliant && !has("contact.kind")) || has("gearbox.torsional_stiffness")) {
    drive.contact = CompliantContact{};
  }
}

/// One way in which a section gives a parameter.
struct Key {
  const Parameter* parameter;
  const OtherForm* form;  ///< nullptr: the parameter's own name
  std::string name;
};

/// The keys by which `section` may give `parameter`, its own name first.
std::vector<Key> keys_of(const Parameter& parameter, std::string_view section) {
  std::vector<Key> keys;
  if (parameter.section() == section) {
    keys.push_back({&parameter, nullptr, std::string(parameter.key())});
  }
  for (const OtherForm& form : parameter.other_forms) {
    const std::size_t point = form.path.find('.');
    if (form.path.substr(0, point) == section) {
      keys.push_back({&parameter, &form, std::string(form.path.substr(point + 1))});
    }
  }
  return keys;
}

void set_number(const Slot& slot, double number) {
  if (auto* const* place = std::get_if<double*>(&slot)) **place = number;
  if (auto* const* place = std::get_if<std::optional<double>*>(&slot)) **place = number;
}

double stand_in(const Parameter& parameter) {
  return parameter.path == "servo.backlash" || parameter.path == "servo.inertia_ratio" ? 1.0 : 0.5;
}

std::string wanted_text(const Parameter& parameter) {
  if (parameter.permitted == Permitted::of_normal_form) {
    return permitted_values(parameter.key());
  }
  return std::string(parameter.wanted);
}

/// A current that times the torque constant gives a torque.
void refuse_current(SectionReader& section, const char* current, const std::string& torque,
                    bool is_taken, const char* otherwise) {
  if (!section.has(current)) return;
  if (section.has(torque)) {
    section.refuse(current,
                   "must not stand beside " + torque + ": it gives it, times torque_constant");
  } else if (!is_taken) {
    section.refuse(current, otherwise);
  }
}

/// The points of a table, which stand in the drive's file instead of one of their own.
bool is_of_points(const Parameter& parameter) {
  return parameter.path.ends_with(".times") || parameter.path.ends_with(".values");
}

class DriveReader {
 public:
  DriveReader(const TomlDocument& document, Findings& findings, const std::filesystem::path& folder,
              const Variation& variation, BareNumbers bare_numbers)
      : document_(document),
        findings_(findings),
        folder_(folder),
        variation_(variation),
        takes_bare_numbers_(bare_numbers == BareNumbers::in_si) {}

  WrittenDrive read() {
    if (is_normal_form()) drive().servo.emplace();
    if (is_robots_form()) {
      drive() = robots_joint(document_.value_at("actuator.kv") != nullptr,
                             document_.value_at("actuator.timestep") != nullptr);
    }
    refuse_other_sections();
    if (!has_anything()) return std::move(file_);
    infer_kind_of_contact(document_, drive());
    for (const Section& section : all_sections()) read_section(section);
    drive().is_rounded = has_rounded_numbers();
    check();
    return std::move(file_);
  }

 private:
  Drive& drive() { return file_.drive; }
  bool has(std::string_view section) const { return document_.root().contains(section); }
  bool is_varied(std::string_view path) const {
    return variation_.paths.count(std::string(path)) > 0;
  }
  bool has_plant() const {
    return is_robots_form() || any_of(plant_sections, [&](const char* name) { return has(name); });
  }
  bool is_robots_form() const { return has("joint") || has("actuator"); }

  /// Whether --set gives the whole section.
  bool is_set(std::string_view section) const {
    return document_.root().get(section)->source().begin.line == 0;
  }

  /// Drive::is_rounded.
  bool has_rounded_numbers() {
    if (drive().servo) return document_.has_long_decimals("servo");
    return any_of(all_parameters_of_drives(), [&](const Parameter& parameter) {
      return may_be_rounded(parameter, drive()) && document_.has_long_decimal_at(parameter.path);
    });
  }

  // ---- sections ---------------------------------------------------------------------------------

  /// [servo] may be left out if all its required keys are varied.
  bool leaves_nothing_to_give() const {
    return is_varied("servo.damping") && is_varied("servo.inertia_ratio") &&
           is_varied("servo.friction_ratio");
  }
  /// A [motor] of --set makes no other drive of a file's [servo].
  bool is_normal_form() const {
    const bool is_file_s = has("servo") && !is_set("servo");
    const bool has_motor = has("motor") && !(is_file_s && is_set("motor"));
    return !has_motor && (has("servo") || (leaves_nothing_to_give() && !has_plant()));
  }

  /// A file with neither motor nor normal form has one fault, not one for each section.
  bool has_anything() {
    if (drive().servo || has_plant()) return true;
    findings_.missing(
        {1, 1}, "motor",
        "must be a section [motor] with [gearbox], [load] and [loop] or [controller], "
        "or [servo] instead");
    return false;
  }

  void refuse_other_sections() {
    std::vector<std::string> names = of_each<std::string>(all_sections(), &Section::name);
    names.insert(names.end(), {loop, "joint", "actuator"});
    for (const auto& [key, value] : document_.root()) {
      const std::string name(key.str());
      if (name == variation_.section) continue;
      if (!contains(names, name)) {
        const std::string guess = guess_of_key("", name, names);
        const std::string reason =
            name == "sweep"    ? "is of a file for gearlash sweep, not of a drive"
            : value.is_table() ? "is not a section: must be one of " + listed(names) + guess
                               : "must stand in a section, such as [motor]" + guess;
        findings_.refuse(key.source().begin, shown(name), document_.written(value), reason);
      }
    }
    for (const char* robots : {"joint", "actuator"}) {
      if (has("servo")) refuse_section(robots, "must not stand beside [servo]");
    }
    if (is_robots_form()) {
      refuse_section(loop, "must not stand beside [joint] and [actuator], which give its gains");
    }
    if (has("servo") && has("motor")) {
      refuse_section("servo", "must not stand beside [motor]: a file describes its drive once");
    }
    if (drive().servo) {
      for (const char* name : plant_sections) {
        refuse_section(name, "must not stand beside [servo], which is normalised");
      }
    }
    if (has(loop) && has("controller")) {
      refuse_section(loop, "must not stand beside [controller]: a drive has one of them");
    }
  }

  void refuse_section(const char* name, const std::string& permitted) {
    if (const toml::node* node = document_.root().get(name)) {
      findings_.refuse(node->source().begin, name, "[" + std::string(name) + "]", permitted);
    }
  }

  void read_section(const Section& section) {
    const std::string name(section.name);
    const bool is_plant = contains(plant_sections, name);
    const bool is_servo = name == "servo";
    if (is_plant && drive().servo) return;
    if (is_servo && !drive().servo) return;
    if (is_robots_form()) return read_section_of_robots(section);
    if (name == "controller" && has(loop) && !has("controller")) {
      read_keys(loop, true, "with error_gain, or [controller] instead");
      return;
    }
    const bool is_required = is_plant || (is_servo && !leaves_nothing_to_give());
    if (has(name) && !section.is_present(drive())) section.add(drive());
    if (!is_required && !is_servo && !has(name)) return;
    const char* contents =
        name == "controller" ? "with a kind and its gains, or [loop]" : section.contents.data();
    read_keys(name, is_required, contents);
  }

  /// The other sections may add to [joint] and [actuator]; only the load's inertia must be added.
  void read_section_of_robots(const Section& section) {
    const std::string name(section.name);
    if (has(name) && !section.is_present(drive())) section.add(drive());
    if (name == "motor") {
      read_keys("joint", true, "with armature, damping, frictionloss and backlash");
    }
    if (name == "load" && !has("load")) {
      findings_.missing({1, 1}, "load.inertia",
                        "must be the moment of inertia that the joint moves, such as kg m2: in a "
                        "section [load]");
    }
    if (has(name)) read_keys(name, false, section.contents.data());
    if (name == "controller") read_keys("actuator", true, "with kp, kv and timestep");
  }

  // ---- keys -------------------------------------------------------------------------------------

  void read_keys(const std::string& name, bool is_required, const char* contents) {
    SectionReader section(document_, findings_, name, is_required, contents);
    section.collect_tolerances(file_.tolerances);
    if (takes_bare_numbers_ || name == "servo" || is_robots_form()) section.accept_bare_numbers();
    if (place_.line == 0 || name == "motor") place_ = section.place();
    bool kind_is_known = true;
    for (const Parameter& parameter : all_parameters_of_drives()) {
      const std::vector<Key> keys = keys_of(parameter, name);
      if (keys.empty()) continue;
      const Slot slot = parameter.slot(drive());
      const bool is_kind = parameter.is_required && !parameter.choices.empty();
      if (std::holds_alternative<std::monostate>(slot)) {
        // What the file gives by another section's key is there: infer_kind_of_contact().
        if (parameter.section() != name) section.know(keys.front().name);
        continue;
      }
      if (!kind_is_known && !is_of_every_kind(parameter, drive(), name)) continue;
      const Key key = key_given(section, keys);
      if (is_kind) {
        kind_is_known = read_choice(section, name, parameter, key, std::get<Choice>(slot));
      } else {
        read_value(section, name, parameter, key, slot, kind_is_known);
      }
    }
    if (name == "motor") motor_is_known_ = kind_is_known;
    if (!kind_is_known) know_keys_of_all_kinds(section, name, true);
    if (is_kind_set(name)) know_keys_of_all_kinds(section, name, false);
    if (!kind_is_known) check_keys_of_any_kind(section, name);
    refuse_rivals(section, name);
    section.refuse_other_keys([&](const std::string& key, const std::vector<std::string>& known) {
      const std::string why = why_of_other_kind(drive(), name, key);
      if (!why.empty()) return why;
      const std::string guess = guess_of_key(name, key, known);
      if (!kind_is_known) return "is not a key of any kind of [" + name + "]" + guess;
      return "is not a key of [" + name + "]: must be one of " + listed(known) + guess;
    });
  }

  /// Whether --set gives the value.
  bool is_value_set(const std::string& path) const {
    const toml::node* value = document_.value_at(path);
    return value != nullptr && value->source().begin.line == 0;
  }
  /// Whether --set gives the kind. The file's keys may then belong to another kind.
  bool is_kind_set(const std::string& name) const { return is_value_set(name + ".kind"); }

  /// The file's, and those of --set if they are to be known.
  void know_keys_of_all_kinds(SectionReader& section, const std::string& name, bool even_if_set) {
    for (const Parameter& parameter : all_parameters_of_drives()) {
      for (const Key& key : keys_of(parameter, name)) {
        if (even_if_set || !is_value_set(name + "." + key.name)) section.know(key.name);
      }
    }
  }

  /// The first of the keys that the section has; any further ones are refused.
  Key key_given(SectionReader& section, const std::vector<Key>& keys) {
    const Key* given = nullptr;
    for (const Key& key : keys) {
      section.know(key.name);
      if (!section.has(key.name)) continue;
      if (given == nullptr) {
        given = &key;
      } else {
        section.refuse(key.name, "must not stand beside " + given->name + ": one gives the other");
      }
    }
    return given == nullptr ? keys.front() : *given;
  }

  /// Refuses keys whose parameter the drive has lost because of another key.
  void refuse_rivals(SectionReader& section, const std::string& name) {
    if (name == "motor" && motor_is_known_) {
      refuse_current(section, "no_load_current", "coulomb", takes_no_load_current(drive().motor),
                     "must stand beside the torque_constant of a motor with direct current through "
                     "its armature: the product is its dry friction");
      refuse_current(section, "current_limit", "torque_limit", takes_current_limit(drive().motor),
                     "must stand beside the torque_constant of a torque-controlled motor, or in an "
                     "armature- or field-controlled one");
    }
    if (name == "sensor") {
      for (const std::string prefix : {"", "speed_"}) {
        for (const char* counts : {"counts_per_turn", "bits", "lines"}) {
          if (!section.has(prefix + counts)) continue;
          section.refuse(prefix + "resolution",
                         "must not stand beside " + prefix + counts + ": one gives the other");
        }
      }
    }
    if (name == "contact" && std::holds_alternative<RigidContact>(drive().contact)) {
      refuse_key("gearbox.torsional_stiffness", "must not stand beside contact.kind = \"rigid\"");
    }
    if (name == "contact" && std::holds_alternative<CompliantContact>(drive().contact)) {
      section.refuse("restitution",
                     "must not stand beside stiffness: faces are rigid or compliant");
    }
    if (name == loop && has("sensor")) {
      section.refuse("sensor", "must not stand beside [sensor], which already gives it");
    }
  }

  void refuse_key(const char* path, const std::string& permitted) {
    if (const toml::node* node = document_.value_at(path)) findings_.refuse(path, *node, permitted);
  }

  bool is_required_in(const std::string& section, const Parameter& parameter) const {
    return is_robots_form() ? is_required_of_robots(parameter, section) : parameter.is_required;
  }

  bool read_choice(SectionReader& section, const std::string& name, const Parameter& parameter,
                   const Key& key, const Choice& choice) {
    const bool is_required = is_required_in(name, parameter) && key.form == nullptr;
    for (const RefusedWord& refused : parameter.refused_words) {
      section.refuse_word(key.name, refused.word, std::string(refused.reason));
    }
    const std::optional<std::string> word =
        section.choice(key.name, words_of(parameter), is_required);
    if (!word) return !is_required;
    choice.choose(drive(), *choice_named(parameter, *word));
    return true;
  }

  void read_value(SectionReader& section, const std::string& name, const Parameter& parameter,
                  const Key& key, const Slot& slot, bool kind_is_known) {
    const std::string given = name_in_file(std::string(parameter.path));
    const bool is_elsewhere = section_of(given) != name && section_of(given) != loop;
    if (is_elsewhere && !is_of_robots(name) && document_.value_at(given) != nullptr) {
      section.know(key.name);
      section.refuse(key.name, "must not stand beside " + given + ": one gives the other");
      return;
    }
    if (is_varied(parameter.path)) {
      section.refuse(key.name, "must be left out: [" + variation_.section + "] varies it");
      set_number(slot, stand_in(parameter));
      return;
    }
    const bool is_required =
        is_required_in(name, parameter) && kind_is_known && !may_be_left_out(parameter);
    const std::string wanted = wanted_text(parameter);
    if (is_of_points(parameter) && !section.has("times")) return section.know(key.name);
    if (is_choice(slot)) {
      read_choice(section, name, parameter, key, std::get<Choice>(slot));
    } else if (auto* const* list = std::get_if<std::vector<double>*>(&slot)) {
      **list = section.numbers(key.name, wanted);
    } else if (auto* const* rows = std::get_if<Rows*>(&slot)) {
      **rows = section.rows(key.name, wanted);
    } else if (auto* const* text = std::get_if<std::string*>(&slot)) {
      if (!section.has(key.name) && section.has("times")) return section.know(key.name);
      **text = section.text(key.name, wanted);
      read_table(section, parameter, **text);
    } else if (is_required || section.has(key.name)) {
      set_number(slot, read_number_of(section, parameter, key));
    } else {
      section.know(key.name);
      if (may_be_left_out(parameter)) set_number(slot, 1.0);
    }
  }

  /// A sweep may omit the normal form's backlash; amplitudes are then in backlashes.
  bool may_be_left_out(const Parameter& parameter) const {
    return !variation_.section.empty() && parameter.path == "servo.backlash";
  }

  double read_number_of(SectionReader& section, const Parameter& parameter, const Key& key) {
    const std::string_view path = key.form != nullptr ? key.form->path : parameter.path;
    if (parameter.section() == "controller" && !motor_is_known_) {
      const auto drives = of_each(drives_of_kinds(drive(), "motor"),
                                  [](const auto& of_kind) { return of_kind.first; });
      refuse_other_units(section, key.name, parameter, path, drives);
      return 1.0;
    }
    const Measured value = gearlash::read_number_of(section, key.name, parameter, path, drive(),
                                                    wanted_text(parameter));
    if (parameter.path == "gearbox.backlash" || parameter.path == "servo.backlash") {
      drive().angle_unit = angle_unit_of(value);
    }
    return value.si;
  }

  /// The fault of a key as the parameter of a drive, whether it is readable and within its range;
  /// "" if it is sound.
  std::string why_unfit(const std::string& name, const Parameter& parameter, const Key& key,
                        const Drive& of_kind) {
    Findings findings(document_);
    SectionReader section(document_, findings, name, false, "");
    const WrittenDrive before = file_;
    drive() = of_kind;
    const Slot slot = parameter.slot(drive());
    read_value(section, name, parameter, key, slot, false);
    const double* number = given_number(slot);
    RangeCheck check;
    if (number != nullptr) check_number(check, parameter, *number, "");
    file_ = before;
    if (const std::string why = findings.first(); !why.empty()) return why;
    return check.faults().empty() ? "" : check.faults().front().permitted;
  }

  /// Of a section whose kind is not known: refuses the values that no kind takes.
  void check_keys_of_any_kind(SectionReader& section, const std::string& name) {
    std::map<std::string, std::string> reasons;  // why the keys are unfit, "" if they are not
    for (const auto& [of_kind, kind] : drives_of_kinds(drive(), name)) {
      for (const Parameter& parameter : all_parameters_of_drives()) {
        if (!exists(parameter, of_kind)) continue;
        for (const Key& key : keys_of(parameter, name)) {
          if (!section.has(key.name)) continue;
          const auto [reason, is_new] = reasons.try_emplace(key.name);
          if (!is_new && reason->second.empty()) continue;
          const std::string why = why_unfit(name, parameter, key, of_kind);
          if (is_new || why.empty()) reason->second = why;
        }
      }
    }
    for (const auto& [key, reason] : reasons) {
      if (!reason.empty()) section.refuse(key, reason);
    }
  }

  void read_table(SectionReader& section, const Parameter& parameter, const std::string& file) {
    if (file.empty()) {
      section.refuse(std::string(parameter.key()), "must be the name of a CSV file");
      return;
    }
    const bool is_reference = parameter.section() == "reference";
    std::optional<Signal>& signal = is_reference ? drive().reference : drive().load_torque;
    const Dimension& dimension = is_reference ? dimensions::angle : dimensions::torque;
    try {
      TableSignal table = read_signal_table(folder_ / file, dimension);
      table.file = file;
      signal = std::move(table);
    } catch (const InvalidInput& problem) {
      const Fault& fault = problem.faults().front();
      const bool is_read = fault.path != "file";
      section.refuse(std::string(parameter.key()),
                     is_read ? "holds " + to_string(fault) : fault.permitted);
    }
  }

  void check() {
    findings_.take(faults(sanitized()), place_,
                   [&](const std::string& field) { return name_in_file(field); });
    if (findings_.none()) check_tolerances();
  }

  /// The drive without numbers that would only cause faults elsewhere.
  Drive sanitized() const {
    Drive copy = file_.drive;
    for (std::optional<Signal>* signal : {&copy.reference, &copy.load_torque}) {
      if (!*signal) continue;
      const auto* table = std::get_if<TableSignal>(&**signal);
      // Its file was refused, or one of its lists is missing.
      const bool has_points = table == nullptr || (!table->times.empty() && !table->values.empty());
      if (!has_points) *signal = 0.0;
    }
    return copy;
  }

  void check_tolerances() {
    for (ParameterTolerance& tolerance : file_.tolerances) {
      tolerance.path = std::string(find_parameter(tolerance.path, drive())->path);
    }
    // "gearbox.backlash.min" is located at "gearbox.backlash".
    const auto name_of = [&](const std::string& field) {
      return name_in_file(field.substr(0, field.find('.', field.find('.') + 1)));
    };
    if (file_.tolerances.empty()) return;
    findings_.take(faults(TolerancedDrive{drive(), file_.tolerances}), place_, name_of);
  }

  /// The key under which the file gives a parameter.
  std::string name_in_file(const std::string& path) const {
    if (path == "controller.proportional" && has(loop)) return "loop.error_gain";
    const Parameter* parameter = find_parameter(path);
    if (parameter == nullptr) return path;
    for (const OtherForm& form : parameter->other_forms) {
      if (document_.value_at(form.path) != nullptr) return std::string(form.path);
    }
    return path;
  }

  const TomlDocument& document_;
  Findings& findings_;
  const std::filesystem::path& folder_;
  const Variation& variation_;
  bool takes_bare_numbers_;
  WrittenDrive file_;
  Place place_{0, 0};
  bool motor_is_known_ = true;
};

}  // namespace

WrittenDrive read_drive(const TomlDocument& document, Findings& findings,
                        const std::filesystem::path& folder, const Variation& variation,
                        BareNumbers bare_numbers) {
  return DriveReader(document, findings, folder, variation, bare_numbers).read();
}

}  // namespace gearlash
