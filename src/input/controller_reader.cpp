#include "input/controller_reader.hpp"

#include "input/units.hpp"

namespace gearlash {
namespace {

const std::vector<std::string> kinds = {
    "P", "PD", "PI", "PID", "cascade", "lead-lag", "transfer-function", "state-space"};

class ControllerReader {
 public:
  ControllerReader(SectionReader& section, const ControllerUnits& units)
      : section_(section), units_(units) {}

  drive::Controller read() {
    const std::string kind = section_.choice("kind", kinds, true).value_or("");
    const std::optional<std::string> shaft = section_.choice("shaft", {"load", "motor"}, false);
    scale_ = units_.torque_per_output * (shaft == "motor" ? units_.gear_ratio : 1.0);
    const drive::Controller controller = read_kind(kind);
    if (!kind.empty()) section_.refuse_other_keys();
    return controller;
  }

 private:
  double gain(const char* key, const Dimension& voltage, const Dimension& torque) {
    return scale_ * section_.quantity(key, units_.is_voltage ? voltage : torque).si;
  }
  double per_angle(const char* key) {
    return gain(key, dimensions::voltage_per_angle, dimensions::torque_per_angle);
  }
  double per_angle_and_time(const char* key) {
    return gain(key, dimensions::voltage_per_angle_and_time, dimensions::torque_per_angle_and_time);
  }
  double per_speed(const char* key) {
    return gain(key, dimensions::voltage_per_speed, dimensions::torque_per_speed);
  }
  double time(const char* key) {
    return section_.optional_quantity(key, dimensions::time).value_or(Quantity{}).si;
  }

  drive::Controller read_kind(const std::string& kind) {
    // Members are initialised in the order of their declaration, which is that of the keys.
    if (kind == "P")
      return drive::ProportionalDerivative{.proportional = per_angle("proportional")};
    if (kind == "PD" || kind == "PI" || kind == "PID") return read_pid(kind);
    if (kind == "cascade") return read_cascade();
    if (kind == "lead-lag") {
      return drive::LeadLag{.gain = per_angle("gain"),
                            .zero = section_.quantity("zero", dimensions::angular_frequency).si,
                            .pole = section_.quantity("pole", dimensions::angular_frequency).si};
    }
    if (kind == "transfer-function") return read_transfer_function();
    if (kind == "state-space") return read_state_space();
    return drive::ProportionalDerivative{};
  }

  drive::Controller read_pid(const std::string& kind) {
    drive::ProportionalIntegralDerivative pid;
    pid.proportional = per_angle("proportional");
    if (kind != "PD") {
      pid.integral = per_angle_and_time("integral");
      pid.tracking_time = time("tracking_time");
    }
    if (kind != "PI") {
      pid.derivative = per_speed("derivative");
      pid.filter = time("filter");
      pid.derivative_of_speed =
          section_.choice("derivative_of", {"error", "speed"}, false) == "speed";
    }
    return pid;
  }

  drive::Controller read_cascade() {
    drive::Cascade cascade;
    cascade.position = section_.quantity("position", dimensions::rate).si;
    cascade.speed = per_speed("speed");
    if (section_.has("speed_integral")) cascade.speed_integral = per_angle("speed_integral");
    cascade.tracking_time = time("tracking_time");
    return cascade;
  }

  /// "s" or "z".
  drive::Controller read_transfer_function() {
    const double gain = per_angle("gain");
    const std::string coefficients =
        "a list of numbers, the coefficients by descending powers, such as [1, 2.5]";
    std::vector<double> numerator = section_.numbers("num", coefficients);
    const std::vector<double> denominator = section_.numbers("den", coefficients);
    for (double& coefficient : numerator) coefficient *= gain;
    if (section_.choice("variable", {"s", "z"}, false) == "z") {
      return drive::SampledTransfer{numerator, denominator};
    }
    return drive::ErrorTransfer{{numerator, denominator, 0.0}};
  }

  /// Columns of B and D are of r, y and v, or one of the error alone.
  std::vector<double> of_inputs(const char* key, const std::vector<double>& row) {
    if (row.size() == 1) return {row[0], -row[0], 0.0};
    if (row.size() != 3) {
      section_.refuse(key, "must have 1 number a row, of the error, or 3, of r, y and v");
    }
    return row;
  }

  drive::Controller read_state_space() {
    const double gain = per_angle("gain");
    drive::LinearController controller;
    controller.state_matrix = section_.rows("A", "a list of rows of numbers");
    for (const std::vector<double>& row : section_.rows("B", "a list of rows of 1 or 3 numbers")) {
      controller.input_matrix.push_back(of_inputs("B", row));
    }
    controller.output = section_.numbers("C", "a list of numbers, one for each state");
    controller.direct = of_inputs("D", section_.numbers("D", "a list of 1 or 3 numbers"));
    for (double& output : controller.output) output *= gain;
    for (double& direct : controller.direct) direct *= gain;
    return controller;
  }

  SectionReader& section_;
  const ControllerUnits& units_;
  double scale_ = 1.0;
};

}  // namespace

drive::Controller read_controller(SectionReader& section, const ControllerUnits& units) {
  return ControllerReader(section, units).read();
}

}  // namespace gearlash
