// gearlash thesis: the program of 1960, its printout and its charts, beside the exact answer.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>

#include "command.hpp"
#include "gearlash/cycle/limit_cycle.hpp"
#include "gearlash/heritage/chart_errors.hpp"
#include "gearlash/heritage/chart_reading.hpp"
#include "gearlash/heritage/extensions.hpp"
#include "gearlash/heritage/figures.hpp"
#include "gearlash/heritage/float_1604.hpp"
#include "gearlash/heritage/listing.hpp"
#include "gearlash/heritage/printout.hpp"
#include "gearlash/heritage/settled_cycle.hpp"
#include "gearlash/heritage/thesis_machine.hpp"
#include "gearlash/io/output_file.hpp"
#include "servo_options.hpp"
#include "terminal.hpp"

namespace gearlash::cli {
namespace {

using heritage::FloatRules;
using heritage::Number1604;
using heritage::PrintedLine;
using heritage::PrintedNumber;
using heritage::PrintedRow;

constexpr char examples[] =
    "  gearlash thesis table-2\n"
    "  gearlash thesis machine\n"
    "  gearlash thesis run --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1\n";

// --- table-2 ---

constexpr char table_2_examples[] =
    "  gearlash thesis table-2\n"
    "  gearlash thesis table-2 --arithmetic 1604\n";

std::vector<PrintedLine> run_listed_program(const std::string& arithmetic, std::size_t lines) {
  if (arithmetic == "1604") {
    return heritage::printout<Number1604<FloatRules{}>>(heritage::listed_parameters, lines);
  }
  return heritage::printout<double>(heritage::listed_parameters, lines);
}

std::string row_text(const PrintedRow& row) {
  std::string text;
  for (const PrintedNumber& number : row) text += fmt::format("{:<13}", printed_text(number));
  return text;
}

/// How many numbers have the digits of 1960, and how many are within one of the eighth.
struct Score {
  int exact = 0;
  int within_one = 0;
  std::vector<std::string> others = {};  ///< farther off, in words
  std::vector<std::string> near = {};    ///< off by one, in words
};

void score(const PrintedRow& printed, const PrintedRow& now, std::size_t line, Score& result) {
  constexpr std::array names = {"time", "motor speed", "motor position", "load speed",
                                "load position"};
  for (std::size_t k = 0; k < printed.size(); ++k) {
    const bool same = printed[k] == now[k];
    // 99999999 and 1.0000000 are neighbours though their exponents differ.
    const double value = now[k].digits * std::pow(10.0, now[k].exponent - 8);
    constexpr double one_and_rounding = 1.0 + 1e-6;
    const bool neighbours = std::abs(units_apart(value, printed[k])) <= one_and_rounding;
    result.exact += same ? 1 : 0;
    result.within_one += neighbours ? 1 : 0;
    if (same) continue;
    (neighbours ? result.near : result.others)
        .push_back(fmt::format("line {}, {}: {} here, {} in 1960", line + 1, names[k],
                               printed_text(now[k]), printed_text(printed[k])));
  }
}

/// Lines of a printout beside those of Table II.
std::string beside_table_2(const std::vector<PrintedLine>& lines) {
  const auto& printed = heritage::thesis_table_2();
  const std::string heading = fmt::format("{:<13}{:<13}{:<13}{:<13}{:<13}", "TIME", "MOTOR SPEED",
                                          "MOTOR POS.", "LOAD SPEED", "LOAD POS.");
  std::string text = fmt::format("{:<68}{}\n", "now", "1960");
  text += heading + "   " + heading.substr(0, heading.find_last_not_of(' ') + 1) + "\n";
  Score result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const PrintedRow now = printed_row(lines[i]);
    score(printed[i], now, i, result);
    const std::string row = row_text(now) + "   " + row_text(printed[i]);
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  text += fmt::format(
      "\n{} of 190 numbers have the digits of 1960; {} are within one unit of the eighth digit.\n",
      result.exact, result.within_one);
  for (const std::string& other : result.others) text += other + "\n";
  constexpr std::size_t worth_listing = 5;
  if (result.near.size() <= worth_listing) {
    for (const std::string& other : result.near) text += other + "\n";
  }
  return text;
}

void add_table_2(CLI::App& thesis, Action& action) {
  const auto arithmetic = std::make_shared<std::string>("double");
  CLI::App* command =
      thesis.add_subcommand("table-2", "the typical printout, beside what was printed in 1960");
  command
      ->add_option("--arithmetic", *arithmetic,
                   "double (default), or 1604: the machine's, which cuts\n"
                   "operands off before it adds them")
      ->type_name("KIND");
  command->footer(help_footer(table_2_examples));
  command->callback([arithmetic, &action] {
    action = [arithmetic](const Provenance&) {
      Faults faults;
      faults.require_choice("--arithmetic", *arithmetic, {"double", "1604"});
      faults.require_none();
      const std::size_t lines = heritage::thesis_table_2().size();
      write_file("-", "Table II: the program of 1960 run again, and what it printed then\n\n" +
                          beside_table_2(run_listed_program(*arithmetic, lines)));
      return ExitStatus::done;
    };
  });
}

// --- machine ---

constexpr char machine_examples[] =
    "  gearlash thesis machine\n"
    "  gearlash thesis machine --trace 40\n"
    "  gearlash thesis machine --rules\n"
    "  gearlash thesis machine --listing\n";

struct MachineOptions {
  std::optional<std::string> trace;
  bool rules = false;
  bool listing = false;
};

/// How many numbers of Table II the port prints under each set of rules.
template <heritage::SumRule sum, heritage::LengthRule product, heritage::LengthRule quotient>
int digits_reproduced() {
  const auto& printed = heritage::thesis_table_2();
  const auto lines = heritage::printout<Number1604<FloatRules{sum, product, quotient}>>(
      heritage::listed_parameters, printed.size());
  Score result;
  for (std::size_t i = 0; i < lines.size(); ++i)
    score(printed[i], printed_row(lines[i]), i, result);
  return result.exact;
}

template <heritage::SumRule sum>
std::string rules_rows(const std::string& name) {
  constexpr auto cut = heritage::LengthRule::truncated;
  constexpr auto round = heritage::LengthRule::rounded;
  const auto row = [&](const char* product, const char* quotient, int exact) {
    return fmt::format("  {:<44}{:<12}{:<12}{}\n", name, product, quotient, exact);
  };
  return row("cut off", "cut off", digits_reproduced<sum, cut, cut>()) +
         row("cut off", "rounded", digits_reproduced<sum, cut, round>()) +
         row("rounded", "cut off", digits_reproduced<sum, round, cut>()) +
         row("rounded", "rounded", digits_reproduced<sum, round, round>());
}

std::string rules_text() {
  using heritage::SumRule;
  return "Rules of rounding, and how many of the 190 numbers of Table II they give digit for "
         "digit\n"
         "\n" +
         fmt::format("  {:<44}{:<12}{:<12}{}\n", "FAD, FSB", "FMU", "FDV", "numbers") +
         rules_rows<SumRule::no_guard_digits>("smaller operand cut off before the sum") +
         rules_rows<SumRule::exact_truncated>("exact sum, cut off") +
         rules_rows<SumRule::exact_rounded>("exact sum, rounded");
}

std::string listing_text() {
  const auto differences = heritage::differences_of_listing();
  std::string text = fmt::format(
      "Table I: {} words. Its symbolic column assembles to its octal column but for {}:\n",
      heritage::thesis_table_1().octal.size(), differences.size());
  for (const auto& difference : differences) {
    text += fmt::format("  {:05o}  listed     {}\n", difference.address,
                        heritage::octal_text(difference.listed));
    text += fmt::format("         assembled  {}   {}\n", heritage::octal_text(difference.assembled),
                        difference.source);
  }
  return text;
}

/// The first instructions with the registers before each, and the registers after the last.
std::string trace_text(int count) {
  heritage::ThesisMachine thesis;
  std::string text = "   P      instruction         A                 B1 … B6\n";
  const auto registers_text = [](const heritage::Registers& registers) {
    std::string indices;
    for (std::size_t b = 1; b < registers.index.size(); ++b) {
      indices += fmt::format(" {:05o}", registers.index[b]);
    }
    return fmt::format("{:016o} {}", registers.a, indices);
  };
  thesis.machine().set_trace([&](const heritage::Registers& registers,
                                 const heritage::Instruction& instruction) {
    text += fmt::format("  {:05o} {}  {:<4} {} {:05o}  {}\n", registers.p,
                        registers.in_lower ? "L" : "U", heritage::mnemonic(instruction.operation),
                        instruction.designator, instruction.operand, registers_text(registers));
  });
  for (int i = 0; i < count; ++i) thesis.machine().step();
  const heritage::Registers& last = thesis.machine().registers();
  return text + fmt::format("  {:05o} {}  {:<12}  {}\n", last.p, last.in_lower ? "L" : "U", "",
                            registers_text(last));
}

std::string machine_text() {
  heritage::ThesisMachine thesis;
  std::vector<PrintedLine> lines;
  while (lines.size() < heritage::thesis_table_2().size()) lines.push_back(thesis.next_line());
  return "Table II: the octal words of Table I run by an emulated CDC 1604, and what it printed "
         "in 1960\n\n" +
         beside_table_2(lines) +
         fmt::format("{} instructions were executed.\n", thesis.machine().registers().executed);
}

int trace_count(const std::string& text) {
  constexpr double most = 1e6;
  const double count = read_number("--trace", text);
  if (!(count >= 1.0 && count <= most) || count != std::floor(count)) {
    throw InvalidInput({{"--trace", shown(text), "must be a whole number from 1 to 1000000", ""}});
  }
  return static_cast<int>(count);
}

void add_machine(CLI::App& thesis, Action& action) {
  const auto options = std::make_shared<MachineOptions>();
  CLI::App* command = thesis.add_subcommand(
      "machine", "Table II from the octal words of Table I, by an emulated CDC 1604");
  command->add_option("--trace", options->trace, "show the first COUNT instructions instead")
      ->type_name("COUNT");
  command->add_flag("--rules", options->rules,
                    "show which rules of rounding give the digits of 1960");
  command->add_flag("--listing", options->listing,
                    "show where the listing's symbolic and octal columns differ");
  command->footer(help_footer(machine_examples));
  command->callback([options, &action] {
    action = [options](const Provenance&) {
      if (options->trace) {
        write_file("-", trace_text(trace_count(*options->trace)));
      } else if (options->rules) {
        write_file("-", rules_text());
      } else {
        write_file("-", options->listing ? listing_text() : machine_text());
      }
      return ExitStatus::done;
    };
  });
}

// --- run ---

constexpr char run_examples[] =
    "  gearlash thesis run --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1\n"
    "  gearlash thesis run examples/elinco-fd162.toml\n"
    "  gearlash thesis run --all\n"
    "  gearlash thesis run --all --machine\n";

std::string run_text(const NormalizedServo& servo, const heritage::SettledCycle& cycle) {
  std::string text =
      fmt::format("The program of 1960, {} s of the servo's time in steps of 0.01 s (ω_n = 1):\n",
                  significant(cycle.run_time, 4));
  if (!cycle.hunts) {
    text += "  no limit cycle: the faces meet no more\n";
  } else {
    text += fmt::format("  size    ±{} rad{}\n", significant(cycle.size, 5),
                        cycle.settled ? "" : ", still changing");
    text += fmt::format(
        "          mean of {} cycles, from {} to {}: on the grid none is like the "
        "next\n",
        cycle.cycles, significant(cycle.smallest, 5), significant(cycle.largest, 5));
    text += fmt::format("  period  {} s\n", significant(cycle.period, 5));
  }
  const LimitCycleAnalysis exact = analyse_limit_cycles(servo);
  text += "Exactly:\n";
  if (exact.cycles.empty()) {
    return text + fmt::format("  no limit cycle: {}\n", name_of(exact.verdict));
  }
  const LimitCycle& one = exact.cycles.front();
  text += fmt::format("  size    ±{} rad\n", significant(one.size, 9));
  text += fmt::format("  period  {} s\n", significant(one.period, 9));
  if (cycle.hunts) {
    text += fmt::format("The program's size is off by {:+.2f} %, its period by {:+.2f} %.\n",
                        100.0 * (cycle.size / one.size - 1.0),
                        100.0 * (cycle.period / one.period - 1.0));
  }
  return text;
}

/// Errors of the charts in per cent, a table for each friction ratio.
std::string errors_text(const std::vector<heritage::ChartError>& errors) {
  std::string text =
      "Sizes of the program of 1960 against the exact ones, in per cent\n"
      "(·: neither hunts; then, now: only the program or only the exact servo hunts)\n";
  std::vector<double> sizes;
  const heritage::ChartError* before = nullptr;
  for (const heritage::ChartError& error : errors) {
    const NormalizedServo& servo = error.servo;
    if (before == nullptr || before->servo.friction_ratio != servo.friction_ratio) {
      text += fmt::format("\n\nfriction ratio {:<8}", servo.friction_ratio);
      for (const char* ratio : {"1/9", "1/4", "1", "4", "9"}) text += fmt::format("{:>8}", ratio);
    }
    if (before == nullptr || before->servo.damping != servo.damping) {
      text += fmt::format("\n  damping {:<13}", servo.damping);
      const bool only_balanced = servo.inertia_ratio == 1.0;  // as in figure 3
      if (only_balanced) text += std::string(16, ' ');
    }
    const auto relative = error.relative();
    if (relative) sizes.push_back(100.0 * *relative);
    text += fmt::format("{:>8}", relative        ? fmt::format("{:+.1f}", sizes.back())
                                 : error.program ? "then"
                                 : error.exact   ? "now"
                                                 : "·");
    before = &error;
  }
  std::sort(sizes.begin(), sizes.end());
  return text + fmt::format(
                    "\n\n{} servos, {} of which hunt in both: median {:+.1f} %, from {:+.1f} "
                    "to {:+.1f} %\n",
                    errors.size(), sizes.size(), sizes[sizes.size() / 2], sizes.front(),
                    sizes.back());
}

/// All of the thesis's charts, by the port or by the emulated machine: what each of them gave, and
/// what it took.
struct AllRuns {
  std::vector<heritage::ChartError> errors;
  std::string effort;  ///< of the emulated machine, a line
};

AllRuns run_all(bool on_machine) {
  Progress progress("Charts");
  const auto show = [&](double share) { progress.show(share); };
  if (!on_machine) return {heritage::chart_errors(&heritage::run_until_settled, show), ""};
  const auto start = std::chrono::steady_clock::now();
  std::size_t instructions = 0;
  const auto errors = heritage::chart_errors(
      [&](const heritage::ProgramParameters& parameters) {
        const heritage::MachineRun run = heritage::run_machine_until_settled(parameters);
        instructions += run.instructions;
        return run.cycle;
      },
      show);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  constexpr double seconds_of_1960 = 180.0;
  return {
      errors,
      fmt::format("{} runs of the emulated machine, {} instructions, {} s; the real one took three "
                  "minutes a run, {} times as long\n",
                  errors.size(), instructions, significant(seconds, 3),
                  std::round(seconds_of_1960 * static_cast<double>(errors.size()) / seconds))};
}

struct RunOptions {
  ServoOptions servo;
  bool all = false;
  bool machine = false;
  std::string plot;
};

ExitStatus run_program(const RunOptions& options) {
  if (options.all) {
    const PictureFormat format =
        options.plot.empty() ? PictureFormat::svg : picture_format("--plot", options.plot);
    const AllRuns runs = run_all(options.machine);
    if (!options.plot.empty()) {
      write_file(options.plot, draw_cell_map(error_map(runs.errors), format));
    }
    write_file("-", errors_text(runs.errors) + runs.effort);
    return ExitStatus::done;
  }
  ServoOptions typed = options.servo;
  if (typed.file.empty() && !typed.backlash) typed.backlash = "0.3";  // of the charts
  Faults faults;
  const ServoFile file = resolve_servo(typed, faults);
  faults.require_none();
  const auto parameters = heritage::program_parameters(file.servo);
  const heritage::SettledCycle cycle = options.machine
                                           ? heritage::run_machine_until_settled(parameters).cycle
                                           : heritage::run_until_settled(parameters);
  write_file("-", run_text(file.servo, cycle));
  return cycle.settled ? ExitStatus::done : ExitStatus::undecided;
}

void add_run(CLI::App& thesis, Action& action) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = thesis.add_subcommand(
      "run", "the size that the program of 1960 finds for any servo, beside the exact one");
  add_servo_options(*command, options->servo);
  command->add_flag("--all", options->all,
                    "all servos of the thesis's charts, as a table of errors");
  command
      ->add_option("--plot", options->plot,
                   "with --all, draw the errors as a map; FILE ends in\n.svg, .png or .pdf")
      ->type_name("FILE");
  command->add_flag("--machine", options->machine,
                    "on the emulated CDC 1604 instead of by the port");
  command->footer(help_footer(run_examples));
  command->callback([options, &action] {
    action = [options](const Provenance&) { return run_program(*options); };
  });
}

// --- figures ---

constexpr char figure_examples[] =
    "  gearlash thesis figure 7\n"
    "  gearlash thesis figure 12 --output phase.pdf\n"
    "  gearlash thesis all --output figures\n";

std::vector<int> figure_numbers() {
  std::vector<int> numbers;
  for (const auto& figure : heritage::thesis_figures()) numbers.push_back(figure.number);
  for (const auto& figure : heritage::thesis_phase_figures()) numbers.push_back(figure.number);
  return numbers;
}

int read_figure_number(const std::string& text) {
  const std::vector<int> numbers = figure_numbers();
  for (const int number : numbers) {
    if (text == std::to_string(number)) return number;
  }
  throw InvalidInput(
      {{"N", shown(text),
        fmt::format("must be the number of a figure, {} to {}", numbers.front(), numbers.back()),
        ""}});
}

/// Works the figure out and draws it; `done` hears how far it is.
std::string draw_figure(int number, PictureFormat format, const std::function<void(double)>& done) {
  for (const auto& figure : heritage::thesis_phase_figures()) {
    if (figure.number == number) return draw_line_chart(chart_of(figure), format);
  }
  const auto& figures = heritage::thesis_figures();
  const auto figure = std::find_if(figures.begin(), figures.end(), [&](const auto& candidate) {
    return candidate.number == number;
  });
  std::vector<heritage::FigureCurveData> data;
  const auto count = static_cast<double>(figure->curves.size());
  for (const auto& curve : figure->curves) {
    const auto before = static_cast<double>(data.size());
    data.push_back(
        heritage::work_out(*figure, curve, [&](double share) { done((before + share) / count); }));
  }
  return draw_line_chart(chart_of(*figure, data), format);
}

void add_figure(CLI::App& thesis, Action& action) {
  struct Options {
    std::string number;
    std::string output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      thesis.add_subcommand("figure", "one of figures 2 to 15, then and exactly, as a picture");
  command->add_option("N", options->number, "number of the figure, 2 to 15")
      ->type_name("")
      ->required();
  command
      ->add_option("--output", options->output,
                   "picture, ending in .svg, .png or .pdf; default\nfigure-N.svg")
      ->type_name("FILE");
  command->footer(help_footer(figure_examples));
  command->callback([options, &action] {
    action = [options](const Provenance&) {
      Faults faults;
      const int number = faults.collect([&] { return read_figure_number(options->number); }, 2);
      const std::string file =
          options->output.empty() ? fmt::format("figure-{}.svg", number) : options->output;
      const PictureFormat format =
          faults.collect([&] { return picture_format("--output", file); }, PictureFormat::svg);
      faults.require_none();
      Progress progress("Figure " + options->number);
      write_file(file, draw_figure(number, format, [&](double share) { progress.show(share); }));
      return ExitStatus::done;
    };
  });
}

void add_all(CLI::App& thesis, Action& action) {
  const auto folder = std::make_shared<std::string>("thesis-figures");
  CLI::App* command = thesis.add_subcommand("all", "all figures into a folder, as SVG");
  command->add_option("--output", *folder, "folder, made if need be; default thesis-figures")
      ->type_name("DIR");
  command->footer(help_footer(figure_examples));
  command->callback([folder, &action] {
    action = [folder](const Provenance&) {
      std::error_code error;
      std::filesystem::create_directories(*folder, error);
      if (error) {
        throw InvalidInput({{"--output", shown(*folder),
                             "must be a folder that can be made (" + error.message() + ")", ""}});
      }
      Progress progress("Figures");
      const std::vector<int> numbers = figure_numbers();
      const auto count = static_cast<double>(numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto done = [&](double share) {
          progress.show((static_cast<double>(i) + share) / count);
        };
        const std::filesystem::path file =
            std::filesystem::path(*folder) / fmt::format("figure-{}.svg", numbers[i]);
        write_file(file.string(), draw_figure(numbers[i], PictureFormat::svg, done));
      }
      return ExitStatus::done;
    };
  });
}

// --- chart-reading ---

constexpr char chart_reading_examples[] =
    "  gearlash thesis chart-reading --damping .19 --inertia-ratio 2 --friction-ratio .1 \\\n"
    "      --backlash .1\n"
    "  gearlash thesis chart-reading examples/elinco-fd162.toml\n";

std::string chart_reading_text(const NormalizedServo& servo,
                               const heritage::ChartReading& reading) {
  std::string text = "Reading the charts of 1960 (Appendix C of the thesis)\n\n";
  text += fmt::format("  1. The variables: damping {}, inertia ratio {}, friction ratio {}\n",
                      significant(servo.damping, 4), significant(servo.inertia_ratio, 4),
                      significant(servo.friction_ratio, 4));
  text += fmt::format("  2. The chart of the nearest friction ratio: figure {}, for {}\n",
                      reading.chart->figure, significant(reading.chart->friction_ratio, 2));
  text += fmt::format(
      "  3. At inertia ratio {} its curve of damping {} is at {}, that of {} at {};\n"
      "     between them at {}: ±{} rad for a backlash of 0.3 rad\n",
      significant(servo.inertia_ratio, 4), reading.neighbours[0], significant(reading.read[0], 3),
      reading.neighbours[1], significant(reading.read[1], 3), significant(servo.damping, 4),
      significant(reading.chart_size, 3));
  text += fmt::format("  4. For this backlash: {} × {}/0.3 = ±{} rad\n",
                      significant(reading.chart_size, 3), significant(servo.backlash, 4),
                      significant(reading.size, 3));
  const LimitCycleAnalysis exact = analyse_limit_cycles(servo);
  if (exact.cycles.empty()) {
    return text + fmt::format("\nExactly: no limit cycle, {}\n", name_of(exact.verdict));
  }
  const double size = exact.cycles.front().size;
  return text + fmt::format("\nExactly: ±{} rad; reading the chart is off by {:+.1f} %\n",
                            significant(size, 6), 100.0 * (reading.size / size - 1.0));
}

void add_chart_reading(CLI::App& thesis, Action& action) {
  const auto options = std::make_shared<ServoOptions>();
  CLI::App* command = thesis.add_subcommand(
      "chart-reading", "the size as one read it off the charts, beside the exact one");
  add_servo_options(*command, *options);
  command->footer(help_footer(chart_reading_examples));
  command->callback([options, &action] {
    action = [options](const Provenance&) {
      if (options->file.empty() && !options->backlash) options->backlash = "0.3";
      Faults faults;
      const ServoFile file = resolve_servo(*options, faults);
      faults.require_none();
      write_file("-", chart_reading_text(file.servo, heritage::read_chart(file.servo)));
      return ExitStatus::done;
    };
  });
}

// --- extensions ---

constexpr char extension_examples[] =
    "  gearlash thesis extension 2\n"
    "  gearlash thesis extension 4 --output restitution.pdf\n";

void add_extension(CLI::App& thesis, Action& action) {
  struct Options {
    std::string number;
    std::string output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = thesis.add_subcommand(
      "extension", "what the thesis recommends to do next, as a chart: 2, 3 or 4");
  command->add_option("N", options->number, "number of the recommendation: 2, 3 or 4")
      ->type_name("")
      ->required();
  command
      ->add_option("--output", options->output,
                   "picture, ending in .svg, .png or .pdf; default\nextension-N.svg")
      ->type_name("FILE");
  command->footer(help_footer(extension_examples));
  command->callback([options, &action] {
    action = [options](const Provenance&) {
      Faults faults;
      if (options->number != "2" && options->number != "3" && options->number != "4") {
        faults.add({"N", shown(options->number),
                    "must be 2, 3 or 4 (recommendation 1 is gearlash thesis run)", ""});
      }
      const std::string file =
          options->output.empty() ? "extension-" + options->number + ".svg" : options->output;
      const PictureFormat format =
          faults.collect([&] { return picture_format("--output", file); }, PictureFormat::svg);
      faults.require_none();
      Progress progress("Extension " + options->number);
      const heritage::Extension extension = heritage::extension(
          std::stoi(options->number), [&](double share) { progress.show(share); });
      write_file(file, draw_line_chart(extension.chart, format));
      write_file("-",
                 fmt::format("{}. {}\n\n{}\n", extension.number, extension.wish, extension.lesson));
      return ExitStatus::done;
    };
  });
}

}  // namespace

void add_thesis_command(CLI::App& app, Action& action) {
  CLI::App* thesis =
      app.add_subcommand("thesis", "the program and the charts of 1960, beside the exact answer");
  thesis->require_subcommand(1);
  thesis->footer(help_footer(examples));
  add_table_2(*thesis, action);
  add_machine(*thesis, action);
  add_run(*thesis, action);
  add_figure(*thesis, action);
  add_chart_reading(*thesis, action);
  add_extension(*thesis, action);
  add_all(*thesis, action);
}

}  // namespace gearlash::cli
