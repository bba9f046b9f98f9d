// Reading the table of a reference or of a load torque.
#pragma once

#include <filesystem>

#include "gearlash/signal.hpp"
#include "model/dimension.hpp"

namespace gearlash {

/// A CSV file of two columns, times and `values`, whose first row names them with their units;
/// lines that begin with # are remarks. Throws InvalidInput with one fault, of "file" where the
/// file cannot be read.
TableSignal read_signal_table(const std::filesystem::path& path, const Dimension& values);

}  // namespace gearlash
