// Reading a reference or a load torque.
#pragma once

#include <filesystem>

#include "input/section_reader.hpp"
#include "model/signal.hpp"

namespace gearlash {

/// From a section with a kind and its keys; a table's file is beside the text, in `folder`. Of kind
/// "ramp" and "trapezoid" are references only.
drive::Signal read_reference(SectionReader& section, const std::filesystem::path& folder);
drive::Signal read_load_torque(SectionReader& section, const std::filesystem::path& folder);

}  // namespace gearlash
