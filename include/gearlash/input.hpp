// Reads drives and sweeps from TOML files; axes and targets from text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/design.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/tolerance.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

/// Reads a file of at most 1 MiB. docs/reference/drives.md has the keys. Tables of signals are
/// files beside it. Tolerances are left out. Throws InvalidInput with every fault and its place.
[[nodiscard]] Drive read_drive(const std::filesystem::path& toml);

/// The same for text; tables are in `folder`.
[[nodiscard]] Drive parse_drive(std::string_view toml, const std::filesystem::path& folder = {});

/// The drive with its tolerances, in the order of the file.
[[nodiscard]] TolerancedDrive read_toleranced_drive(const std::filesystem::path& toml);

/// A target as it is typed: "no-hunting", "amplitude <= 1 arcmin and frequency >= 5 Hz". Conditions
/// are joined by "and". Quantities are amplitude (a bare number is in radians), frequency ("5 Hz",
/// "30 rad/s"), period and growth-at-rest; < is as good as <=. Throws InvalidInput, naming
/// "target", with all that is wrong: unknown quantities, wrong units, contradictions, and times
/// asked of a normal form without a natural frequency.
[[nodiscard]] Target parse_target(std::string_view text, const Drive& drive);

// ---- drives with what their authors wrote -------------------------------------------------------

/// The contents of a drive file.
struct WrittenDrive {
  Drive drive;  ///< valid
  /// Parameters with tolerances, in the order of the file; the drive holds their nominal values.
  std::vector<ParameterTolerance> tolerances;
  std::string text{};  ///< TOML, of parse_drive_by_form()
  /// "motor.inertia" -> "0.61 oz in2", "reference.file" -> "steps.csv": the text values of all
  /// sections, without settings.
  std::map<std::string, std::string> texts{};
};

/// One parameter's path and its value as text: a number with its unit, a word or a TOML list.
struct Setting {
  std::string path;
  std::string text;
};

/// Whether numbers without a unit are taken, in SI, where a unit belongs: from a program, whose
/// numbers are in SI and whose text may be of any length. In a file they are a fault.
enum class BareNumbers : bool { refused, in_si };

inline constexpr std::size_t largest_drive_file = 1024 * 1024;  ///< bytes

/// Reads TOML text of at most largest_drive_file bytes. docs/reference/drives.md lists the keys,
/// their units and defaults. Error lines call the text `source_name`. `settings` replace values of
/// the text; their faults are located at "--set". Signal tables are read from files in `folder`.
///
/// Throws only InvalidInput and std::bad_alloc. InvalidInput lists every fault in the order of the
/// file: unknown sections and keys (with the nearest known one), missing ones, and values of the
/// wrong type, unit, dimension or range. Each fault is located at the value at fault; a missing key
/// is located at its section's header. Text that is not TOML, not UTF-8 or too long counts as one
/// fault.
WrittenDrive parse_drive(std::string_view toml, std::string_view source_name,
                         const std::filesystem::path& folder,
                         const std::vector<Setting>& settings = {},
                         BareNumbers bare_numbers = BareNumbers::refused);
/// The same with settings by whether the text gives the servo in its normal form, that is, has the
/// section [servo].
using SettingsOfForm = std::function<std::vector<Setting>(bool is_normal_form)>;
WrittenDrive parse_drive_by_form(std::string_view toml, std::string_view source_name,
                                 const std::filesystem::path& folder,
                                 const SettingsOfForm& settings);

/// A table of a signal that a drive names by its file.
struct NamedTable {
  std::string_view path{};      ///< of its parameter: "reference.file"
  std::string* file = nullptr;  ///< in the drive
};
/// Those of the drive, in the order of files. The drive must outlive them.
std::vector<NamedTable> named_tables(Drive& drive);

/// Reads "PATH=VALUE". "PATH=none" removes a key, "SECTION=none" a section. Throws InvalidInput for
/// text without "=", and for an unknown path, with the nearest known one.
Setting read_setting(const std::string& text);

/// "load", "motor", "both".
const char* name_of(SensorPlace place);

// ---- axes and targets ---------------------------------------------------------------------------

/// An axis whose values are still text, because their units depend on the drive.
struct AxisText {
  std::string field;   ///< "--x"
  std::string name;    ///< a path, or a short name of the normal form
  std::string values;  ///< FROM:TO:COUNT, FROM:TO:COUNT:log or A,B,C
};

/// Throws InvalidInput, naming `field`, for a text without a name or values.
AxisText split_axis(std::string_view field, std::string_view text);

/// The drive that the axes vary. It is reduced to its normal form, natural frequency kept, if an
/// axis varies a number that only the normal form has, such as `damping`. It is_rounded if an axis
/// gives it a decimal with more digits than a double has.
Drive drive_of_axes(const Drive& drive, const std::vector<AxisText>& axes);

