#include "input/toml_document.hpp"

#include <algorithm>
#include <sstream>

#include "base/lists.hpp"
#include "gearlash/units.hpp"
#include "input/utf8.hpp"

namespace gearlash {
namespace {

/// The bound on the depth of dotted keys. Each dot nests a table, and the tables' destructors
/// recurse until the stack is full. toml++ bounds the nesting of brackets and braces (256), but not
/// of keys.
constexpr int deepest_key = 16;

std::string named_place(const std::string& source_name, Place place) {
  // The parser gives a table without a header the place 0.
  return source_name + ":" + std::to_string(std::max(place.line, 1U)) + ":" +
         std::to_string(std::max(place.column, 1U));
}

[[noreturn]] void refuse_at(const std::string& where, const std::string& field,
                            const std::string& value, const std::string& permitted) {
  throw InvalidInput({{field, value, permitted, where}});
}

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  return text;
}

void require_text(std::string_view text, const std::string& source_name) {
  Place place{1, 1};
  while (!text.empty()) {
    const std::string_view before = text;
    const std::optional<char32_t> c = take_code_point(text);
    if (!c || *c == U'\0') {
      refuse_at(named_place(source_name, place), "file",
                "binary data (" + shown(before.substr(0, 1)) + ")", "must be text in UTF-8");
    }
    place = *c == U'\n' ? Place{place.line + 1, 1} : Place{place.line, place.column + 1};
  }
}

/// The length of the string at the start of `text`, including its opening and closing `quotes`. 0
/// if it does not close; a string must close on its line unless it is a multi-line string. Also 0
/// if toml++ would look for blanks within it (see unparsable_at), which it does behind a backslash
/// in a multi-line string.
std::size_t end_of_string(std::string_view text, std::string_view quotes) {
  const bool multi_line = quotes.size() == 3;
  bool after_backslash = false;
  for (std::size_t at = quotes.size(); at < text.size(); ++at) {
    if (!is_ascii(text[at]) && after_backslash && multi_line) return 0;
    if (text[at] == '\n' && !multi_line) return 0;
    if (text[at] == '\\' && quotes[0] == '"') {
      after_backslash = true;
      if (at + 1 < text.size() && is_ascii(text[at + 1])) ++at;
    } else if (text.substr(at).starts_with(quotes)) {
      at += quotes.size();
      // A multi-line string may end in one or two quotes of its own.
      for (int i = 0; multi_line && i < 2 && text.substr(at).starts_with(quotes[0]); ++i) ++at;
      return at;
    }
  }
  return 0;
}

/// The text with comments and strings blanked out and newlines kept. A string that follows a word
/// without a blank keeps its non-ASCII characters too, because toml++ looks for the end of the word
/// in it.
std::string structure_of(std::string_view text) {
  std::string result(text);
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    std::size_t length = 0;
    if (rest[0] == '#') length = std::min(rest.find('\n'), rest.size());
    for (const std::string_view quotes : {"'", "\"", "'''", "\"\"\""}) {
      if (!rest.starts_with(quotes)) continue;
      length = end_of_string(rest, quotes);
      if (length == 0 && quotes.size() == 3) return result;  // the rest is all string
    }
    const bool stands_alone =
        rest[0] == '#' || at == 0 ||
        std::string_view(" \t\n=[{,").find(text[at - 1]) != std::string_view::npos;
    for (std::size_t i = at; i < at + length; ++i) {
      if (result[i] != '\n' && (stands_alone || is_ascii(result[i]))) result[i] = '_';
    }
    at += std::max<std::size_t>(length, 1);
  }
  return result;
}

/// The column (from 0) of input that toml++ 3.3 mishandles: keys nested too deep, and non-ASCII
/// characters outside strings and comments. TOML permits none there, and toml++'s test for blanks
/// among them reaches code declared unreachable.
std::optional<std::size_t> unparsable_at(std::string_view structure) {
  int dots = 0;
  for (std::size_t at = 0; at < structure.size(); ++at) {
    const char c = structure[at];
    if (c == '.') ++dots;
    if (std::string_view("=[]{},").find(c) != std::string_view::npos) dots = 0;
    if (dots > deepest_key || !is_ascii(c)) return at;
  }
  return std::nullopt;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    begin = end + 1;
  }
  return lines;
}

