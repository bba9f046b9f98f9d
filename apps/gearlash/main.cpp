// gearlash: will a geared servo with backlash hunt, how big and how fast?
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "command.hpp"
#include "gearlash/version.hpp"
#include "input/section_reader.hpp"
#include "input/units.hpp"
#include "machine_faults.hpp"
#include "output/output_file.hpp"

namespace gearlash::cli {
namespace {

constexpr char description[] =
    "Tells whether a geared servo with backlash will limit-cycle (hunt), how big and how fast.\n";

constexpr char examples[] =
    "  gearlash limit-cycle examples/elinco-fd162.toml --plot hunting.svg\n"
    "  gearlash simulate examples/elinco-fd162.toml --plot time=step.svg > step.csv\n"
    "  gearlash motor examples/elinco-fd162.toml\n"
    "  gearlash map --x friction-ratio=0:1:100 --y damping=0.02:0.8:100 --inertia-ratio 2 \\\n"
    "      --output map.svg\n"
    "  gearlash help limit-cycle\n";

extern "C" void remove_outputs_and_die(int signal_number) {
  remove_unfinished_outputs();
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

void install_signal_handlers() {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    // nohup has SIGHUP ignored, a shell's background job SIGINT: that stays.
    if (std::signal(signal_number, remove_outputs_and_die) == SIG_IGN) {
      std::signal(signal_number, SIG_IGN);
    }
  }
  // A closed pipe and a file grown too large are then seen where they are written to.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

std::string names_of_subcommands(const CLI::App& app) {
  std::string names;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (i > 0) names += i + 1 == commands.size() ? " or " : ", ";
    names += commands[i]->get_name();
  }
  return names;
}

/// What was typed where a subcommand of `app`, itself typed as `typed`, belongs.
void require_subcommand(const CLI::App& app, const std::string& typed,
                        const std::vector<std::string>& arguments) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  if (commands.empty()) return;
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first.starts_with("-")) return;  // an option: CLI11 knows it or says that it does not
  const auto known = std::find_if(commands.begin(), commands.end(), [&](const CLI::App* command) {
    return command->get_name() == first;
  });
  if (known == commands.end()) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    throw InvalidInput({{"subcommand", first.empty() ? "" : shown(first),
                         "must be " + names_of_subcommands(app) + guess_of(names, first) +
                             "; see " + typed + " --help",
                         ""}});
  }
  require_subcommand(**known, typed + " " + first, {arguments.begin() + 1, arguments.end()});
}

/// CLI11's own words, on one line, and where to find what is permitted.
ExitStatus report_usage(const CLI::App& app, const CLI::ParseError& error) {
  std::string name = "gearlash";
  for (auto chosen = app.get_subcommands(); !chosen.empty();
       chosen = chosen.front()->get_subcommands()) {
    name += " " + chosen.front()->get_name();
  }
  std::string fault = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {  // CLI11 turns their order round
    fault = "not expected:";
    for (const std::string& word : app.remaining(true)) fault += " " + word;
  }
  report_lines(shown(fault, 300) + "; see " + name + " --help");
  return ExitStatus::bad_input;
}

ExitStatus parse_and_run(int argument_count, char** arguments) {
  CLI::App app(description, "gearlash");
  Action action;
  app.set_version_flag("--version", std::string("gearlash ") + version);
  app.require_subcommand(1);
  app.footer(help_footer(examples));
  app.get_formatter()->column_width(30);
  add_limit_cycle_command(app, action);
  add_simulate_command(app, action);
  add_design_command(app, action);
  add_tolerance_command(app, action);
  add_compare_command(app, action);
  add_describe_command(app, action);
  add_motor_command(app, action);
  add_chart_command(app, action);
  add_map_command(app, action);
  add_sweep_command(app, action);
  add_show_command(app, action);
  add_thesis_command(app, action);
  std::vector<std::string> words(arguments + std::min(argument_count, 1),
                                 arguments + argument_count);
  if (!words.empty() && words.front() == "help") {  // help VERB is VERB --help
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  require_subcommand(app, "gearlash", words);
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    write_file("-", app.help());
    return ExitStatus::done;
  } catch (const CLI::CallForVersion& version_text) {
    write_file("-", std::string(version_text.what()) + "\n");
    return ExitStatus::done;
  } catch (const CLI::ParseError& error) {
    return report_usage(app, error);
  }
  return action({typed_command(argument_count, arguments), version});
}

ExitStatus guarded(int argument_count, char** arguments) {
  ExitStatus status = ExitStatus::beyond_means;
  try {
    is_within_means([&] { status = parse_and_run(argument_count, arguments); });
  } catch (const ReaderGone&) {
    status = ExitStatus::done;
  } catch (const InvalidInput& error) {
    report_lines(error.what());
    status = ExitStatus::bad_input;
  } catch (const std::exception& error) {
    report_lines(std::string("a fault in gearlash itself, please report it: ") + error.what());
  }
  return status;
}

}  // namespace
}  // namespace gearlash::cli

int main(int argument_count, char** arguments) {
  gearlash::cli::install_signal_handlers();
  const auto status = static_cast<int>(gearlash::cli::guarded(argument_count, arguments));
  // Once a write has failed, HDF5 (1.10.8), which NetCDF writes with, crashes when the program
  // ends.
  if (status != 0) std::_Exit(status);
  return status;
}
