// What the verbs share: registration, limits, pictures, the printed answer and the exit status.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "command_line.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "picture/gnuplot.hpp"
#include "servo_options.hpp"
#include "work.hpp"

namespace gearlash::cli {

/// Exit statuses, as --help lists them.
enum class ExitStatus {
  done = 0,
  undecided = 1,    ///< or stopped by a limit; the results so far are printed
  bad_input = 2,    ///< one line per fault
  beyond_means = 3  ///< of the machine: output, memory, threads, the plotter
};

/// Set by the verb that was parsed; runs it. Throws InvalidInput, OutputError or ReaderGone.
using Action = std::function<ExitStatus(const Provenance&)>;

// ---- registration -------------------------------------------------------------------------------

/// Adds a verb to the tool or to another verb. Its action is put into `action`.
using AddVerb = void(const Command& app, Action& action);
AddVerb add_limit_cycle_command, add_simulate_command, add_design_command, add_tune_command,
    add_tolerance_command, add_compare_command, add_describe_command, add_motor_command,
    add_chart_command, add_map_command, add_sweep_command, add_show_command, add_explore_command,
    add_thesis_command;

/// A verb and what is typed after it.
template <class Options>
struct Verb {
  Command command;
  Options& options;
};

/// Adds a verb whose action is `run(options, provenance)`, with the footer at the end of its help.
/// The type of the options chooses among the functions `run` of all verbs.
template <class Options>
using Run = ExitStatus (*)(const Options& options, const Provenance& provenance);
template <class Options>
Verb<Options> add_verb(const Command& app, Action& action, const std::string& name,
                       const std::string& description, const std::string& footer,
                       std::type_identity_t<Run<Options>> run) {
  const auto options = std::make_shared<Options>();
  const Command command = app.add_subcommand(name, description);
  command.footer(footer);
  command.callback([options, &action, run] {
    action = [options, run](const Provenance& provenance) { return run(*options, provenance); };
  });
  return {command, *options};
}

/// The end of every --help.
std::string help_footer(const std::string& examples);

/// The command of these words, the tool's name left out, as it could be typed into a shell, always
/// on one line.
std::string typed_command(const std::vector<std::string>& words);

/// --format text|json.
void add_format_option(const Command& command, std::string& format);

// ---- limits -------------------------------------------------------------------------------------

/// --time-limit and --memory-limit as typed, of every verb whose work may take more than two
/// seconds; empty where not given.
struct LimitOptions {
  std::string time;
  std::string memory;
};

void add_limit_options(const Command& command, LimitOptions& options);
Limits read_limits(const LimitOptions& options, Faults& faults);

/// Ends the work once its answer is printed. If it was stopped, reports by what, and what is
/// therefore `unknown`; the status is then 1. After a signal the program ends here.
ExitStatus end_work(LimitedWork& work, ExitStatus status, const std::string& unknown);

/// As typed, of a verb that answers a question about a drive.
struct QuestionOptions {
  ServoOptions servo{};
  std::string format = "text";
  std::vector<std::string> plots{};
  LimitOptions limits{};
};

// ---- pictures -----------------------------------------------------------------------------------

/// A picture of --plot KIND=FILE, or of --output.
struct PlotFile {
  std::string kind{};
  std::string file{};
  PictureFormat format = PictureFormat::svg;
};

/// Adds the repeatable option. `kinds` describes what each kind draws.
Option add_plot_option(const Command& command, std::vector<std::string>& typed,
                       const std::string& kinds);

/// Reads every --plot. Faults: no KIND=FILE; a KIND not in `kinds` (with the nearest one); an
/// extension other than .svg, .png or .pdf.
std::vector<PlotFile> read_plots(const std::vector<std::string>& typed,
                                 const std::vector<std::string>& kinds, Faults& faults);
/// A picture with such an extension; a fault of `field` otherwise.
PlotFile read_picture(const char* field, const std::string& file, Faults& faults);

/// The files that they name, for resolve_drive().
std::vector<FileUse> files_of(const std::vector<PlotFile>& plots);

bool has_kind(const std::vector<PlotFile>& plots, const std::string& kind);

/// Draws the plot into the file. Throws OutputError.
void write_plot(const PlotFile& file, const Plot& plot);
/// Throws OutputError: the work was stopped before what the picture shows was known.
[[noreturn]] void refuse_to_draw(const PlotFile& file);

// ---- the answer ---------------------------------------------------------------------------------

/// Each line of `lines` on standard error, after the name of the program.
void report_lines(const std::string& lines);

/// Runs `work`. Returns false where the machine refused it output, a plotter,
/// memory or a thread, and reports it by report_lines(). Other exceptions pass.
bool is_within_means(const std::function<void()>& work);

/// The answer, then pictures and files beside it. A failure is reported at once, and does not
/// withhold the others.
class Extras {
 public:
  /// On standard output.
  void print(const std::string& answer);
  void make(const std::function<void()>& work);
  /// `answer`, unless an extra has failed.
  ExitStatus status(ExitStatus answer) const { return failure_.value_or(answer); }

 private:
  std::optional<ExitStatus> failure_;
};

/// What a verb knows when its work ends.
struct Answered {
  std::string text{};      ///< on standard output
  std::string remark{};    ///< on standard error; usually empty
  bool is_decided = true;  ///< else the status is 1
  std::string unknown{};   ///< if the work was stopped: what a stop leaves open
};

/// Prints the answer, ends the work, and makes what is beside the answer.
ExitStatus give(const Answered& answered, LimitedWork& work,
                const std::function<void(Extras& extras)>& make_others);
/// The same with what `plot_of` draws into each picture's file.
ExitStatus give(const Answered& answered, LimitedWork& work, const std::vector<PlotFile>& plots,
                const std::function<Plot(const PlotFile& file)>& plot_of);

}  // namespace gearlash::cli