/// The column, from 1, of the character at `byte`.
toml::source_index column_of(std::string_view line, std::size_t byte) {
  toml::source_index column = 1;
  for (std::string_view rest = line; line.size() - rest.size() < byte && take_code_point(rest);) {
    ++column;
  }
  return column;
}

void require_parsable(std::string_view text, const std::vector<std::string_view>& lines,
                      const std::string& source_name) {
  const std::string structure = structure_of(text);
  const std::vector<std::string_view> structure_lines = split_lines(structure);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::optional<std::size_t> byte = unparsable_at(structure_lines[i]);
    if (!byte) continue;
    const bool ascii = is_ascii(structure_lines[i][*byte]);
    refuse_at(named_place(source_name,
                          {static_cast<toml::source_index>(i + 1), column_of(lines[i], *byte)}),
              "line", shown(lines[i]),
              ascii ? "must not nest keys deeper than section.key"
                    : "must be TOML: characters beyond ASCII must be inside closed quotes");
  }
}

/// Where each character begins, and the end; none in a line of ASCII, where they are its bytes.
std::vector<std::size_t> character_places(std::string_view line) {
  if (all_of(line, is_ascii)) return {};
  std::vector<std::size_t> places;
  std::string_view rest = line;
  do {
    places.push_back(line.size() - rest.size());
  } while (!rest.empty() && take_code_point(rest));
  return places;
}

/// toml++ 3.3 reports a want of memory within a number as an error of the text, which is parsed
/// once more for that.
toml::table parsed(std::string_view text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error&) {
    return toml::parse(text);
  }
}

}  // namespace

TomlDocument::TomlDocument(std::string_view text, std::string_view source_name, std::size_t largest)
    : source_name_(shown(source_name, std::string_view::npos)) {
  if (text.size() > largest) {
    refuse_at(named_place(source_name_, {1, 1}), "file",
              "over " + std::to_string(largest) + " bytes",
              "must be a data sheet of at most " + std::to_string(largest) + " bytes");
  }
  text = without_byte_order_mark(text);
  require_text(text, source_name_);
  lines_ = split_lines(text);
  for (const std::string_view line : lines_) character_places_.push_back(character_places(line));
  require_parsable(text, lines_, source_name_);
  try {
    root_ = parsed(text);
  } catch (const toml::parse_error& error) {
    const Place place = error.source().begin;
    const std::string_view wrong = line(place.line);
    const std::string_view value = wrong.substr(std::min(wrong.rfind('='), wrong.size()));
    const bool is_word_without_quotes =
        value.find_first_of("\"'") == value.npos && any_of(value, is_ascii_letter);
    refuse_at(
        where(place), "line", shown(wrong),
        "must be TOML: " + shown(error.description(), 200) +
            (is_word_without_quotes ? "; a word, or a number with a unit, needs quotes: \"3 kg m2\""
                                    : ""));
  }
  require_doubles(root_);
}

/// The parser takes what is nearer to 0 than any double for 0.
void TomlDocument::require_doubles(const toml::node& node) const {
  if (const toml::table* table = node.as_table()) {
    for (const auto& entry : *table) require_doubles(entry.second);
  } else if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) require_doubles(element);
  } else if (const auto* number = node.as_floating_point(); number && number->get() == 0.0) {
    const std::string_view source = source_of(node);
    const std::string_view digits = source.substr(0, source.find_first_of("eE"));
    if (digits.find_first_of("123456789") == std::string_view::npos) return;
    const Place place = node.source().begin;
    refuse_at(where(place), "line", shown(line(place.line)),
              "must be numbers from 1e-308 to 1e308 in size, or zero");
  }
}

const toml::node* TomlDocument::value_at(std::string_view path) const {
  const std::size_t point = path.find('.');
  const toml::table* table = root_[path.substr(0, point)].as_table();
  return table != nullptr ? table->get(path.substr(point + 1)) : nullptr;
}

