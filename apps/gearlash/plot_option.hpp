// --plot KIND=FILE: what is drawn, and where to.
#pragma once

#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "servo_options.hpp"

namespace gearlash::cli {

struct Plot {
  std::string kind;
  std::string file;
  PictureFormat format = PictureFormat::svg;
};

/// Every text of --plot. Faults: no KIND=FILE, a KIND that is not among `kinds` (with the nearest
/// one), another ending than .svg, .png or .pdf.
std::vector<Plot> read_plots(const std::vector<std::string>& typed,
                             const std::vector<std::string>& kinds, Faults& faults);

/// The files that they name, for Faults::require_distinct().
std::vector<FileUse> files_of(const std::vector<Plot>& plots);

bool has_kind(const std::vector<Plot>& plots, const std::string& kind);

/// The option, repeatable; `kinds` says what each of them draws, a line each.
Option* add_plot_option(Command& command, std::vector<std::string>& typed,
                        const std::string& kinds);

}  // namespace gearlash::cli
