#include "input/servo_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "input/drive_reader.hpp"
#include "input/motor_reader.hpp"
#include "input/units.hpp"

namespace gearlash {
namespace {

const std::vector<std::string> section_names = {"motor", "gearbox", "load",
                                                "loop",  "contact", "servo"};
/// The sections that make up a data sheet but for [contact], which either form may have.
constexpr std::array datasheet_sections = {"motor", "gearbox", "load", "loop"};

class ServoReader {
 public:
  ServoReader(const TomlDocument& document, Findings& findings, const ServoVariation& variation)
      : document_(document), findings_(findings), variation_(variation) {}

  ServoFile read() {
    refuse_other_sections();
    if (is_normalized()) {
      read_normalized();
    } else {
      read_datasheet();
    }
    return std::move(file_);
  }

 private:
  bool has(std::string_view section) const { return document_.root().contains(section); }

  template <class Names>
  bool has_any_of(const Names& sections) const {
    return std::any_of(sections.begin(), sections.end(), [&](auto name) { return has(name); });
  }

  bool is_normalized() const {
    return !has("motor") && (has("servo") || (leaves_none_to_give() && !has_datasheet()));
  }

  bool has_datasheet() const { return has_any_of(datasheet_sections); }

  bool is_varied(Input input) const { return variation_.inputs.count(input) > 0; }

  /// Of the numbers that [servo] must give.
  bool leaves_none_to_give() const {
    return is_varied(Input::damping) && is_varied(Input::inertia_ratio) &&
           is_varied(Input::friction_ratio);
  }

  SectionReader section(std::string name, bool required, std::string contents) {
    SectionReader section(document_, findings_, std::move(name), required, std::move(contents));
    section.collect_tolerances(file_.varied);
    return section;
  }

  void refuse_other_sections() {
    for (const auto& [key, value] : document_.root()) {
      const std::string name(key.str());
      if (name == variation_.section) continue;
      if (std::find(section_names.begin(), section_names.end(), name) != section_names.end()) {
        continue;
      }
      const bool is_of_drive =
          std::find(drive_sections.begin(), drive_sections.end(), name) != drive_sections.end();
      findings_.refuse(key.source().begin, shown(name), document_.written(value),
                       is_of_drive ? "is a drive's: must be left out but for limit-cycle, "
                                     "simulate, describe and compare"
                                   : "is no section: " + one_of(section_names, name));
    }
    if (has("servo") && has("motor")) {
      findings_.refuse("servo", *document_.root().get("servo"),
                       "must not stand beside [motor]: a file describes its servo once");
    }
  }

  // --- a data sheet ---

  void read_datasheet() {
    Datasheet datasheet;
    SectionReader motor =
        section("motor", true, "with [gearbox], [load] and [loop], or [servo] in their place");
    if (!motor.present() && !has_datasheet()) return;  // nothing to go by
    datasheet.motor = read_motor(motor);
    datasheet.gearbox = read_gearbox();
    datasheet.load = read_load();
    datasheet.loop = read_loop();
    datasheet.contact.restitution = read_restitution();
    findings_.take(validate(datasheet), &name_in_datasheet, motor.place());
    if (findings_.none()) derive(datasheet, motor.place());
  }

  Motor read_motor(SectionReader& section) {
    const std::optional<std::string> kind = section.choice("kind", motor_kinds, true);
    const double inertia = section.quantity("inertia", dimensions::inertia).si;
    const double friction = section.quantity("friction", dimensions::torque_per_speed).si;
    Motor motor = read_motor_constants(section, kind.value_or(""), inertia, friction);
    section.refuse_other_keys();
    return motor;
  }

  Gearbox read_gearbox() {
    SectionReader gearbox = section("gearbox", true, "with ratio and backlash");
    const double ratio = gearbox.number("ratio", "positive, motor turns per load turn");
    const double backlash = read_backlash(gearbox);
    gearbox.refuse_other_keys();
    return {.ratio = ratio, .backlash = backlash};
  }

  Load read_load() {
    SectionReader load = section("load", true, "with inertia and friction");
    const double inertia = load.quantity("inertia", dimensions::inertia).si;
    const double friction = load.quantity("friction", dimensions::torque_per_speed).si;
    load.refuse_other_keys();
    return {.inertia = inertia, .friction = friction};
  }

  Loop read_loop() {
    SectionReader loop = section("loop", true, "with error_gain");
    const double error_gain = loop.quantity("error_gain", dimensions::voltage_per_angle).si;
    const std::optional<std::string> sensor = loop.choice("sensor", {"load", "motor"}, false);
    loop.refuse_other_keys();
    return {.error_gain = error_gain, .sensor = sensor == "motor" ? Sensor::motor : Sensor::load};
  }

