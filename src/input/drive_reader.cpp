#include "input/drive_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "input/controller_reader.hpp"
#include "input/motor_reader.hpp"
#include "input/signal_reader.hpp"
#include "input/units.hpp"

namespace gearlash {
namespace {

constexpr char torque_controlled[] = "torque-controlled";

const std::vector<std::string> section_names = {"motor",     "gearbox",    "load",   "contact",
                                                "loop",      "controller", "sensor", "sampling",
                                                "reference", "load_torque"};

/// A key that only drives have.
struct DriveKey {
  const char* section;
  const char* key;
};
constexpr std::array drive_keys = {
    DriveKey{"motor", "coulomb"},      DriveKey{"motor", "breakaway"},
    DriveKey{"motor", "torque_limit"}, DriveKey{"motor", "voltage_limit"},
    DriveKey{"load", "coulomb"},       DriveKey{"load", "breakaway"},
    DriveKey{"contact", "stiffness"},  DriveKey{"contact", "damping"},
    DriveKey{"contact", "law"}};

/// Names of files for those of drive::validate().
std::string name_in_file(const std::string& field) {
  static const std::vector<std::pair<std::string, std::string>> names = {
      {"motor.viscous", "motor.friction"},
      {"load.viscous", "load.friction"},
      {"backlash", "gearbox.backlash"},
      {"torque_limit", "motor.torque_limit"},
      {"sensing.resolution", "sensor.resolution"},
      {"sensing.resolution_of_speed", "sensor.speed_resolution"},
      {"controller.numerator", "controller.num"},
      {"controller.denominator", "controller.den"},
      {"controller.state_matrix", "controller.A"},
      {"controller.input_matrix", "controller.B"},
      {"controller.output", "controller.C"},
      {"controller.direct", "controller.D"}};
  for (const auto& [from, to] : names) {
    if (field == from) return to;
  }
  return field;
}

class DriveReader {
 public:
  DriveReader(const TomlDocument& document, Findings& findings, const std::filesystem::path& folder)
      : document_(document), findings_(findings), folder_(folder) {}

  DriveFile read() {
    refuse_other_sections();
    read_drivetrain();
    read_contact();
    read_sensor();
    read_control();
    read_sampling();
    read_signals();
    findings_.take(drive::validate(file_.drive), &name_in_file, place_);
    return std::move(file_);
  }

 private:
  bool has(std::string_view section) const { return document_.root().contains(section); }

  SectionReader section(std::string name, bool required, std::string contents) {
    return SectionReader(document_, findings_, std::move(name), required, std::move(contents));
  }

  void refuse_other_sections() {
    for (const auto& [key, value] : document_.root()) {
      const std::string name(key.str());
      if (std::find(section_names.begin(), section_names.end(), name) != section_names.end()) {
        continue;
      }
      findings_.refuse(key.source().begin, shown(name), document_.written(value),
                       name == "servo"
                           ? "must not be of a drive, which has no closed form to normalise: give "
                             "[motor], [gearbox] and [load]"
                           : "is no section: " + one_of(section_names, name));
    }
  }

  // ---- motor, gearbox, load ---------------------------------------------------------------------

  void read_drivetrain() {
    SectionReader motor = section("motor", true, "with a kind and its constants");
    place_ = motor.place();
    std::vector<std::string> kinds = motor_kinds;
    kinds.emplace_back(torque_controlled);
    const std::string kind = motor.choice("kind", kinds, true).value_or("");
    const double inertia = motor.quantity("inertia", dimensions::inertia).si;
    const double friction = motor.quantity("friction", dimensions::torque_per_speed).si;
    Datasheet datasheet;
    datasheet.loop.error_gain = 1.0;
    if (kind == torque_controlled) {
      // Torque for torque, in the place of volts.
      datasheet.motor = FieldControlledMotor{inertia, friction, 1.0, 1.0};
    } else {
      datasheet.motor = read_motor_constants(motor, kind, inertia, friction);
    }
    const drive::ShaftFriction dry = read_dry_friction(motor, "motor");
    units_.is_voltage = kind != torque_controlled;
    const char* limit_key = units_.is_voltage ? "voltage_limit" : "torque_limit";
    const std::optional<Quantity> limit = motor.optional_quantity(
        limit_key, units_.is_voltage ? dimensions::voltage : dimensions::torque);
    if (!kind.empty()) motor.refuse_other_keys();
    read_gearbox(datasheet);
    read_load(datasheet);
    findings_.take(
        validate(datasheet), [](const std::string& field) { return field; }, place_);
    // So that what is referred by it is not found at fault as well.
    const double ratio = datasheet.gearbox.ratio;
    if (!(ratio > 0.0 && std::isfinite(ratio))) datasheet.gearbox.ratio = 1.0;
    refer(datasheet, dry);
    if (limit) set_limit(limit_key, *limit);
  }

