// The servo that the command line describes: a file, options, or a file changed by options.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "gearlash/design.hpp"
#include "gearlash/grid.hpp"
#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "model/proportional_servo.hpp"
#include "question/axis.hpp"

namespace gearlash::cli {

/// As typed; empty where not given.
struct ServoOptions {
  std::string file;  ///< "-": standard input
  /// Of the normal form, as normal_form_numbers.
  std::array<std::optional<std::string>, normal_form_numbers.size()> numbers;
  std::optional<std::string> sensor;
  std::vector<std::string> settings;  ///< of --set
  /// Of what is asked of the drive, as specification_options.
  std::array<std::optional<std::string>, 3> asked;

  std::optional<std::string>& backlash() {
    static_assert(normal_form_numbers[3].path == "servo.backlash");
    return numbers[3];
  }
};

/// "--inertia-ratio" for inertia_ratio.
std::string option_name(std::string field);

/// Without the file.
void add_drive_options(const Command& command, ServoOptions& options,
                       const std::string& sensor_help);
void add_servo_options(const Command& command, ServoOptions& options);
/// The same for a command that takes any drive.
void add_servo_or_drive_options(const Command& command, ServoOptions& options);

/// A file of a command: its use, such as "--output", and its name.
struct FileUse {
  std::string use;
  std::string file;
};

/// --set PATH=VALUE, repeatable.
void add_set_option(const Command& command, ServoOptions& options);

/// Collects the faults of a command line, so that all of them are reported at once.
class Faults {
 public:
  /// One fault of several drives is reported once.
  void add(Fault fault);
  void add(std::string_view field, std::string_view value, std::string_view permitted) {
    add({std::string(field), std::string(value), std::string(permitted)});
  }
  void add(const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) add(fault);
  }
  /// What `read` returns, or `otherwise` when it throws InvalidInput, whose faults are kept.
  template <class Read, class Value>
  Value collect(const Read& read, Value otherwise) {
    try {
      return read();
    } catch (const InvalidInput& error) {
      add(error.faults());
      return otherwise;
    }
  }
  /// `value` if it is one of `choices`, else a fault of `field`.
  void require_choice(const std::string& field, const std::string& value,
                      const std::vector<std::string>& choices);
  /// Adds a fault for each option that is given, with its value: --brief would drop it.
  void refuse_beside_brief(const std::vector<std::pair<const char*, std::string>>& options);
  /// Adds a fault for each output that is the same file as one of `others`, which are read, or as
  /// another output, because one would be lost. Empty names, "-" and devices are exempt.
  void require_distinct(std::vector<FileUse> others, const std::vector<FileUse>& outputs);
  /// Adds a fault for each output that cannot be written.
  void require_writable(const std::vector<FileUse>& outputs);
  bool none() const { return faults_.empty(); }
  void require_none() const { gearlash::require_none(faults_); }

 private:
  std::vector<Fault> faults_;
};

/// The axis that `read` returns. A line on standard error names the values that it left out.
Axis collect_axis(const std::function<Axis(std::string* left_out)>& read, Faults& faults);

/// The target of --target; an empty one where there is a fault. `drive`: nullptr if it is not
/// known; a normal form without a natural frequency has no times.
Target collect_target(const std::string& text, const Drive* drive, Faults& faults);

/// A whole number of an option; a fault otherwise, and `least`.
std::uint64_t collect_whole(const char* field, const std::string& text, std::uint64_t least,
                            std::uint64_t most, Faults& faults);

/// The axes that `read(text, left_out)` gives for the texts, without those at fault.
template <class Text, class Read>
std::vector<Axis> collect_axes(const std::vector<Text>& texts, const Read& read, Faults& faults) {
  std::vector<Axis> axes;
  for (const Text& text : texts) {
    Axis axis = collect_axis([&](std::string* left_out) { return read(text, left_out); }, faults);
    if (!axis.values.empty()) axes.push_back(std::move(axis));
  }
  return axes;
}
/// Those of an option that names several: those that `read` (read_axis_or_name() or a like
/// function) gives.
std::vector<Axis> collect_axes(const char* field, const std::vector<std::string>& texts,
                               const Drive& drive, AxisReader read, Faults& faults);

/// Those that --parameters names for a search; a line on standard error for each that has values
/// with which the drive would have faults: the search begins where it has none.
std::vector<Axis> collect_axes_to_search(const std::vector<std::string>& texts, const Drive& drive,
                                         Faults& faults);

/// A positive time of an option, in s or with its unit; a fault otherwise.
double read_time(const char* field, const std::string& text, Faults& faults);

/// A share above 0 and up to 1, "95 %" or 0.95; a fault otherwise, and 0.5.
double read_share(const char* field, const std::string& text, Faults& faults);

/// Whether a file or options describe a drive.
bool has_drive(const ServoOptions& options);

/// The drive as its user has it: the file, or the normal form of the options, with the settings of
/// --set. Adds faults to `faults`, also those of `outputs`: Faults::require_distinct() beside every
/// file that is read, and Faults::require_writable(). Without faults there is a result, and it is
/// valid.
std::optional<WrittenDrive> resolve_drive(const ServoOptions& options,
                                          const std::vector<FileUse>& outputs, Faults& faults);

/// The tables that a drive of this file ("-": standard input) names, in the file or by --set.
std::vector<FileUse> files_of_tables(Drive drive, const std::string& file);

/// The servo of 1960 that the drive is. Throws InvalidInput, located at the file, for any other.
ProportionalServo servo_of_1960(const WrittenDrive& written, const ServoOptions& options);

}  // namespace gearlash::cli
