// Subcommands and options of the command line; CLI11, which reads them, is compiled in one place.
#pragma once

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

/// Beside its name, value and help.
struct OptionRules {
  std::string group{};          ///< the heading under which the help lists it
  bool is_required = false;     ///< must be given
  char delimiter = '\0';        ///< one word may hold several values, separated by this character
  bool takes_one_word = false;  ///< further words after the first are no values of this option
};

/// An option or a positional argument of a command.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// May not be given together with the other one.
  void excludes(Option other) const;
  /// May only be given together with the other one.
  void needs(Option other) const;

 private:
  CLI::Option* option_;
};

/// A command with its options and subcommands. Variables bound to options must outlive parse().
class Command {
 public:
  /// The tool itself: --help, --version, and one of its subcommands.
  Command(const std::string& name, const std::string& description, const std::string& version_text);

  Command add_subcommand(const std::string& name, const std::string& description) const;
  /// The heading under which the help lists the subcommands that are added from now on.
  void begin_group(const std::string& heading) const;
  /// `name`: "--step ANGLE", the option and what the help shows for its value; without leading
  /// dashes it is a positional argument. `value`: a string, an optional one, or a list of them.
  template <class Value>
  Option add_option(const std::string& name, Value& value, const std::string& help,
                    const OptionRules& rules = {}) const;
  Option add_flag(const std::string& name, bool& value, const std::string& help) const;
  /// The options added so far.
  std::vector<Option> options() const;
  /// Text at the end of its help.
  void footer(const std::string& text) const;
  /// Called once this command has been parsed without fault.
  void callback(std::function<void()> done) const;
  /// One of its subcommands must be given.
  void require_subcommand() const;

  /// A text to print instead of running a command.
  struct Message {
    std::string text;
    bool is_fault = false;  ///< a line for each; else the help or the version
  };
  /// Reads the words of a command line, the tool's name left out. Throws InvalidInput where a
  /// subcommand is missing or unknown. The lines of the help are not wrapped.
  std::optional<Message> parse(std::vector<std::string> words) const;

 private:
  explicit Command(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

  std::shared_ptr<CLI::App> app_;  // owned by the tool's
};

/// The bytes of a size such as "200 MB" or "1 GiB"; empty if it is none.
std::optional<double> bytes_of(const std::string& size);

}  // namespace gearlash::cli
