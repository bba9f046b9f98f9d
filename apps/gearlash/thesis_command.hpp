// The subcommands of gearlash thesis.
#pragma once

#include "command.hpp"

namespace gearlash::cli {

void add_thesis_table_2(Command& thesis, Action& action);
void add_thesis_machine(Command& thesis, Action& action);
void add_thesis_run(Command& thesis, Action& action);
void add_thesis_figure(Command& thesis, Action& action);
void add_thesis_chart_reading(Command& thesis, Action& action);
void add_thesis_extension(Command& thesis, Action& action);
void add_thesis_all(Command& thesis, Action& action);

}  // namespace gearlash::cli
