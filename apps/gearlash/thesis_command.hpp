// The subcommands of gearlash thesis.
#pragma once

#include "verb.hpp"

namespace gearlash::cli {

void add_thesis_table_2(const Command& thesis, Action& action);
void add_thesis_machine(const Command& thesis, Action& action);
void add_thesis_run(const Command& thesis, Action& action);
void add_thesis_figure(const Command& thesis, Action& action);
void add_thesis_chart_reading(const Command& thesis, Action& action);
void add_thesis_extension(const Command& thesis, Action& action);
void add_thesis_all(const Command& thesis, Action& action);

/// resolve_drive(), with the backlash of the charts if none is given.
std::optional<WrittenDrive> resolve_charted_drive(ServoOptions typed, Faults& faults);

}  // namespace gearlash::cli
