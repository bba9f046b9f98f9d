// Runs gnuplot on a script, without a shell and without a file that has a name.
#pragma once

#include <string>

namespace gearlash {

/// The picture that gnuplot writes to its standard output when it runs `script`, without the time
/// of day: the same script gives the same bytes. An SVG is named `title`, as tabs of browsers and
/// screen readers show it. The picture comes through a pipe, script and
/// messages go through files without a name in the folder for temporary files (TMPDIR, else /tmp),
/// so that nothing is left behind however the program ends. The user's own settings (~/.gnuplot,
/// GNUTERM, locale) have no influence. Throws OutputError where gnuplot is missing (naming the
/// package), fails, or draws no whole SVG, PDF or PNG.
std::string run_gnuplot(const std::string& script, const std::string& title);

}  // namespace gearlash
