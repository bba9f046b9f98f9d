// What `gearlash simulate` was asked for, of servos and of drives.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "gearlash/io/picture.hpp"
#include "servo_options.hpp"

namespace gearlash::cli {

/// A table this long takes about a gigabyte.
inline constexpr double most_samples = 1e7;

struct SimulateOptions {
  ServoOptions servo;
  std::string initial_position = "0";
  std::string initial_speed = "0";
  std::optional<std::string> initial_gap;
  std::string initial_gap_speed = "0";
  std::optional<std::string> reference;
  std::optional<std::string> until;
  std::optional<std::string> every;
  bool events = false;
  std::string format = "csv";
  std::vector<std::string> plots;
  std::string output = "-";
};

struct Plot {
  bool is_phase_plane = false;
  std::string file;
  PictureFormat format = PictureFormat::svg;
};

/// The motion of a drive without a closed form. `faults` has those found so far.
ExitStatus simulate_drive(DriveFile file, const SimulateOptions& options,
                          const std::vector<Plot>& plots, const Provenance& provenance,
                          Faults& faults);

}  // namespace gearlash::cli
