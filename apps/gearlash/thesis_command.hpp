// The subcommands of gearlash thesis.
#pragma once

#include "verb.hpp"

namespace gearlash::cli {

AddVerb add_thesis_table_2, add_thesis_machine, add_thesis_run, add_thesis_figure,
    add_thesis_chart_reading, add_thesis_extension, add_thesis_all;

/// resolve_drive(), with the backlash of the charts if none is given.
std::optional<WrittenDrive> resolve_charted_drive(ServoOptions typed, Faults& faults);

}  // namespace gearlash::cli
