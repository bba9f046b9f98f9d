// gearlash thesis table-2 and machine: the printout of 1960, by the port and by the CDC 1604.
#include <fmt/format.h>

#include "thesis/float_1604.hpp"
#include "thesis/listing.hpp"
#include "thesis/mendings.hpp"
#include "thesis/printout.hpp"
#include "thesis/thesis_machine.hpp"
#include "thesis_command.hpp"

namespace gearlash::cli {
namespace {

using thesis::FloatRules;
using thesis::Number1604;
using thesis::PrintedLine;
using thesis::PrintedNumber;
using thesis::PrintedRow;

// --- table-2 ---

constexpr char table_2_examples[] =
    "  gearlash thesis table-2\n"
    "  gearlash thesis table-2 --arithmetic 1604\n"
    "  gearlash thesis table-2 --properties\n";

struct Table2Options {
  std::string arithmetic = "double";
  bool properties = false;
};

std::vector<PrintedLine> run_listed_program(const std::string& arithmetic) {
  const std::size_t lines = thesis::thesis_table_2().size();
  if (arithmetic == "1604") {
    return thesis::printout<Number1604<FloatRules{}>>(thesis::listed_parameters, lines);
  }
  return thesis::printout<double>(thesis::listed_parameters, lines);
}

std::string row_text(const PrintedRow& row) {
  std::string text;
  for (const PrintedNumber& number : row) text += fmt::format("{:<13}", printed_text(number));
  return text;
}

/// Lines of a printout beside those of Table II.
std::string beside_table_2(const std::vector<PrintedLine>& lines) {
  const std::string heading = fmt::format("{:<13}{:<13}{:<13}{:<13}{:<13}", "TIME", "MOTOR SPEED",
                                          "MOTOR POS.", "LOAD SPEED", "LOAD POS.");
  std::string text = fmt::format("{:<68}{}\n", "now", "1960");
  text += heading + "   " + heading.substr(0, heading.find_last_not_of(' ') + 1) + "\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string row =
        row_text(printed_row(lines[i])) + "   " + row_text(thesis::thesis_table_2()[i]);
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  const thesis::Reproduction result = reproduction_of(lines);
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

/// How many numbers of Table II each property accounts for.
std::string properties_text() {
  std::string text = "Numbers of Table II, out of 190, within one unit of the eighth digit\n\n";
  for (const thesis::NamedMending& one : thesis::mendings()) {
    text += fmt::format("  {:<54}{:>3}\n", one.name, thesis::numbers_reproduced(one.mending));
  }
  return text;
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

/// How many numbers of Table II the port prints exactly under a set of rules.
template <thesis::SumRule sum, thesis::LengthRule product, thesis::LengthRule quotient>
int digits_reproduced() {
  using Number = Number1604<FloatRules{sum, product, quotient}>;
  const std::size_t lines = thesis::thesis_table_2().size();
  return reproduction_of(thesis::printout<Number>(thesis::listed_parameters, lines)).exact;
}

template <thesis::SumRule sum>
std::string rules_rows(const std::string& name) {
  constexpr auto cut = thesis::LengthRule::truncated;
  constexpr auto round = thesis::LengthRule::rounded;
  const auto row = [&](const char* product, const char* quotient, int exact) {
    return fmt::format("  {:<44}{:<12}{:<12}{}\n", name, product, quotient, exact);
  };
  return row("cut off", "cut off", digits_reproduced<sum, cut, cut>()) +
         row("cut off", "rounded", digits_reproduced<sum, cut, round>()) +
         row("rounded", "cut off", digits_reproduced<sum, round, cut>()) +
         row("rounded", "rounded", digits_reproduced<sum, round, round>());
}

std::string rules_text() {
  using thesis::SumRule;
  return "Rounding rules, and how many of the 190 numbers of Table II they reproduce digit for "
         "digit\n"
         "\n" +
         fmt::format("  {:<44}{:<12}{:<12}{}\n", "FAD, FSB", "FMU", "FDV", "numbers") +
         rules_rows<SumRule::no_guard_digits>("smaller operand cut off before the sum") +
         rules_rows<SumRule::exact_truncated>("exact sum, cut off") +
         rules_rows<SumRule::exact_rounded>("exact sum, rounded");
}

std::string listing_text() {
  const auto differences = thesis::differences_of_listing();
  std::string text = fmt::format(
      "Table I: {} words. The symbolic column assembles to the octal column, except for {}:\n",
      thesis::thesis_table_1().octal.size(), differences.size());
  for (const auto& difference : differences) {
    text += fmt::format("  {:05o}  listed     {}\n", difference.address,
                        thesis::octal_text(difference.listed));
    text += fmt::format("         assembled  {}   {}\n", thesis::octal_text(difference.assembled),
                        difference.source);
  }
  return text;
}

/// The first instructions with the registers before each, and the registers after the last.
std::string trace_text(std::uint64_t count) {
  thesis::ThesisMachine thesis;
  std::string text = "   P      instruction         A                 B1 … B6\n";
  const auto registers_text = [](const thesis::Registers& registers) {
    std::string indices;
    for (std::size_t b = 1; b < registers.index.size(); ++b) {
      indices += fmt::format(" {:05o}", registers.index[b]);
    }
    return fmt::format("{:016o} {}", registers.a, indices);
  };
  thesis.machine().set_trace(
      [&](const thesis::Registers& registers, const thesis::Instruction& instruction) {
        text += fmt::format("  {:05o} {}  {:<4} {} {:05o}  {}\n", registers.p,
                            registers.in_lower ? "L" : "U", thesis::mnemonic(instruction.operation),
                            instruction.designator, instruction.operand, registers_text(registers));
      });
  for (std::uint64_t i = 0; i < count; ++i) thesis.machine().step();
  const thesis::Registers& last = thesis.machine().registers();
  return text + fmt::format("  {:05o} {}  {:<12}  {}\n", last.p, last.in_lower ? "L" : "U", "",
                            registers_text(last));
}

std::string machine_text() {
  thesis::ThesisMachine thesis;
  std::vector<PrintedLine> lines;
  while (lines.size() < thesis::thesis_table_2().size()) lines.push_back(thesis.next_line());
  return "Table II: the octal words of Table I on an emulated CDC 1604, beside the printout of "
         "1960\n\n" +
         beside_table_2(lines) +
         fmt::format("{} instructions were executed.\n", thesis.machine().registers().executed);
}

ExitStatus print_table_2(const Table2Options& typed, const Provenance&) {
  Faults faults;
  faults.require_choice("--arithmetic", typed.arithmetic, {"double", "1604"});
  faults.require_none();
  write_file("-", typed.properties
                      ? properties_text()
                      : "Table II: the program of 1960 run again, beside its printout\n\n" +
                            beside_table_2(run_listed_program(typed.arithmetic)));
  return ExitStatus::done;
}

ExitStatus print_of_machine(const MachineOptions& typed, const Provenance&) {
  write_file("-", typed.trace     ? trace_text(read_whole("--trace", *typed.trace, 1, 1'000'000))
                  : typed.rules   ? rules_text()
                  : typed.listing ? listing_text()
                                  : machine_text());
  return ExitStatus::done;
}

}  // namespace

void add_thesis_table_2(const Command& thesis, Action& action) {
  const auto [command, options] = add_verb<Table2Options>(
      thesis, action, "table-2", "Print Table II again, beside the printout of 1960",
      help_footer(table_2_examples), print_table_2);
  const Option arithmetic = command.add_option(
      "--arithmetic KIND", options.arithmetic,
      "Choose the arithmetic: double (default) or 1604, which cuts operands off before "
      "it adds them");
  command
      .add_flag("--properties", options.properties,
                "Show how many of its numbers each property of the program accounts for")
      .excludes(arithmetic);
}

void add_thesis_machine(const Command& thesis, Action& action) {
  const auto [command, options] = add_verb<MachineOptions>(
      thesis, action, "machine", "Run the octal words of Table I on an emulated CDC 1604",
      help_footer(machine_examples), print_of_machine);
  const Option trace = command.add_option("--trace COUNT", options.trace,
                                          "Show the first COUNT instructions instead");
  const Option rules = command.add_flag("--rules", options.rules,
                                        "Show which rounding rules reproduce the digits of 1960");
  const Option listing = command.add_flag(
      "--listing", options.listing, "Show where the listing's symbolic and octal columns differ");
  rules.excludes(trace);
  listing.excludes(trace);
  listing.excludes(rules);
}

}  // namespace gearlash::cli
