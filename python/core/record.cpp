#include "record.hpp"

#include "records.hpp"

namespace gearlash::python {

py::handle class_named(const char* name) {
  return py::object(py::module_::import("gearlash._records").attr(name)).release();
}

py::object drive_to_python(Drive drive) {
  static const py::handle type =
      py::object(py::module_::import("gearlash._drive").attr("Drive")).release();
  return type.attr("_of")(py::cast(std::move(drive)));
}

const Drive& drive_of(py::handle object) {
  const py::object core = py::getattr(object, "_core", py::none());
  if (!py::isinstance<Drive>(core)) refuse_type("drive", "a gearlash.Drive", object);
  return core.cast<const Drive&>();  // which `object` keeps alive
}

void refuse_type(const char* name, const std::string& permitted, py::handle found) {
  const std::string type = py::str(py::type::handle_of(found).attr("__name__"));
  throw py::type_error(std::string(name) + " must be " + permitted + ", not " + type);
}

}  // namespace gearlash::python
