// A TOML text with the places of its values, checked for input that the parser mishandles.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/fault.hpp"

namespace gearlash {

/// Line and column, from 1; the column counts characters.
using Place = toml::source_position;

class TomlDocument {
 public:
  /// Parses `text`, which must outlive the document. Throws InvalidInput with one fault for a text
  /// that is longer than `largest` bytes, holds NUL or is not UTF-8, nests too deep, is not TOML,
  /// or has a number that no double holds.
  TomlDocument(std::string_view text, std::string_view source_name, std::size_t largest);

  const toml::table& root() const { return root_; }
  /// The value of the key `path`, "section.key"; nullptr if there is none.
  const toml::node* value_at(std::string_view path) const;

  /// Sets the key `path`, "section.key", to a value that has no place in the text: it was read from
  /// `written`.
  void set(std::string_view path, const toml::node& value, std::string_view written);
  /// Removes the key, and its section if that is then empty. Returns whether the key was there.
  bool remove(std::string_view path);
  void remove_section(std::string_view name) { root_.erase(name); }

  /// "servo.toml:3:11"; "--set" for values from set().
  std::string where(Place place) const;

  /// A value as its author wrote it: the characters of a string, the source text of any other
  /// value; fit for one line.
  std::string written(const toml::node& node) const;

  /// Whether a value has a number, in its lists, tables and texts, that may be another one than its
  /// double stands for: has_long_decimal().
  bool is_long(const toml::node& node) const;
  /// The same of the values of a section.
  bool has_long_decimals(std::string_view section) const;
  /// The same of one key, "section.key", also if it was set.
  bool has_long_decimal_at(std::string_view path) const;

  /// The text of a number that has a place in the text, without underscores.
  std::string number_text(const toml::node& node) const;

 private:
  void require_doubles(const toml::node& node) const;
  std::string_view source_of(const toml::node& node) const;
  std::string_view line(std::size_t number) const;
  /// The characters of a line from column `begin` to before `end`.
  std::string_view columns(std::size_t number, std::size_t begin, std::size_t end) const;

  std::string source_name_;
  std::vector<std::string_view> lines_;
  std::vector<std::vector<std::size_t>> character_places_;  ///< of each line
  toml::table root_;
  std::set<std::string, std::less<>> long_settings_;  ///< paths that set() gave long decimals
};

/// Reads a TOML list such as "[1, 2.5]"; nothing for any other text.
std::optional<toml::array> list_in(std::string_view text);
/// The same for a table: "{ value = \"2 mrad\", tolerance = \"10 %\" }".
std::optional<toml::table> table_in(std::string_view text);

}  // namespace gearlash
