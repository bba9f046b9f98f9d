// Running gnuplot on a script without a shell and without named files.
#pragma once

#include <string>

namespace gearlash {

/// The picture that gnuplot writes to standard output for `script`. The time of day is removed, so
/// that the same script gives the same bytes. `title` becomes the SVG's title, which browser tabs
/// and screen readers show. Script, picture and messages go through nameless files in the folder
/// for temporary files (TMPDIR, else /tmp). Nothing is left behind, however the program ends. The
/// user's settings (~/.gnuplot, GNUTERM, locale) have no influence. Throws OutputError if gnuplot
/// is missing (naming the package), fails, or draws an incomplete SVG, PDF or PNG.
std::string run_gnuplot(const std::string& script, const std::string& title);

}  // namespace gearlash
