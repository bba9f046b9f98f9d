// --plot KIND=FILE: pictures and their files.
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

/// Reads every --plot. Faults: no KIND=FILE; a KIND not in `kinds` (with the nearest one); an
/// extension other than .svg, .png or .pdf.
std::vector<Plot> read_plots(const std::vector<std::string>& typed,
                             const std::vector<std::string>& kinds, Faults& faults);

/// The files that they name, for resolve_drive().
std::vector<FileUse> files_of(const std::vector<Plot>& plots);

bool has_kind(const std::vector<Plot>& plots, const std::string& kind);

/// Adds the repeatable option. `kinds` describes what each kind draws.
Option* add_plot_option(Command& command, std::vector<std::string>& typed,
                        const std::string& kinds);

}  // namespace gearlash::cli
