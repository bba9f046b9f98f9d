// Reading the table of a reference or of a load torque.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "gearlash/signal.hpp"
#include "gearlash/units.hpp"

namespace gearlash {

/// Parses CSV with two columns, times and `values`. The first row names the columns with their
/// units; lines that begin with # are remarks. Throws InvalidInput with one fault, located by line
/// in `name`.
TableSignal parse_signal_table(std::string_view text, const std::string& name,
                               const Dimension& values);

/// parse_signal_table() of a file. If the file cannot be read, the fault's field is "file".
TableSignal read_signal_table(const std::filesystem::path& path, const Dimension& values);

}  // namespace gearlash
