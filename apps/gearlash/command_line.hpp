// Subcommands and options of the command line; CLI11, which reads them, is compiled in one place.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gearlash::cli {

/// An option or a positional argument of a command. Each call returns this option again.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// The heading under which the help lists it.
  Option* group(const std::string& heading);
  Option* required();
  /// One word may hold several values, separated by this character.
  Option* delimiter(char character);
  /// Whether further words after the first are values of this option too.
  Option* allow_extra_args(bool allowed);
  /// May not be given together with the other one.
  Option* excludes(Option* other);
  /// May only be given together with the other one.
  Option* needs(Option* other);

 private:
  CLI::Option* option_;
};

/// A command with its options and subcommands. Variables bound to options must outlive parse().
class Command {
 public:
  /// The tool itself: --help, --version, and one of its subcommands.
  Command(const std::string& name, const std::string& description, const std::string& version_text);

  Command* add_subcommand(const std::string& name, const std::string& description);
  /// `name`: "--step ANGLE", the option and what the help shows for its value; without leading
  /// dashes it is a positional argument. The help is broken into lines.
  Option* add_option(const std::string& name, std::string& value, const std::string& help);
  Option* add_option(const std::string& name, std::optional<std::string>& value,
                     const std::string& help);
  Option* add_option(const std::string& name, std::vector<std::string>& values,
                     const std::string& help);
  Option* add_flag(const std::string& name, bool& value, const std::string& help);
  /// The options added so far.
  std::vector<Option*> options();
  /// Text at the end of its help.
  void footer(const std::string& text);
  /// Called once this command has been parsed without fault.
  void callback(std::function<void()> done);
  /// One of its subcommands must be given.
  void require_subcommand();

  /// A text to print instead of running a command.
  struct Message {
    std::string text;
    bool is_fault = false;  ///< one line; else the help or the version
  };
  /// Reads the words of a command line, the tool's name left out. Throws InvalidInput where a
  /// subcommand is missing or unknown.
  std::optional<Message> parse(std::vector<std::string> words);

 private:
  explicit Command(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}
  template <class Value>
  Option* bind(const std::string& name, Value& value, const std::string& help);

  std::shared_ptr<CLI::App> app_;    // owned by the tool's
  std::deque<Command> subcommands_;  // a deque, so that pointers to elements stay valid
  std::deque<Option> options_;
};

/// The bytes of a size such as "200 MB" or "1 GiB"; empty if it is none.
std::optional<double> bytes_of(const std::string& size);

}  // namespace gearlash::cli
