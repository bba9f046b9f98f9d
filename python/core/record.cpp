#include "record.hpp"

#include "output/records.hpp"

namespace gearlash::python {

py::handle class_named(const char* name) {
  // The module keeps its classes alive.
  return py::object(py::module_::import("gearlash._records").attr(name)).ptr();
}

namespace {

py::handle drive_class() {
  return py::object(py::module_::import("gearlash._drive").attr("Drive")).ptr();
}

}  // namespace

py::object drive_to_python(Drive drive) {
  return drive_class().attr("_of")(py::cast(TolerancedDrive{std::move(drive), {}}));
}

Drive drive_of(py::handle object) {
  if (!py::isinstance(object, drive_class())) refuse_type("drive", "a gearlash.Drive", object);
  return object.attr("_core").cast<const TolerancedDrive&>().nominal;
}

void refuse_type(const char* name, const std::string& permitted, py::handle found) {
  const std::string type = py::str(py::type::handle_of(found).attr("__name__"));
  throw py::type_error(std::string(name) + " must be " + permitted + ", not " + type);
}

}  // namespace gearlash::python
