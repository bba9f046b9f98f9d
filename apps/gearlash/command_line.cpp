#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "gearlash/units.hpp"

namespace gearlash::cli {
namespace {

constexpr std::size_t help_column = 30;

std::vector<const CLI::App*> subcommands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Throws InvalidInput unless `words` begins with a subcommand of `app`. `typed`: the words before.
void require_known_subcommand(const CLI::App& app, const std::string& typed,
                              const std::vector<std::string>& words) {
  const std::vector<std::string> names =
      of_each(subcommands_of(app), [](const CLI::App* command) { return command->get_name(); });
  if (names.empty()) return;
  const std::string first = words.empty() ? "" : words.front();
  if (first == "-h" || app.get_option_no_throw(first) != nullptr) return;  // --help, --version
  if (!contains(names, first)) {
    const std::string order = first.starts_with("-") ? " before the options" : "";
    const std::string of_file = first.ends_with(".toml")
                                    ? ", as in " + typed + " " + names.front() + " " + shown(first)
                                    : "";
    throw InvalidInput({{"verb", first.empty() ? "" : shown(first),
                         "must be " + alternatives(names) + order + of_file +
                             guess_of(names, first) + "; see " + typed + " --help"}});
  }
  require_known_subcommand(*app.get_subcommand(first), typed + " " + first,
                           {words.begin() + 1, words.end()});
}

/// CLI11's help of options without lists of those that exclude one another.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const bool is_list = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    const std::string type = option->get_type_size() == 0 ? "" : option->get_type_name();
    return (type.empty() ? "" : " " + type) + (is_list ? " ..." : "") +
           (option->get_required() ? " REQUIRED" : "");
  }
};

// ---- usage faults -------------------------------------------------------------------------------

/// The verb that was parsed, with the words before it: "gearlash thesis run".
struct Chosen {
  const CLI::App* app = nullptr;
  std::string name;
};

Chosen chosen_verb(const CLI::App& app) {
  Chosen chosen{&app, app.get_name()};
  for (auto next = app.get_subcommands(); !next.empty(); next = next.front()->get_subcommands()) {
    chosen = {next.front(), chosen.name + " " + next.front()->get_name()};
  }
  return chosen;
}

/// "--target TARGET", or "DRIVE.toml".
std::string name_with_value(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return option.get_name() + (type.empty() || option.get_positional() ? "" : " " + type);
}

/// The verbs below `app` that have the option.
std::vector<std::string> verbs_with(const CLI::App& app, const std::string& option) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : subcommands_of(app)) {
    if (verb->get_option_no_throw(option) != nullptr) verbs.push_back(verb->get_name());
    for (const std::string& below : verbs_with(*verb, option)) {
      verbs.push_back(verb->get_name() + " " + below);
    }
  }
  return verbs;
}

std::string unknown_option(const CLI::App& app, const CLI::App& verb, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const std::vector<std::string> others = verbs_with(app, name);
  std::vector<std::string> known;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->nonpositional()) known.push_back(option->get_name());
  }
  return shown(name) + ": " + verb.get_name() + " has no such option" +
         (others.empty() ? guess_of(known, name) : "; it belongs to " + listed(others));
}

/// A line for each word that no option takes.
std::vector<std::string> unexpected_words(const CLI::App& app, const CLI::App& verb) {
  std::vector<std::string> words = app.remaining(true);
  const auto is_option = [](const std::string& word) {
    return word.size() > 1 && word[0] == '-' &&
           std::isdigit(static_cast<unsigned char>(word[1])) == 0;
  };
  const bool has_options = any_of(words, is_option);
  if (has_options) std::erase_if(words, [&](const auto& word) { return !is_option(word); });
  const std::vector<const CLI::Option*> taken =
      verb.get_options([](const CLI::Option* option) { return option->get_positional(); });
  const std::string what = taken.empty() ? "no further word" : "one " + taken.front()->get_name();
  return of_each<std::string>(words, [&](const std::string& word) {
    return has_options ? unknown_option(app, verb, word)
                       : shown(word) + ": one word too many: " + verb.get_name() + " takes " +
                             what + "; a value with blanks needs quotes";
  });
}

/// A line for each option that is missing, or is given too often.
std::vector<std::string> wrong_counts(const CLI::App& verb) {
  std::vector<std::string> lines;
  for (const CLI::Option* option : verb.get_options()) {
    const std::vector<std::string>& given = option->results();
    if (option->get_required() && given.empty()) {
      lines.push_back(option->get_name() + " is missing: must be given" +
                      (option->get_positional() ? "" : " as " + name_with_value(*option)));
    } else if (given.size() > static_cast<std::size_t>(option->get_items_expected_max())) {
      lines.push_back(option->get_name() + " = " + shown(listed(given)) + ": must be given once" +
                      (option->get_name() == "--target" ? "; join conditions with \"and\"" : ""));
    }
  }
  return lines;
}

/// "a REQUIRES b": the names beside the word of CLI11's message; else two empty ones.
std::pair<std::string, std::string> names_beside(const std::string& message,
                                                 const std::string& word) {
  const std::size_t at = message.find(word);
  if (at == std::string::npos) return {};
  return {message.substr(0, at), message.substr(at + word.size())};
}

/// CLI11's message in the words of this tool; usually one line.
std::vector<std::string> usage_faults(const CLI::App& app, const CLI::App& verb,
                                      const CLI::ParseError& error) {
  std::vector<std::string> lines = unexpected_words(app, verb);
  add_all(lines, wrong_counts(verb));
  const std::string message = error.what();
  if (const auto [name, other] = names_beside(message, " requires "); !name.empty()) {
    return {name + " must come with " + other};
  }
  if (const auto [name, other] = names_beside(message, " excludes "); !name.empty()) {
    return {name + " and " + other + " must not be given together"};
  }
  const auto [name, rest] = names_beside(message, ":");
  const CLI::Option* option = verb.get_option_no_throw(name);
  if (option != nullptr && option->results().empty()) {
    return {name + " has no value: must be " + name_with_value(*option)};
  }
  if (lines.empty()) lines.push_back(shown(message, 300));
  return lines;
}

}  // namespace

void Option::excludes(Option other) const { option_->excludes(other.option_); }

void Option::needs(Option other) const { option_->needs(other.option_); }

Command::Command(const std::string& name, const std::string& description,
                 const std::string& version_text)
    : app_(std::make_shared<CLI::App>(description, name)) {
  app_->set_version_flag("--version", version_text);
  app_->formatter(std::make_shared<HelpFormatter>());
  app_->get_formatter()->column_width(help_column);
  app_->get_formatter()->label("Positionals", "Files and words");
  app_->get_formatter()->label("SUBCOMMAND", "VERB");
  require_subcommand();
}

void Command::begin_group(const std::string& heading) const { app_->group(heading); }

Command Command::add_subcommand(const std::string& name, const std::string& description) const {
  // Shares ownership of the tool's App, and points at the subcommand's.
  return Command(std::shared_ptr<CLI::App>(app_, app_->add_subcommand(name, description)));
}

template <class Value>
Option Command::add_option(const std::string& name, Value& value, const std::string& help,
                           const OptionRules& rules) const {
  const std::size_t end = std::min(name.find(' '), name.size());
  CLI::Option* option = app_->add_option(name.substr(0, end), value, help);
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
  return Option(app_->add_flag(name, value, help));
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
    const auto [verb, name] = chosen_verb(*app_);
    const std::string see = "; see " + name + " --help";
    return Message{listed(usage_faults(*app_, *verb, error), std::identity(), see + "\n") + see,
                   true};
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
