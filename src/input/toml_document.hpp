// A TOML text with the places of its values, guarded against what the parser should not see.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"

namespace gearlash {

/// Line and column, from 1; the column counts characters.
using Place = toml::source_position;

class TomlDocument {
 public:
  /// Parses `text`, which must outlive the document. Throws InvalidInput with one fault for a
  /// text that is longer than `largest` bytes, holds NUL or is not UTF-8, nests too deep, or is not
  /// TOML.
  TomlDocument(std::string_view text, std::string_view source_name, std::size_t largest);

  const toml::table& root() const { return root_; }

  /// Gives the key `path`, "section.key", another value, which stands nowhere in the text.
  void set(std::string_view path, const toml::node& value);
  /// Takes the key out of its section, and a section that is then empty; whether it was there.
  bool remove(std::string_view path);
  void remove_section(std::string_view name) { root_.erase(name); }

  /// "servo.toml:3:11"; "--set" for what set() has given.
  std::string where(Place place) const;

  /// A value as its author wrote it: the characters of a string, the source text of anything else;
  /// fit for one line.
  std::string written(const toml::node& node) const;

 private:
  std::string_view line(std::size_t number) const;

  std::string source_name_;
  std::vector<std::string_view> lines_;
  toml::table root_;
};

/// The list that a text is in TOML, "[1, 2.5]"; nothing where it is none.
std::optional<toml::array> list_in(std::string_view text);

}  // namespace gearlash