void TomlDocument::set(std::string_view path, const toml::node& value, std::string_view written) {
  const std::size_t point = path.find('.');
  if (has_long_decimal(written)) long_settings_.emplace(path);
  const std::string_view section = path.substr(0, point);
  if (!root_[section].is_table()) root_.insert_or_assign(section, toml::table{});
  value.visit([&](const auto& typed) {
    root_[section].as_table()->insert_or_assign(path.substr(point + 1), typed);
  });
}

bool TomlDocument::remove(std::string_view path) {
  const std::size_t point = path.find('.');
  if (const auto place = long_settings_.find(path); place != long_settings_.end()) {
    long_settings_.erase(place);
  }
  toml::table* section = root_[path.substr(0, point)].as_table();
  if (section == nullptr || section->erase(path.substr(point + 1)) == 0) return false;
  if (section->empty()) root_.erase(path.substr(0, point));
  return true;
}

std::string TomlDocument::where(Place place) const {
  return place.line == 0 ? "--set" : named_place(source_name_, place);
}

std::string_view TomlDocument::line(std::size_t number) const {
  return number >= 1 && number <= lines_.size() ? lines_[number - 1] : std::string_view();
}

std::string_view TomlDocument::columns(std::size_t number, std::size_t begin,
                                       std::size_t end) const {
  const std::string_view text = line(number);
  if (text.empty()) return text;
  const std::vector<std::size_t>& places = character_places_[number - 1];
  const auto place = [&](std::size_t column) {
    return places.empty() ? std::min(column - 1, text.size())
                          : places[std::min(column - 1, places.size() - 1)];
  };
  return text.substr(place(begin), place(end) - place(begin));
}

std::string TomlDocument::written(const toml::node& node) const {
  if (const auto* string = node.as_string()) return shown(string->get());
  const toml::source_region& source = node.source();
  if (source.begin.line == 0) {
    std::ostringstream text;
    node.visit([&](const auto& typed) { text << typed; });
    return shown(text.str());
  }
  if (source.begin.line == source.end.line) {
    return shown(columns(source.begin.line, source.begin.column, source.end.column));
  }
  return shown(
      std::string(columns(source.begin.line, source.begin.column, std::string_view::npos)) + " …");
}

std::string_view TomlDocument::source_of(const toml::node& node) const {
  const toml::source_region& source = node.source();
  return columns(source.begin.line, source.begin.column, source.end.column);
}

std::string TomlDocument::number_text(const toml::node& node) const {
  std::string text(source_of(node));
  std::erase(text, '_');
  return text;
}

bool TomlDocument::is_long(const toml::node& node) const {
  if (const toml::table* table = node.as_table()) {
    return any_of(*table, [&](const auto& entry) { return is_long(entry.second); });
  }
  if (const toml::array* array = node.as_array()) {
    return any_of(*array, [&](const toml::node& other) { return is_long(other); });
  }
  if (const auto* text = node.as_string()) return has_long_decimal(text->get());
  return node.is_number() && node.source().begin.line > 0 && has_long_decimal(source_of(node));
}

bool TomlDocument::has_long_decimal_at(std::string_view path) const {
  const toml::node* node = value_at(path);
  return node != nullptr && (is_long(*node) || long_settings_.count(path) > 0);
}

bool TomlDocument::has_long_decimals(std::string_view section) const {
  const toml::table* table = root_[section].as_table();
  return table != nullptr && any_of(*table, [&](const auto& entry) {
           return has_long_decimal_at(std::string(section) + "." + std::string(entry.first.str()));
         });
}

namespace {

template <class Node>
std::optional<Node> node_in(std::string_view text) {
  try {
    const std::string assigned = "value = " + std::string(text);
    const TomlDocument document(assigned, "", assigned.size());
    const Node* node = document.root()["value"].as<Node>();
    if (node != nullptr && document.root().size() == 1) return *node;
  } catch (const InvalidInput&) {  // another one
  }
  return std::nullopt;
}

}  // namespace

std::optional<toml::array> list_in(std::string_view text) { return node_in<toml::array>(text); }

std::optional<toml::table> table_in(std::string_view text) { return node_in<toml::table>(text); }

}  // namespace gearlash
