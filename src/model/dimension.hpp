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
};

namespace dimensions {
inline constexpr Dimension angle{
    .name = "angle", .unit = "rad", .radian = 1, .angle = AngleRule::required};
inline constexpr Dimension time{.name = "time", .unit = "s", .second = 1};
inline constexpr Dimension angular_speed{.name = "angular speed",
                                         .unit = "rad/s",
                                         .second = -1,
                                         .radian = 1,
                                         .angle = AngleRule::required};
inline constexpr Dimension angular_frequency{.name = "angular frequency",
                                             .unit = "rad/s",
                                             .second = -1,
                                             .radian = 1,
                                             .angle = AngleRule::required};
inline constexpr Dimension inertia{
    .name = "moment of inertia", .unit = "kg m2", .metre = 2, .kilogram = 1};
inline constexpr Dimension torque_per_speed{.name = "torque per angular speed",
                                            .unit = "N m s/rad",
                                            .metre = 2,
                                            .kilogram = 1,
                                            .second = -1,
                                            .radian = -1,
                                            .angle = AngleRule::optional};
inline constexpr Dimension torque_per_current{.name = "torque per current",
                                              .unit = "N m/A",
                                              .metre = 2,
                                              .kilogram = 1,
                                              .second = -2,
                                              .ampere = -1};
inline constexpr Dimension torque_per_voltage{
    .name = "torque per voltage", .unit = "N m/V", .second = 1, .ampere = 1};
inline constexpr Dimension voltage_per_speed{.name = "voltage per angular speed",
                                             .unit = "V s/rad",
                                             .metre = 2,
                                             .kilogram = 1,
                                             .second = -2,
                                             .ampere = -1,
                                             .radian = -1,
                                             .angle = AngleRule::optional};
inline constexpr Dimension voltage_per_angle{.name = "voltage per angle",
                                             .unit = "V/rad",
                                             .metre = 2,
                                             .kilogram = 1,
                                             .second = -3,
                                             .ampere = -1,
                                             .radian = -1,
                                             .angle = AngleRule::required};
inline constexpr Dimension resistance{.name = "electrical resistance",
                                      .unit = "ohm",
                                      .metre = 2,
                                      .kilogram = 1,
                                      .second = -3,
                                      .ampere = -2};

inline constexpr Dimension inductance{
    .name = "inductance", .unit = "H", .metre = 2, .kilogram = 1, .second = -2, .ampere = -2};
inline constexpr Dimension current{.name = "current", .unit = "A", .ampere = 1};

inline constexpr Dimension torque{
    .name = "torque", .unit = "N m", .metre = 2, .kilogram = 1, .second = -2};
inline constexpr Dimension torque_per_angle{.name = "torque per angle",
                                            .unit = "N m/rad",
                                            .metre = 2,
                                            .kilogram = 1,
                                            .second = -2,
                                            .radian = -1,
                                            .angle = AngleRule::required};
inline constexpr Dimension torque_per_angle_and_time{.name = "torque per angle and time",
                                                     .unit = "N m/(rad s)",
                                                     .metre = 2,
                                                     .kilogram = 1,
                                                     .second = -3,
                                                     .radian = -1,
                                                     .angle = AngleRule::required};
inline constexpr Dimension voltage{
    .name = "voltage", .unit = "V", .metre = 2, .kilogram = 1, .second = -3, .ampere = -1};
inline constexpr Dimension voltage_per_angle_and_time{.name = "voltage per angle and time",
                                                      .unit = "V/(rad s)",
                                                      .metre = 2,
                                                      .kilogram = 1,
                                                      .second = -4,
                                                      .ampere = -1,
                                                      .radian = -1,
                                                      .angle = AngleRule::required};
inline constexpr Dimension angular_acceleration{.name = "angular acceleration",
                                                .unit = "rad/s2",
                                                .second = -2,
                                                .radian = 1,
                                                .angle = AngleRule::required};
inline constexpr Dimension rate{.name = "rate", .unit = "1/s", .second = -1};
inline constexpr Dimension speed_per_voltage{.name = "angular speed per voltage",
                                             .unit = "rad/(s V)",
                                             .metre = -2,
                                             .kilogram = -1,
                                             .second = 2,
                                             .ampere = 1,
                                             .radian = 1,
                                             .angle = AngleRule::required};
}  // namespace dimensions

}  // namespace gearlash
