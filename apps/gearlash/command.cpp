#include "command.hpp"

#include <algorithm>
#include <string_view>

#include "input/units.hpp"

namespace gearlash::cli {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-_./=,:+@%").find(c) != std::string_view::npos;
}

std::string shell_quoted(const std::string& argument) {
  if (!argument.empty() && std::all_of(argument.begin(), argument.end(), is_plain)) {
    return argument;
  }
  // Control characters are escaped by shown(): the command stays on its line, in a CSV file too.
  std::string quoted = "'";
  for (const char c : argument.empty() ? argument : shown(argument, std::string_view::npos)) {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

}  // namespace

std::string help_footer(const std::string& examples) {
  return "Examples:\n" + examples +
         "\nExit status:\n"
         "  0  done, whether the servo hunts or not\n"
         "  1  undecided, or stopped by a limit; what is known has been printed\n"
         "  2  bad input, one line a fault\n"
         "  3  the machine could not: output, memory, threads or gnuplot; the answer\n"
         "     is printed all the same where there is one\n"
         "  130, 143  ended by Ctrl-C, by SIGTERM";
}

std::string typed_command(int argument_count, const char* const* arguments) {
  std::string command = "gearlash";
  for (int i = 1; i < argument_count; ++i) command += " " + shell_quoted(arguments[i]);
  return command;
}

}  // namespace gearlash::cli