/// Reads numbers, fractions and numbers with units; a bare number is in SI. Words name the choices
/// of a parameter. Throws InvalidInput, naming the field, for a parameter that the drive does not
/// have, for unreadable values, and for faults_of_axis().
///
/// If `left_out` is given, values that the parameter must not have are left out, unless that leaves
/// none, and it takes one line that says so.
Axis read_axis(const AxisText& text, const Drive& drive, std::string* left_out = nullptr);

/// Reads an axis of an option, where a name alone has an axis of its own.
using AxisReader = Axis (*)(std::string_view field, std::string_view text, const Drive& drive,
                            std::string* left_out);

/// An axis as typed, or usual_axis() of a name alone: "controller.proportional". Throws as both do.
Axis read_axis_or_name(std::string_view field, std::string_view text, const Drive& drive,
                       std::string* left_out = nullptr);
/// The same for a design: an axis as typed, or axis_to_search() of a name alone.
Axis read_axis_to_search(std::string_view field, std::string_view text, const Drive& drive,
                         std::string* left_out = nullptr);

/// The values that tune() may try: PATH=FROM:TO, by ratio where both ends are positive; an axis as
/// typed; or usual_axis_to_tune() of a name alone. Throws as these do.
Axis read_axis_to_tune(std::string_view field, std::string_view text, const Drive& drive,
                       std::string* left_out = nullptr);

/// The names of all quantities, or those of a kind.
std::vector<std::string> names_of_quantities(std::optional<QuantityKind> kind = {});

/// Whether frequencies are defined: a normalised servo without natural_frequency has none.
enum class TimeScale { known, unknown };

/// Reads conditions joined by "and": no-hunting, no-hunting-if-disturbed, no-runaway, or a
/// quantity, one of <=, <, >= and >, and its limit. Quantities have their names and older names
/// (gearlash/quantity.hpp): amplitude (an angle; by `bare_numbers` also in radians without unit),
/// frequency ("5 Hz",
/// "30 rad/s"), period ("0.2 s"), growth-at-rest (a number) and so on. A drive that comes to rest
/// meets any condition on frequency or period. The sign < permits the limit itself, as <= does.
/// Throws InvalidInput, naming `field`, with every fault: unknown quantities, wrong units,
/// contradictions (faults(Target)).
Target read_target(std::string_view field, std::string_view text, TimeScale time_scale,
                   BareNumbers bare_numbers = BareNumbers::in_si);

// ---- sweeps -------------------------------------------------------------------------------------

struct SweepFile {
  Grid grid;                         ///< valid: faults(grid) is empty
  std::vector<Quantity> quantities;  ///< all known ones if the file names none
  std::string text;                  ///< of the file
  std::vector<std::string>
      left_out{};  ///< a line for each axis of which read_axis() left values out
};

/// The largest number of axes.
inline constexpr std::size_t most_axes_of_a_sweep = 6;
inline constexpr std::size_t largest_sweep_file = 1024 * 1024;  ///< bytes

/// Reads TOML text. The section [sweep] has `axes`, a list of axes as read_axis() reads them, the
/// last varying fastest; `quantities`, a list of names; and `verdicts`, "computed" or "proved". The
/// other sections are those of a drive file without the varied parameters; [servo] without backlash
/// gives amplitudes in backlashes (docs/reference/command-line.md). Signal tables are read from
/// `folder`. Throws InvalidInput with every fault, as parse_drive() does.
SweepFile parse_sweep(std::string_view toml, std::string_view source_name,
                      const std::filesystem::path& folder = {});

/// parse_sweep() of a file's contents.
SweepFile read_sweep_file(const std::filesystem::path& path);

// ---- text ---------------------------------------------------------------------------------------

/// The file's contents. Throws InvalidInput for a file that is missing, unreadable, a directory, or
/// longer than `largest` bytes. Reading stops at that length, because the file may be an endless
/// device.
std::string read_text_file(const std::filesystem::path& path, std::size_t largest);

/// read_text_file() of standard input.
std::string read_standard_input(std::size_t largest);

/// Whether two words are the same in either case: "Kp" and "kp".
bool is_same_word(std::string_view one, std::string_view other);

/// The known name that is nearest to the written one, in either case; none if none is near.
std::optional<std::string> nearest(const std::vector<std::string>& known, std::string_view written);

/// " (did you mean b?)", or "" if no known name is near.
std::string guess_of(const std::vector<std::string>& known, std::string_view written);

/// "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

/// "must be one of a, b, c (did you mean b?)".
std::string one_of(const std::vector<std::string>& known, std::string_view written);

}  // namespace gearlash
