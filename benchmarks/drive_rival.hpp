// A sampled drive with dry friction and faces that give, by SUNDIALS CVODE, as one writes it down
// by hand: equations for each way that faces and friction may be, roots where they change, and a
// new start at each of these and at each tick of the controller, where the torque jumps.
#pragma once

#include <array>
#include <memory>

#include "cvode_rival.hpp"
#include "model/drive.hpp"

namespace gearlash::benchmarks {

class CvodeDriveRival {
 public:
  /// Of a drive with CompliantContact (ContactDamping::full), constant reference, no load torque, a
  /// position sensor on the load and a tachometer on the motor, and sampling without delay;
  /// breakaway is Coulomb friction.
  CvodeDriveRival(const drive::ReducedDrive& drive, CvodeMethod method);
  ~CvodeDriveRival();
  CvodeDriveRival(CvodeDriveRival&&) noexcept;

  /// Motor's position and speed, load's position and speed, from rest at 0.
  std::array<double, 4> run(double until);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace gearlash::benchmarks