  drive::ShaftFriction read_dry_friction(SectionReader& shaft, const std::string& name) {
    const auto torque = [&](const char* key) {
      return shaft.optional_quantity(key, dimensions::torque);
    };
    const std::optional<Quantity> coulomb = torque("coulomb");
    const std::optional<Quantity> breakaway = torque("breakaway");
    drive::ShaftFriction friction;
    friction.coulomb = coulomb.value_or(Quantity{}).si;
    friction.breakaway = breakaway ? breakaway->si : friction.coulomb;
    if (breakaway && !(breakaway->si >= friction.coulomb)) {
      findings_.take({{name + ".breakaway", "",
                       "must be at least " + name +
                           ".coulomb: what is at rest is not easier to "
                           "move than what moves",
                       ""}},
                     &name_in_file, shaft.place());
      friction.breakaway = friction.coulomb;
    }
    return friction;
  }

  void read_gearbox(Datasheet& datasheet) {
    SectionReader gearbox = section("gearbox", true, "with ratio and backlash");
    datasheet.gearbox.ratio = gearbox.number("ratio", "positive, motor turns per load turn");
    const Quantity backlash = gearbox.quantity("backlash", dimensions::angle);
    file_.backlash_unit = {.name = backlash.unit, .radians = backlash.unit_in_si};
    datasheet.gearbox.backlash = backlash.si;
    gearbox.refuse_other_keys();
  }

  void read_load(Datasheet& datasheet) {
    SectionReader load = section("load", true, "with inertia and friction");
    datasheet.load.inertia = load.quantity("inertia", dimensions::inertia).si;
    datasheet.load.friction = load.quantity("friction", dimensions::torque_per_speed).si;
    file_.drive.load.friction = read_dry_friction(load, "load");
    load.refuse_other_keys();
  }

  /// To the load's shaft.
  void refer(const Datasheet& datasheet, const drive::ShaftFriction& dry) {
    const double ratio = datasheet.gearbox.ratio;
    const ReferredMotor referred = refer_to_load(datasheet);
    drive::Drive& drive = file_.drive;
    drive.motor = {referred.inertia,
                   {.viscous = referred.mechanical_friction + referred.electrical_friction,
                    .coulomb = ratio * dry.coulomb,
                    .breakaway = ratio * dry.breakaway}};
    drive.load.inertia = datasheet.load.inertia;
    drive.load.friction.viscous = datasheet.load.friction;
    drive.backlash = datasheet.gearbox.backlash;
    file_.gear_ratio = ratio;
    units_.gear_ratio = ratio;
    units_.torque_per_output = referred.stiffness;  // per volt: error_gain is 1
  }

  void set_limit(const std::string& key, const Quantity& limit) {
    if (limit.si > 0.0) {
      file_.drive.torque_limit = units_.torque_per_output * limit.si;
    } else {
      findings_.take({{"motor." + key, "", "must be positive", ""}}, &name_in_file, place_);
    }
  }

  // ---- contact ----------------------------------------------------------------------------------

  void read_contact() {
    SectionReader contact = section("contact", false, "with restitution, or stiffness and damping");
    if (!contact.has("stiffness") && !contact.has("damping") && !contact.has("law")) {
      file_.drive.contact = drive::RigidContact{contact.number("restitution", 0.0)};
    } else {
      contact.refuse("restitution",
                     "must not stand beside stiffness: faces are rigid or they give");
      drive::CompliantContact compliant;
      compliant.stiffness = contact.quantity("stiffness", dimensions::torque_per_angle).si;
      compliant.damping = contact.optional_quantity("damping", dimensions::torque_per_speed)
                              .value_or(Quantity{})
                              .si;
      const auto law = contact.choice("law", {"ElastoBacklash", "ElastoBacklash2"}, false);
      compliant.law =
          law == "ElastoBacklash2" ? drive::ContactDamping::full : drive::ContactDamping::limited;
      file_.drive.contact = compliant;
    }
    contact.refuse_other_keys();
  }

  // ---- sensors ----------------------------------------------------------------------------------

  void read_sensor() {
    SectionReader sensor = section("sensor", false, "with the shafts that are measured");
    const std::string position =
        sensor.choice("position", {"load", "motor", "both"}, false).value_or("load");
    const std::string speed = sensor.choice("speed", {"load", "motor"}, false)
                                  .value_or(position == "load" ? "load" : "motor");
    drive::Sensing& sensing = file_.drive.sensing;
    const bool is_on_load = position != "motor";
    sensing.load_share_of_position = is_on_load ? 1.0 : 0.0;
    sensing.load_share_of_speed = speed == "load" ? 1.0 : 0.0;
    sensing.resolution = read_resolution(sensor, "", is_on_load).value_or(0.0);
    const bool same_shaft = is_on_load == (speed == "load");
    sensing.resolution_of_speed = read_resolution(sensor, "speed_", speed == "load")
                                      .value_or(same_shaft ? sensing.resolution : 0.0);
    sensor.refuse_other_keys();
  }

