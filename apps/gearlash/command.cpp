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
  return "Exit status:\n"
         "  0  done, whether the drive hunts or not\n"
         "  1  undecided, or stopped by a limit; the results so far are printed\n"
         "  2  bad input; standard error has one line per fault\n"
         "  3  the machine failed: output, memory, threads or gnuplot; an answer that\n"
         "     exists is still printed\n"
         "  130, 143  ended by Ctrl-C or SIGTERM\n\n"
         "Examples:\n" +
         examples.substr(0, examples.find_last_not_of('\n') + 1);
}

std::string typed_command(int argument_count, const char* const* arguments) {
  std::string command = "gearlash";
  for (int i = 1; i < argument_count; ++i) command += " " + shell_quoted(arguments[i]);
  return command;
}

}  // namespace gearlash::cli
