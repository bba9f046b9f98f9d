// Plots of motions, for what draws them in Python.
#include <pybind11/stl.h>

#include "gearlash/motion.hpp"
#include "input/units.hpp"
#include "model/reduced_drive.hpp"
#include "module.hpp"
#include "picture/motion_picture.hpp"
#include "python/inner_records.hpp"
#include "question/motion.hpp"
#include "record.hpp"

namespace gearlash::python {
namespace {

MotionPicture picture_of(const Motion& motion, py::handle drive, const std::string& unit) {
  MotionPicture picture{.drive = drive_of(drive)};
  picture.drive.angle_unit = angle_unit_of(read_measured("unit", "1 " + unit, dimensions::angle));
  if (is_normalized(picture.drive)) picture.drive.servo->natural_frequency = 1.0;  // as in all SI
  picture.period = period_of_loop(picture.drive);
  picture.motions.push_back({.motion = motion});
  return picture;
}

py::object over_time(const Motion& motion, py::handle drive, const std::string& unit) {
  return to_python(drawn(time_plot(picture_of(motion, drive, unit))));
}

/// The cycle that the motion repeats from `from` on.
py::object cycle_of(const Motion& motion, py::handle drive, const std::string& unit, double from) {
  MotionPicture picture = picture_of(motion, drive, unit);
  picture.motions.front().from = from;
  return to_python(drawn(phase_plot(picture)));
}

}  // namespace

void add_plots(py::module_& module) {
  module.def("plot_over_time", over_time);
  module.def("plot_of_cycle", cycle_of);
}

}  // namespace gearlash::python
