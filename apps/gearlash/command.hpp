// What the subcommands share: registration, action and exit status.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include "command_line.hpp"
#include "output/report_units.hpp"

namespace gearlash::cli {

/// Exit statuses, as --help lists them.
enum class ExitStatus {
  done = 0,
  undecided = 1,    ///< or stopped by a limit; the results so far are printed
  bad_input = 2,    ///< one line per fault
  beyond_means = 3  ///< of the machine: output, memory, threads, the plotter
};

/// Set by the subcommand that was parsed; runs it. Throws InvalidInput, OutputError or ReaderGone.
using Action = std::function<ExitStatus(const Provenance&)>;

void add_limit_cycle_command(Command& app, Action& action);
void add_simulate_command(Command& app, Action& action);
void add_chart_command(Command& app, Action& action);
void add_map_command(Command& app, Action& action);
void add_sweep_command(Command& app, Action& action);
void add_design_command(Command& app, Action& action);
void add_describe_command(Command& app, Action& action);
void add_motor_command(Command& app, Action& action);
void add_tune_command(Command& app, Action& action);
void add_tolerance_command(Command& app, Action& action);
void add_compare_command(Command& app, Action& action);
void add_show_command(Command& app, Action& action);
void add_explore_command(Command& app, Action& action);
void add_thesis_command(Command& app, Action& action);

/// Makes `run(*options, provenance)` the action of the command, and the footer the end of its help.
/// The type of the options chooses among the functions `run` of all verbs.
template <class Options>
using Run = ExitStatus (*)(const Options& options, const Provenance& provenance);
template <class Options>
void set_action(Command& command, Action& action, const std::shared_ptr<Options>& options,
                const std::string& footer, std::type_identity_t<Run<Options>> run) {
  command.footer(footer);
  command.callback([options, &action, run] {
    action = [options, run](const Provenance& provenance) { return run(*options, provenance); };
  });
}

/// The end of every --help.
std::string help_footer(const std::string& examples);

/// The command as it could be typed into a shell, always on one line.
std::string typed_command(int argument_count, const char* const* arguments);

}  // namespace gearlash::cli
