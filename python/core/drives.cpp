// Drives: read, changed, written.
#include <pybind11/stl.h>

#include "gearlash/output.hpp"
#include "gearlash/parameter.hpp"
#include "input/drive_file.hpp"
#include "module.hpp"
#include "records.hpp"

namespace gearlash::python {
namespace {

/// Drives in Python carry the points of their tables, so that they can be copied to other machines.
void forget_files(Drive& drive) {
  for (std::optional<Signal>* signal : {&drive.reference, &drive.load_torque}) {
    if (!*signal) continue;
    if (auto* table = std::get_if<TableSignal>(&**signal)) table->file.clear();
  }
}

py::tuple read(const std::string& text, const std::string& name, const std::string& folder,
               const std::vector<std::pair<std::string, std::string>>& settings,
               bool is_of_program) {
  std::vector<Setting> list;
  for (const auto& [path, value] : settings) list.push_back({path, value});
  WrittenDrive written = parse_drive(text, name, folder, list,
                                     is_of_program ? BareNumbers::in_si : BareNumbers::refused);
  forget_files(written.drive);
  return py::make_tuple(py::cast(std::move(written.drive)), to_python(written.tolerances));
}

Drive with_numbers(Drive drive, const std::vector<std::pair<std::string, double>>& numbers) {
  for (const auto& [path, value] : numbers) set(drive, path, value);
  if (const std::vector<Fault> found = faults(drive); !found.empty()) throw InvalidInput(found);
  return drive;
}

Drive checked_normal_form(double damping, double inertia_ratio, double friction_ratio,
                          double backlash, double restitution,
                          std::optional<double> natural_frequency) {
  Drive drive = normal_form(damping, inertia_ratio, friction_ratio, backlash, restitution);
  drive.servo->natural_frequency = natural_frequency;
  if (const std::vector<Fault> found = faults(drive); !found.empty()) throw InvalidInput(found);
  return drive;
}

}  // namespace

void add_drives(py::module_& module) {
  py::class_<Drive>(module, "Drive")
      .def(py::init<>())
      .def("get", [](const Drive& drive, const std::string& path) { return get(drive, path); })
      .def("parameters", [](const Drive& drive) { return to_python(parameters_of(drive)); })
      .def("to_toml", [](const Drive& drive) { return to_toml(drive); })
      .def("with_numbers", with_numbers)
      .def_property_readonly("is_normal_form",
                             [](const Drive& drive) { return drive.servo.has_value(); });
  module.def("save", [](const std::string& path, const std::string& text) { save(path, text); });
  module.def("read", read);
  module.def("normal_form", checked_normal_form);
  module.def("quantities", [] {
    const std::span<const QuantityInfo> all = quantities();
    return to_python(std::vector<QuantityInfo>(all.begin(), all.end()));
  });
}

}  // namespace gearlash::python
