// --plot KIND=FILE: pictures and their files.
#pragma once

#include <string>
#include <vector>

#include "picture/gnuplot_renderer.hpp"
#include "servo_options.hpp"

namespace gearlash::cli {

struct PlotFile {
  std::string kind;
  std::string file;
  PictureFormat format = PictureFormat::svg;
};

/// Reads every --plot. Faults: no KIND=FILE; a KIND not in `kinds` (with the nearest one); an
/// extension other than .svg, .png or .pdf.
std::vector<PlotFile> read_plots(const std::vector<std::string>& typed,
                                 const std::vector<std::string>& kinds, Faults& faults);

/// The files that they name, for resolve_drive().
std::vector<FileUse> files_of(const std::vector<PlotFile>& plots);

bool has_kind(const std::vector<PlotFile>& plots, const std::string& kind);

/// Draws the plot into the file. Throws OutputError.
void write_plot(const PlotFile& file, const Plot& plot);

/// Adds the repeatable option. `kinds` describes what each kind draws.
Option* add_plot_option(Command& command, std::vector<std::string>& typed,
                        const std::string& kinds);

}  // namespace gearlash::cli
