// Every number, word and list of a drive by its path: "motor.inertia", "controller.A[1][2]".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/drive.hpp"

namespace gearlash {

enum class ParameterKind : std::uint8_t {
  number,
  choice,  ///< one of several words
  list,    ///< of numbers
  matrix,  ///< rows of numbers
  file     ///< the name of one
};

/// Facts about one parameter. Texts are of static storage.
struct ParameterInfo {
  std::string_view path{};                     ///< as in files
  ParameterKind kind = ParameterKind::number;  ///< what its value is
  std::string_view unit{};                  ///< SI; empty for a number without unit, a word, a list
  std::string_view meaning{};               ///< one sentence, without a full stop
  std::vector<std::string_view> choices{};  ///< of a word
  std::vector<std::string_view> aliases{};  ///< other paths, inverse forms among them
  bool is_required = false;                 ///< a file must give it
  double usual_low = 0.0;       ///< for a number: a range worth studying if nothing else
  double usual_high = 0.0;      ///< is known; both 0 if there is none
  bool is_logarithmic = false;  ///< of that range
};

/// The parameters that this drive has, in the order of files.
[[nodiscard]] std::vector<ParameterInfo> parameters_of(const Drive& drive);

// A normal form also has the numbers of the drive that it stands for, with a total inertia of
// 1 kg m² and a gear ratio of 1: "load.inertia" is then a share of it. Where one of them is set the
// normal form becomes that drive.

/// A number in SI, or its default if it is not given. Throws InvalidInput for a path that the drive
/// does not have, for one that is no number, and for one without value and default.
[[nodiscard]] double get(const Drive& drive, std::string_view path);

/// Sets a number in SI, also by an alias or an inverse form. Adds the optional part of the drive
/// (sampling, for example) if needed. The drive need not be sound afterwards: see faults(). Throws
/// InvalidInput as get() does.
void set(Drive& drive, std::string_view path, double value);

/// Sets a number with its unit, "30 arcmin", a word, or a list, "[1, 2.5]". Also throws
/// InvalidInput for text that it cannot read.
void set(Drive& drive, std::string_view path, std::string_view text);

}  // namespace gearlash
