// Runs gnuplot on a script, without a shell and without a file that has a name.
#pragma once

#include <string>

namespace gearlash {

/// What gnuplot writes to its standard output when it runs `script`. Script, picture and messages
/// go through files that are unlinked from the start, so that nothing is left behind however the
/// program ends. The user's own settings (~/.gnuplot, GNUTERM, locale) have no influence.
/// Throws OutputError where gnuplot is missing (naming the package), fails or draws nothing.
std::string run_gnuplot(const std::string& script);

}  // namespace gearlash
