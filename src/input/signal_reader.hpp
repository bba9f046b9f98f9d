// Reading the table of a reference or of a load torque.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "gearlash/signal.hpp"
#include "model/dimension.hpp"

namespace gearlash {

/// CSV of two columns, times and `values`, whose first row names them with their units; lines that
/// begin with # are remarks. Throws InvalidInput with one fault, located in `name` by its line.
TableSignal parse_signal_table(std::string_view text, const std::string& name,
                               const Dimension& values);

/// The same of a file; the fault is of "file" where it cannot be read.
TableSignal read_signal_table(const std::filesystem::path& path, const Dimension& values);

}  // namespace gearlash
