// The subcommands of gearlash thesis.
#pragma once

#include "command.hpp"

namespace gearlash::cli {

void add_thesis_table_2(CLI::App& thesis, Action& action);
void add_thesis_machine(CLI::App& thesis, Action& action);
void add_thesis_run(CLI::App& thesis, Action& action);
void add_thesis_figure(CLI::App& thesis, Action& action);
void add_thesis_chart_reading(CLI::App& thesis, Action& action);
void add_thesis_extension(CLI::App& thesis, Action& action);
void add_thesis_all(CLI::App& thesis, Action& action);

}  // namespace gearlash::cli