  /// Of an encoder on one of the shafts, at the load's.
  std::optional<double> read_resolution(SectionReader& sensor, const std::string& prefix,
                                        bool is_on_load) {
    const std::string counts_key = prefix + "counts_per_turn";
    const double referred = is_on_load ? 1.0 : 1.0 / file_.gear_ratio;
    const std::optional<Quantity> resolution =
        sensor.optional_quantity(prefix + "resolution", dimensions::angle);
    const bool counted = sensor.has(counts_key);
    const double counts = sensor.number(counts_key, 1.0);
    if (resolution && counted) {
      sensor.refuse(counts_key, "must not stand beside resolution: one tells the other");
    }
    if (resolution) return referred * resolution->si;
    if (!counted) return std::nullopt;
    if (!(counts > 0.0)) sensor.refuse(counts_key, "must be positive");
    return referred * 2.0 * std::numbers::pi / (counts > 0.0 ? counts : 1.0);
  }

  // ---- controller -------------------------------------------------------------------------------

  void read_control() {
    if (!has("controller")) {
      read_loop();
      return;
    }
    if (has("loop")) {
      findings_.refuse("loop", *document_.root().get("loop"),
                       "must not stand beside [controller]: a drive has one of them");
    }
    SectionReader controller = section("controller", true, "");
    file_.drive.controller = read_controller(controller, units_);
  }

  void read_loop() {
    SectionReader loop = section("loop", true, "with error_gain, or [controller] in its place");
    const double error_gain =
        loop.quantity("error_gain", units_.is_voltage ? dimensions::voltage_per_angle
                                                      : dimensions::torque_per_angle)
            .si;
    if (const auto sensor = loop.choice("sensor", {"load", "motor"}, false)) {
      if (has("sensor")) {
        loop.refuse("sensor", "must not stand beside [sensor], which says it");
      } else {
        file_.drive.sensing.load_share_of_position = sensor == "load" ? 1.0 : 0.0;
        file_.drive.sensing.load_share_of_speed = sensor == "load" ? 1.0 : 0.0;
      }
    }
    loop.refuse_other_keys();
    file_.drive.controller =
        drive::ProportionalDerivative{.proportional = units_.torque_per_output * error_gain};
  }

  void read_sampling() {
    if (!has("sampling")) return;
    SectionReader section = this->section("sampling", true, "with its period");
    drive::Sampling sampling;
    sampling.period = section.quantity("period", dimensions::time).si;
    sampling.delay = section.optional_quantity("delay", dimensions::time).value_or(Quantity{}).si;
    const auto method = section.choice("method", {"tustin", "backward", "forward"}, false);
    if (method == "backward") sampling.method = drive::Discretization::backward;
    if (method == "forward") sampling.method = drive::Discretization::forward;
    sampling.speed_by_differences =
        section.choice("speed", {"differences", "tachometer"}, false) != "tachometer";
    section.refuse_other_keys();
    file_.drive.sampling = sampling;
  }

  // ---- signals ----------------------------------------------------------------------------------

  void read_signals() {
    if (has("reference")) {
      SectionReader reference = section("reference", true, "with a kind");
      file_.drive.reference = read_reference(reference, folder_);
      file_.has_reference = true;
    }
    if (has("load_torque")) {
      SectionReader load_torque = section("load_torque", true, "with a kind");
      file_.drive.load_torque = read_load_torque(load_torque, folder_);
    }
  }

  const TomlDocument& document_;
  Findings& findings_;
  const std::filesystem::path& folder_;
  DriveFile file_;
  ControllerUnits units_;
  Place place_;
};

}  // namespace

bool describes_drive(const TomlDocument& document) {
  const toml::table& root = document.root();
  const bool has_section =
      std::any_of(drive_sections.begin(), drive_sections.end(),
                  [&](std::string_view section) { return root.contains(section); });
  const bool has_key = std::any_of(drive_keys.begin(), drive_keys.end(), [&](const DriveKey& key) {
    return static_cast<bool>(root[key.section][key.key]);
  });
  return has_section || has_key ||
         root["motor"]["kind"].value<std::string>() == torque_controlled ||
         root["loop"]["sensor"].value<std::string>() == "motor";
}

DriveFile read_drive(const TomlDocument& document, Findings& findings,
                     const std::filesystem::path& folder) {
  return DriveReader(document, findings, folder).read();
}

}  // namespace gearlash
