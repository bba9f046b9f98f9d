// Quantities as engineers write them ("28.2 ozf in/A", "12 arcmin"), into SI.
#pragma once

#include <string>
#include <string_view>

#include "base/violation.hpp"

namespace gearlash {

/// What the radian means in a dimension. SI calls it 1, so only this rule tells rad/s from 1/s.
enum class AngleRule {
  absent,    ///< there is no angle in it: "kg m2/rad" is no moment of inertia
  required,  ///< rad, deg, rev, … must be written, at the power `radian`
  optional   ///< written at the power `radian`, or left out: "N m s" means "N m s/rad"
};

/// A physical dimension: the powers of the base units, and the words errors say it with.
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

/// The dimensions of the keys of a data sheet.
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

// Those that only drives have.

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
}  // namespace dimensions

struct Quantity {
  double si = 0.0;          ///< in the SI unit of the dimension asked for
  double unit_in_si = 1.0;  ///< one of the author's units, in SI
  std::string unit = {};    ///< the unit as the author wrote it
};

/// Reads "<number> <unit>". The number is a decimal one with a point, whatever the locale; the unit
/// is a product or quotient of powers of UDUNITS-2's units and the aliases of docs/data-sheets.md
/// ("oz in2", "oz-in^2", "N·m/A", "mNm/A", "V/(rad/s)", "V/krpm").
///
/// Beyond UDUNITS: oz is the avoirdupois ounce (a mass), Hz is 2π rad/s (cycles per second), and
/// nothing is converted by its reciprocal, an offset or a logarithm. Where a radian may be left
/// out, time must then be in seconds, since "V min" could be per rad/min or per rpm.
///
/// Throws InvalidInput with one violation, of `field`, for a text that is no number and unit,
/// for an unknown unit, another dimension, or a value that is not representable. UDUNITS-2 is not
/// thread-safe: calls are serialised here, but do not call it yourself at the same time.
Quantity read_quantity(std::string_view field, std::string_view text, const Dimension& expected);

/// read_quantity(…).si
double to_si(std::string_view field, std::string_view text, const Dimension& expected);

/// A dimensionless number: decimal ("0.19", "1e-3"), a fraction of two ("1/9"), or "inf". Throws
/// InvalidInput with one violation, of `field`, for anything else (NaN, hexadecimal, 1e999, 1/0).
double read_number(std::string_view field, std::string_view text);

/// A finite angle: a number of radians, or a number with its unit ("12 arcmin"). Throws as
/// read_number() and read_quantity() do.
Quantity read_angle(std::string_view field, std::string_view text);

/// Author's text made fit for one line of an error: control characters and invalid UTF-8 escaped,
/// an empty or blank text quoted, at most `limit` characters and then "…".
std::string shown(std::string_view text, std::size_t limit = 60);

}  // namespace gearlash
