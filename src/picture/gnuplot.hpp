// Drawing any plot through gnuplot, in the format of a file's name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "gearlash/picture.hpp"

namespace gearlash {

inline constexpr std::string_view picture_endings[] = {".svg", ".png", ".pdf"};

/// The extension of a file's name in small letters: ".svg".
std::string ending_of(const std::filesystem::path& path);

/// The format by the file name's ending: .svg, .png or .pdf, in small or capital letters. Throws
/// InvalidInput, naming `field`, for any other.
PictureFormat picture_format(const std::string& field, const std::filesystem::path& path);

/// The commands that draw the plot.
std::string gnuplot_script(const Plot& plot, PictureFormat format);

/// The picture that gnuplot writes to standard output for `script`. The time of day is removed, so
/// that the same script gives the same bytes. `title` becomes the SVG's title, which browser tabs
/// and screen readers show. Script and messages go through nameless files in the folder for
/// temporary files (TMPDIR, else /tmp). Nothing is left behind, however the program ends. The
/// user's settings (~/.gnuplot, GNUTERM, locale) have no influence. Throws OutputError if gnuplot
/// is missing (naming the package), fails, or draws an incomplete SVG, PDF or PNG.
std::string run_gnuplot(const std::string& script, const std::string& title);

}  // namespace gearlash