  /// A drivetrain has names of its own for the values that it takes over from the file.
  static std::string name_in_datasheet(const std::string& field) {
    return field == "load_inertia" ? "load.inertia" : field;
  }

  void derive(const Datasheet& datasheet, Place motor) {
    const Drivetrain drivetrain = to_drivetrain(datasheet);
    const double frequency = natural_frequency(drivetrain);
    if (!std::isnormal(frequency)) {
      findings_.refuse(
          motor, "natural_frequency", frequency > 1.0 ? "inf rad/s" : "0 rad/s",
          "must be from 1e-308 to 1e308 rad/s: stiffness and inertias are too far apart");
      return;
    }
    check_tolerances({.nominal = datasheet, .varied = file_.varied}, motor);
    file_.servo = normalize(drivetrain);
    file_.natural_frequency = frequency;
    file_.datasheet = datasheet;
    file_.drivetrain = drivetrain;
  }

  // --- the normalised numbers ---

  void read_normalized() {
    for (const char* name : datasheet_sections) {
      if (const toml::node* node = document_.root().get(name)) {
        findings_.refuse(name, *node, "must not stand beside [servo], which is normalised");
      }
    }
    SectionReader section = this->section("servo", !leaves_none_to_give(), "");
    section.accept_bare_numbers();  // normalised numbers have no data sheet whose unit to keep
    NormalizedServo servo{.damping = 0.5, .backlash = 1.0};  // stand-ins for what is varied
    for (const Input input : {Input::damping, Input::inertia_ratio, Input::friction_ratio}) {
      if (is_given(section, input)) {
        servo.*field_of(input) = section.number(name_of(input), permitted_values(name_of(input)));
      }
    }
    const bool in_backlashes = !variation_.section.empty() && !section.has("backlash");
    if (is_given(section, Input::backlash) && !in_backlashes) {
      servo.backlash = read_backlash(section);
    }
    file_.natural_frequency = read_natural_frequency(section);
    section.refuse_other_keys();
    servo.restitution = read_restitution();
    findings_.take(validate(servo), &name_in_normalized, section.place());
    file_.servo = servo;
    for (VariedNumber& varied : file_.varied) {
      if (varied.number == DriveNumber::contact_restitution) {
        varied.number = DriveNumber::servo_restitution;
      }
    }
    if (findings_.none()) {
      check_tolerances({.nominal = servo,
                        .natural_frequency = file_.natural_frequency.value_or(1.0),
                        .varied = file_.varied},
                       section.place());
    }
  }

  void check_tolerances(const TolerancedDrive& drive, Place otherwise) {
    if (!drive.varied.empty()) findings_.take(validate(drive), &name_in_file, otherwise);
  }

  /// "gearbox.backlash.min" is found at "gearbox.backlash".
  static std::string name_in_file(const std::string& field) {
    if (field.starts_with("servo.restitution")) return "contact.restitution";
    const std::size_t second = field.find('.', field.find('.') + 1);
    return field.substr(0, second);
  }

  /// Whether [servo] has to give the input; if it is varied, it must not.
  bool is_given(SectionReader& section, Input input) {
    if (!is_varied(input)) return true;
    section.refuse(name_of(input), left_out());
    return false;
  }

  std::string left_out() const {
    return "must be left out: [" + variation_.section + "] varies it";
  }

  std::optional<double> read_natural_frequency(SectionReader& section) {
    const std::optional<Quantity> frequency =
        section.optional_quantity("natural_frequency", dimensions::angular_frequency);
    if (!frequency) return std::nullopt;
    if (!(frequency->si > 0.0) || std::isinf(frequency->si)) {
      findings_.take({{"natural_frequency", "", "must be positive and finite", ""}},
                     &name_in_normalized, section.place());
    }
    return frequency->si;
  }

  static std::string name_in_normalized(const std::string& field) {
    return (field == "restitution" ? "contact." : "servo.") + field;
  }

  // --- what both forms have ---

  double read_backlash(SectionReader& section) {
    const Quantity backlash = section.quantity("backlash", dimensions::angle);
    file_.backlash_unit = {.name = backlash.unit, .radians = backlash.unit_in_si};
    return backlash.si;
  }

  double read_restitution() {
    SectionReader contact = section("contact", false, "with restitution");
    if (is_varied(Input::restitution)) contact.refuse("restitution", left_out());
    const double restitution = contact.number("restitution", Contact{}.restitution);
    contact.refuse_other_keys();
    return restitution;
  }

  const TomlDocument& document_;
  Findings& findings_;
  const ServoVariation& variation_;
  ServoFile file_;
};

}  // namespace

ServoFile read_servo(const TomlDocument& document, Findings& findings,
                     const ServoVariation& variation) {
  return ServoReader(document, findings, variation).read();
}

}  // namespace gearlash
