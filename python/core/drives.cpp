// Drives with their tolerances: read, changed, written.
#include <pybind11/stl.h>

#include "base/lists.hpp"
#include "gearlash/fault.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"
#include "module.hpp"
#include "output/drive_text.hpp"
#include "output/records.hpp"
#include "record.hpp"

namespace gearlash::python {
namespace {

/// Drives in Python carry the points of their tables, so that they can be copied to other machines.
void forget_files(Drive& drive) {
  for (std::optional<Signal>* signal : {&drive.reference, &drive.load_torque}) {
    if (!*signal) continue;
    if (auto* table = std::get_if<TableSignal>(&**signal)) table->file.clear();
  }
}

/// `angle_unit` is kept where the text names no other one than rad.
TolerancedDrive read(const std::string& text, const std::string& name, const std::string& folder,
                     const std::vector<std::pair<std::string, std::string>>& settings,
                     bool is_of_program, const std::string& angle_unit) {
  const auto setting_of = [](const auto& one) { return Setting{one.first, one.second}; };
  WrittenDrive written = parse_drive(text, name, folder, of_each(settings, setting_of),
                                     is_of_program ? BareNumbers::in_si : BareNumbers::refused);
  if (written.drive.angle_unit.radians == 1.0 && angle_unit != "rad") {
    written.drive.angle_unit =
        angle_unit_of(read_measured("angle_unit", "1 " + angle_unit, dimensions::angle));
  }
  forget_files(written.drive);
  return {std::move(written.drive), std::move(written.tolerances)};
}

/// A number that is set has no tolerance, as one that the tool sets has none.
TolerancedDrive with_numbers(TolerancedDrive drive,
                             const std::vector<std::pair<std::string, double>>& numbers) {
  for (const auto& [path, value] : numbers) {
    set(drive.nominal, path, value);
    std::erase_if(drive.varied, [&, &changed = path](const ParameterTolerance& varied) {
      return find_parameter(varied.path) == find_parameter(changed);
    });
  }
  require_none(faults(drive.nominal));
  return drive;
}

/// As its file reads, so that a drive is all that its file says.
TolerancedDrive with_tolerances(const TolerancedDrive& drive, py::handle tolerances) {
  const TolerancedDrive varied{
      drive.nominal, from_python<std::vector<ParameterTolerance>>(tolerances, "tolerances")};
  require_none(faults(varied));
  return read(given_toml(varied), "", "", {}, true, drive.nominal.angle_unit.name);
}

TolerancedDrive checked_normal_form(double damping, double inertia_ratio, double friction_ratio,
                                    double backlash, double restitution,
                                    std::optional<double> natural_frequency) {
  Drive drive = normal_form(damping, inertia_ratio, friction_ratio, backlash, restitution);
  drive.servo->natural_frequency = natural_frequency;
  require_none(faults(drive));
  return {std::move(drive), {}};
}

}  // namespace

void add_drives(py::module_& module) {
  using Bound = TolerancedDrive;
  py::class_<Bound>(module, "Drive")
      .def(py::init<>())
      .def("get",
           [](const Bound& drive, const std::string& path) { return get(drive.nominal, path); })
      .def("parameters", [](const Bound& drive) { return to_python(parameters_of(drive.nominal)); })
      .def("to_toml", [](const Bound& drive) { return to_toml(drive); })
      .def("given_toml", [](const Bound& drive) { return given_toml(drive); })
      .def_property_readonly("angle_unit",
                             [](const Bound& drive) { return drive.nominal.angle_unit.name; })
      .def("with_numbers", with_numbers)
      .def("with_tolerances", with_tolerances)
      .def_property_readonly("tolerances",
                             [](const Bound& drive) { return to_python(drive.varied); })
      .def_property_readonly("is_normal_form",
                             [](const Bound& drive) { return drive.nominal.servo.has_value(); });
  module.def("save", [](const std::string& path, const std::string& text) { save(path, text); });
  module.def("read", read);
  module.def("normal_form", checked_normal_form);
  module.def("quantities", [] { return to_python(quantities()); });
}

}  // namespace gearlash::python
