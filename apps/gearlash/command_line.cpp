#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/lists.hpp"
#include "input/section_reader.hpp"
#include "input/units.hpp"
#include "output/columns.hpp"

namespace gearlash::cli {
namespace {

constexpr std::size_t help_column = 30;
constexpr std::size_t widest_help = 73;

std::string in_help_column(const std::string& help) {
  std::string text = wrapped(help, widest_help);
  text.pop_back();  // the last newline
  return text;
}

std::vector<std::string> names_of_subcommands(const CLI::App& app) {
  return of_each(app.get_subcommands([](const CLI::App*) { return true; }),
                 [](const CLI::App* command) { return command->get_name(); });
}

/// Throws InvalidInput unless `words` begins with a subcommand of `app`. `typed`: the words before.
void require_known_subcommand(const CLI::App& app, const std::string& typed,
                              const std::vector<std::string>& words) {
  const std::vector<std::string> names = names_of_subcommands(app);
  if (names.empty()) return;
  const std::string first = words.empty() ? "" : words.front();
  if (first.starts_with("-")) return;  // an option, which CLI11 checks
  if (!contains(names, first)) {
    throw InvalidInput({{"subcommand", first.empty() ? "" : shown(first),
                         "must be " + alternatives(names) + guess_of(names, first) + "; see " +
                             typed + " --help"}});
  }
  require_known_subcommand(*app.get_subcommand(first), typed + " " + first,
                           {words.begin() + 1, words.end()});
}

/// CLI11's message on one line, with a pointer to --help.
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error) {
  std::string name = app.get_name();
  for (auto chosen = app.get_subcommands(); !chosen.empty();
       chosen = chosen.front()->get_subcommands()) {
    name += " " + chosen.front()->get_name();
  }
  std::string fault = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {  // CLI11 reverses them
    fault = "not expected:";
    for (const std::string& word : app.remaining(true)) fault += " " + word;
  }
  return shown(fault, 300) + "; see " + name + " --help";
}

}  // namespace

void Option::excludes(Option other) const { option_->excludes(other.option_); }

void Option::needs(Option other) const { option_->needs(other.option_); }

Command::Command(const std::string& name, const std::string& description,
                 const std::string& version_text)
    : app_(std::make_shared<CLI::App>(description, name)) {
  app_->set_version_flag("--version", version_text);
  app_->get_formatter()->column_width(help_column);
  require_subcommand();
}

Command Command::add_subcommand(const std::string& name, const std::string& description) const {
  // Shares ownership of the tool's App, and points at the subcommand's.
  return Command(std::shared_ptr<CLI::App>(app_, app_->add_subcommand(name, description)));
}

template <class Value>
Option Command::add_option(const std::string& name, Value& value, const std::string& help,
                           const OptionRules& rules) const {
  const std::size_t end = std::min(name.find(' '), name.size());
  CLI::Option* option = app_->add_option(name.substr(0, end), value, in_help_column(help));
  option->type_name(end < name.size() ? name.substr(end + 1) : "");
  if (!rules.group.empty()) option->group(rules.group);
  option->required(rules.is_required);
  if (rules.delimiter != '\0') option->delimiter(rules.delimiter);
  if (rules.takes_one_word) option->allow_extra_args(false);
  return Option(option);
}

using Words = std::vector<std::string>;
using OptionalWord = std::optional<std::string>;
template Option Command::add_option(const std::string& name, std::string& value,
                                    const std::string& help, const OptionRules& rules) const;
template Option Command::add_option(const std::string& name, OptionalWord& value,
                                    const std::string& help, const OptionRules& rules) const;
template Option Command::add_option(const std::string& name, Words& value, const std::string& help,
                                    const OptionRules& rules) const;

Option Command::add_flag(const std::string& name, bool& value, const std::string& help) const {
  return Option(app_->add_flag(name, value, in_help_column(help)));
}

std::vector<Option> Command::options() const {
  std::vector<Option> all;
  for (CLI::Option* option : app_->get_options()) {
    if (option != app_->get_help_ptr()) all.emplace_back(option);
  }
  return all;
}

void Command::footer(const std::string& text) const { app_->footer(text); }

void Command::callback(std::function<void()> done) const { app_->callback(std::move(done)); }

void Command::require_subcommand() const { app_->require_subcommand(1); }

std::optional<Command::Message> Command::parse(std::vector<std::string> words) const {
  if (!words.empty() && words.front() == "help") {  // help VERB is VERB --help
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  require_known_subcommand(*app_, app_->get_name(), words);
  try {
    std::reverse(words.begin(), words.end());  // CLI11 takes them in reverse
    app_->parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    return Message{app_->help()};
  } catch (const CLI::CallForVersion& version_text) {
    return Message{std::string(version_text.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    return Message{usage_fault(*app_, error), true};
  }
  return std::nullopt;
}

std::optional<double> bytes_of(const std::string& size) {
  std::string bytes = size;
  try {
    constexpr bool kb_is_1000 = true;
    if (!CLI::AsSizeValue(kb_is_1000)(bytes).empty()) return std::nullopt;
  } catch (const CLI::Error&) {
    return std::nullopt;
  }
  return std::stod(bytes);
}

}  // namespace gearlash::cli
