#include "model/enclosed_drive.hpp"

#include <utility>

#include "model/number_members.hpp"

namespace gearlash {
namespace {

drive::ReducedDriveOf<Interval> as_written(const drive::ReducedDrive& drive) {
  drive::ReducedDriveOf<Interval> result;
  set_numbers([](double from, Interval& to) { to = AsWritten()(from); }, drive, result);
  return result;
}

/// The signals alone, in the place of a drive.
Drive signals_of(const drive::ReducedDrive& drive) {
  Drive result;
  result.reference = drive.reference;
  result.load_torque = drive.load_torque;
  return result;
}

}  // namespace

EnclosedDrive::EnclosedDrive(const Drive& drive) : EnclosedDrive(drive, reduce_settled(drive)) {}

EnclosedDrive::EnclosedDrive(const Drive& drive, drive::ReducedDrive settled)
    : form_(std::move(settled)),
      numbers_(reduced(drive, AsWritten())),
      course_(Reduction<AsWritten>(drive).course()) {
  numbers_.reference = form_.reference;
  numbers_.load_torque = form_.load_torque;
  if (std::holds_alternative<double>(form_.reference)) numbers_.feedforward = {};
  add_controller();
}

EnclosedDrive::EnclosedDrive(const drive::ReducedDrive& drive)
    : form_(drive),
      numbers_(as_written(drive)),
      course_(Reduction<AsWritten>(signals_of(drive)).course()) {
  add_controller();
}

void EnclosedDrive::add_controller() {
  controller_ = numbers_.controller;
  if (!form_.sampling) return;
  const Sampling& sampling = *form_.sampling;
  period_ = AsWritten()(sampling.period);
  controller_ = drive::sampled_controller(controller_, period_, sampling.method);
  held_torques_ = gearlash::held_torques(period_, AsWritten()(sampling.delay), sampling);
}

void EnclosedDrive::widen_to(const EnclosedDrive& other) {
  const auto widen = [](const Interval& from, Interval& to) { to = hull(to, from); };
  set_numbers(widen, other.numbers_, numbers_);
  set_numbers(widen, other.course_, course_);
  set_numbers(widen, other.controller_, controller_);
  set_numbers(widen, other.period_, period_);
  set_numbers(widen, other.held_torques_, held_torques_);
}

}  // namespace gearlash
