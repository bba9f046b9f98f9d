// gearlash: does a geared servo with backlash hunt, and what must change?
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "gearlash/output.hpp"
#include "gearlash/version.hpp"
#include "verb.hpp"

namespace gearlash::cli {
namespace {

constexpr char description[] =
    "Report whether a geared servo with backlash hunts (limit-cycles), with which amplitude and "
    "frequency, and what must change to stop it.\n";

constexpr char examples[] =
    "  gearlash limit-cycle examples/robot-joint.toml --brief\n"
    "  gearlash limit-cycle examples/robot-joint.toml --specification \"10 arcmin\"\n"
    "  gearlash simulate examples/robot-joint.toml --plot time=step.svg > step.csv\n"
    "  gearlash design examples/robot-joint.toml --target no-hunting --time-limit \"30 s\"\n"
    "  gearlash chart examples/robot-joint.toml --x gearbox.backlash=0.5deg:4deg:8 --output "
    "chart.svg\n"
    "  gearlash help limit-cycle\n";

struct VerbGroup {
  const char* heading;
  std::vector<AddVerb*> verbs;
};

const VerbGroup verb_groups[] = {
    {"Ask what a drive does",
     {add_limit_cycle_command, add_simulate_command, add_describe_command, add_compare_command}},
    {"Find what to change", {add_design_command, add_tune_command, add_tolerance_command}},
    {"Draw and tabulate",
     {add_map_command, add_chart_command, add_sweep_command, add_explore_command}},
    {"Show the numbers of a drive", {add_show_command, add_motor_command}},
    {"The thesis of 1960", {add_thesis_command}}};

extern "C" void remove_outputs_and_die(int signal_number) {
  remove_unfinished_outputs();
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
}

/// Libraries have destructors and functions that must not throw and allocate nevertheless
/// (nlohmann's JSON): the program ends there, and not by a signal.
[[noreturn]] void end_without_memory() noexcept {
  remove_unfinished_outputs();
  const char* message = "gearlash: a fault in gearlash itself, please report it: std::terminate\n";
  try {
    if (const std::exception_ptr raised = std::current_exception()) std::rethrow_exception(raised);
  } catch (const std::bad_alloc&) {
    message = "gearlash: not enough memory\n";
  } catch (...) {
  }
  std::fputs(message, stderr);
  std::_Exit(static_cast<int>(ExitStatus::beyond_means));
}

void install_signal_handlers() {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    // nohup ignores SIGHUP, and a background job of a shell SIGINT. Both stay ignored.
    if (std::signal(signal_number, remove_outputs_and_die) == SIG_IGN) {
      std::signal(signal_number, SIG_IGN);
    }
  }
  // Writing then reports a closed pipe and a file that has grown too large.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

ExitStatus parse_and_run(int argument_count, char** arguments) {
  Command app("gearlash", description, std::string("gearlash ") + version);
  Action action;
  app.footer(help_footer(examples));
  for (const VerbGroup& group : verb_groups) {
    app.begin_group(group.heading);
    for (AddVerb* add : group.verbs) add(app, action);
  }
  const std::vector<std::string> words(arguments + std::min(argument_count, 1),
                                       arguments + argument_count);
  const auto message = app.parse(words);
  if (message && message->is_fault) {
    report_lines(message->text);
    return ExitStatus::bad_input;
  }
  if (message) {
    constexpr std::size_t usual_columns_of_help = 103;
    write_file("-", fitted(message->text, columns_of_output().value_or(usual_columns_of_help)));
    return ExitStatus::done;
  }
  return action({typed_command(words), version});
}

ExitStatus guarded(int argument_count, char** arguments) {
  ExitStatus status = ExitStatus::beyond_means;
  try {
    const auto work = [&] { status = parse_and_run(argument_count, arguments); };
    is_within_means(std::ref(work));  // allocates nothing outside of the guard
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
  std::set_terminate(gearlash::cli::end_without_memory);
  gearlash::cli::install_signal_handlers();
  return static_cast<int>(gearlash::cli::guarded(argument_count, arguments));
}
