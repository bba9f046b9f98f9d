// Physical dimensions of the numbers of a drive.
#pragma once

#include <string_view>

namespace gearlash {

/// The meaning of the radian in a dimension. SI defines it as 1; this rule separates rad/s from
/// 1/s.
enum class AngleRule {
  absent,    ///< contains no angle: "kg m2/rad" is no moment of inertia
  required,  ///< rad, deg, rev, … must be written, at the power `radian`
  optional   ///< written at the power `radian`, or omitted: "N m s" means "N m s/rad"
};

/// A physical dimension: the powers of the base units, and its words in messages.
struct Dimension {
  std::string_view name;  ///< "torque per current"
  std::string_view unit;  ///< its SI unit, "N m/A"
  int metre = 0;
  int kilogram = 0;
  int second = 0;
  int ampere = 0;
  int radian = 0;
  AngleRule angle = AngleRule::absent;
  std::string_view example{};  ///< as engineers write one: "28.2 ozf in/A"
};

/// In columns: name, SI unit, powers of metre, kilogram, second, ampere and radian, angle, example.
namespace dimensions {
using enum AngleRule;
inline constexpr Dimension angle{"angle", "rad", 0, 0, 0, 0, 1, required, "12 arcmin"};
inline constexpr Dimension time{"time", "s", 0, 0, 1, 0, 0, absent, "250 us"};
inline constexpr Dimension angular_speed{"angular speed", "rad/s",   0, 0, -1, 0, 1,
                                         required,        "3000 rpm"};
inline constexpr Dimension angular_frequency{
    "angular frequency", "rad/s", 0, 0, -1, 0, 1, required, "20 Hz"};
inline constexpr Dimension inertia{"moment of inertia", "kg m2", 2, 1, 0, 0, 0, absent,
                                   "0.3 kg cm2"};
inline constexpr Dimension torque_per_speed{
    "torque per angular speed", "N m s/rad", 2, 1, -1, 0, -1, optional, "0.05 N m s/rad"};
inline constexpr Dimension torque_per_current{
    "torque per current", "N m/A", 2, 1, -2, -1, 0, absent, "0.35 N m/A"};
inline constexpr Dimension torque_per_voltage{"torque per voltage", "N m/V", 0, 0, 1, 1, 0, absent,
                                              "0.02 N m/V"};
inline constexpr Dimension voltage_per_speed{
    "voltage per angular speed", "V s/rad", 2, 1, -2, -1, -1, optional, "3.67 mV/rpm"};
inline constexpr Dimension voltage_per_angle{
    "voltage per angle", "V/rad", 2, 1, -3, -1, -1, required, "10 V/rad"};
inline constexpr Dimension resistance{
    "electrical resistance", "ohm", 2, 1, -3, -2, 0, absent, "2.8 ohm"};
inline constexpr Dimension inductance{"inductance", "H", 2, 1, -2, -2, 0, absent, "1.2 mH"};
inline constexpr Dimension current{"current", "A", 0, 0, 0, 1, 0, absent, "8 A"};
inline constexpr Dimension torque{"torque", "N m", 2, 1, -2, 0, 0, absent, "2 N m"};
inline constexpr Dimension torque_per_angle{"torque per angle", "N m/rad",   2, 1, -2, 0, -1,
                                            required,           "20 N m/rad"};
inline constexpr Dimension torque_per_angle_and_time{
    "torque per angle and time", "N m/(rad s)", 2, 1, -3, 0, -1, required, "50 N m/(rad s)"};
inline constexpr Dimension voltage{"voltage", "V", 2, 1, -3, -1, 0, absent, "24 V"};
inline constexpr Dimension voltage_per_angle_and_time{
    "voltage per angle and time", "V/(rad s)", 2, 1, -4, -1, -1, required, "50 V/(rad s)"};
inline constexpr Dimension angular_acceleration{
    "angular acceleration", "rad/s2", 0, 0, -2, 0, 1, required, "100 rad/s2"};
inline constexpr Dimension torque_per_acceleration{
    "torque per angular acceleration", "N m s2/rad", 2, 1, 0, 0, -1, optional, "0.3 N m s2/rad"};
inline constexpr Dimension voltage_per_acceleration{
    "voltage per angular acceleration", "V s2/rad", 2, 1, -1, -1, -1, optional, "0.1 V s2/rad"};
inline constexpr Dimension rate{"rate", "1/s", 0, 0, -1, 0, 0, absent, "30 1/s"};
inline constexpr Dimension speed_per_voltage{
    "angular speed per voltage", "rad/(s V)", -2, -1, 2, 1, 1, required, "260 rpm/V"};
}  // namespace dimensions

}  // namespace gearlash
