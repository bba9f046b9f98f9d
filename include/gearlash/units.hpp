// Numbers with units: read as engineers write them ("28.2 ozf in/A", "12 arcmin"), and written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/bounds.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/fault.hpp"

namespace gearlash {

// ---- dimensions ---------------------------------------------------------------------------------

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

// ---- reading ------------------------------------------------------------------------------------

struct Measured {
  double si = 0.0;          ///< in the SI unit of the expected dimension
  double unit_in_si = 1.0;  ///< the author's unit in SI
  std::string unit = {};    ///< the unit as the author wrote it
};

/// Reads "<number> <unit>", or a plain 0, which needs no unit. The number is decimal with a point,
/// in every locale. The unit is a product or quotient of powers of UDUNITS-2's units and the
/// aliases of docs/reference/data-sheets.md ("oz in2", "oz-in^2", "N·m/A", "mNm/A", "V/(rad/s)",
/// "V/krpm").
///
/// Differences from UDUNITS: oz is the avoirdupois ounce (a mass), Hz is 2π rad/s (cycles per
/// second), and reciprocals, offsets and logarithms are not converted. A dimension that may omit
/// the radian then requires time in seconds, because "V min" could be per rad/min or per rpm.
///
/// Throws InvalidInput with one fault, of `field`, for text that is not a number and a unit, for an
/// unknown unit or another dimension, for one of so many factors that it loses digits, and for a
/// value that no double represents.
Measured read_quantity(std::string_view field, std::string_view text, const Dimension& expected);

/// "an angle with its unit".
std::string with_unit(const Dimension& dimension);
/// "an angle, such as 12 arcmin".
std::string described(const Dimension& dimension);

/// read_quantity(…).si
double to_si(std::string_view field, std::string_view text, const Dimension& expected);

/// Reads a dimensionless number: decimal ("0.19", "1e-3"), a fraction of two ("1/9", "43:1"), or
/// "inf". Throws InvalidInput with one fault, of `field`, for anything else (NaN, hexadecimal,
/// 1e999, 1/0).
double read_number(std::string_view field, std::string_view text);

/// Reads the text of a number without unit, as read_number() does.
using NumberText = double (*)(std::string_view field, std::string_view text);

/// read_number() of one that must not exceed 1: above 1, however little, it is not read as 1.
double read_part(std::string_view field, std::string_view text);

/// read_part() of a share, which may be in percent: "0.72", "72 %".
double read_share(std::string_view field, std::string_view text);

/// read_number(), but nothing for text that is not a number or has a unit.
std::optional<double> bare_number(std::string_view text);

/// Whether a number in a text may be another one than the shortest decimal of the double that it is
/// read as: is_long_decimal() of any number in it, which may have TOML's underscores, or a fraction
/// that is not a short decimal, such as "1/3".
bool has_long_decimal(std::string_view written);

/// Reads a whole number without sign, fraction or exponent. Throws InvalidInput, of `field`, for
/// anything else and for numbers outside `least` to `most`.
std::uint64_t read_whole(std::string_view field, std::string_view text, std::uint64_t least,
                         std::uint64_t most);

/// Reads a finite number in SI, or one with its unit ("12 arcmin"). Throws as read_number() and
/// read_quantity() do.
Measured read_measured(std::string_view field, std::string_view text, const Dimension& expected);

/// The unit of an angle as its author has it.
AngleUnit angle_unit_of(const Measured& angle);

/// The author's text, fit for one line of an error: control characters and invalid UTF-8 are
/// escaped, empty or blank text is quoted, and text beyond `limit` characters becomes "…".
std::string shown(std::string_view text, std::size_t limit = 60);

/// Throws InvalidInput with one fault: `field` has the value `text`.
[[noreturn]] void refuse(std::string_view field, std::string_view text, std::string permitted);

/// The text without blanks and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// The trimmed parts between separators, at least one.
std::vector<std::string_view> split(std::string_view text, std::string_view separator);

// ---- writing ------------------------------------------------------------------------------------

/// Of a result that a person reads beside others.
inline constexpr int usual_digits = 4;

/// The number with at most `digits` significant digits: "0.0814", "14200", "1.2e-05", "inf".
std::string significant(double value, int digits);

/// An upper bound: the next number of `digits` significant digits that is not below it.
double rounded_up(double bound, int digits);
/// A lower bound likewise, not above it.
double rounded_down(double bound, int digits);

/// "gap (rad)"; the name alone of what has no unit.
std::string name_with_unit(const std::string& name, const std::string& unit);

/// A change by this ratio: "+12.3 %", "−40 %", "×26".
std::string change_text(double ratio);

/// "12.3 arcmin".
std::string angle_text(double radians, const AngleUnit& unit, int digits);

/// Numbers of one drive with units: angles in its author's; times, and what follows from them, in
/// units of 1/ω_n for a normal form without a natural frequency.
class DriveUnits {
 public:
  explicit DriveUnits(const Drive& drive, int digits = usual_digits);

  std::string number(double value) const { return significant(value, digits_); }
  std::string angle(double radians) const { return angle_text(radians, angle_, digits_); }
  /// "0.1 … 0.2 rad", or one number where the ends hardly differ.
  std::string angles(const Bounds& range) const;
  /// A lower bound, rounded down: "1.2 arcmin".
  std::string at_least(double radians) const;
  /// An amplitude: "±12.3 arcmin".
  std::string swing(double amplitude) const { return "±" + angle(amplitude); }
  /// An upper bound of an amplitude, rounded up: "±12.4 arcmin".
  std::string swing_at_most(double amplitude) const;
  /// "0.54 s"; "6.456 / ω_n".
  std::string time(double seconds) const { return in(seconds, " / ω_n", " s"); }
  /// Of a period: "1.85 Hz"; "0.973 ω_n".
  std::string frequency(double period) const;
  /// " at 1.85 Hz"; ", period 6.456 / ω_n".
  std::string pace(double period) const;
  /// The number with one of two units.
  std::string in(double value, const char* normalized, const char* otherwise) const {
    return number(value) + (is_normalized_ ? normalized : otherwise);
  }

  bool is_normalized() const { return is_normalized_; }

 private:
  AngleUnit angle_;
  bool is_normalized_;
  int digits_;
};

}  // namespace gearlash
