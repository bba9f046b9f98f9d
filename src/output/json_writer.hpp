// Writes values as JSON: structs by the members that output/record.hpp knows.
#pragma once

#include <complex>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "gearlash/drive.hpp"
#include "gearlash/output.hpp"
#include "output/record.hpp"

namespace gearlash {

/// A number that reads back exactly: infinity is "inf" or "-inf", NaN (not computed) null.
std::string json_text(double value);
/// In quotes; null for empty text.
std::string json_text(std::string_view text);

/// The value of a parameter: a number in SI, a word or the name of a file, a list, rows; or none.
using ParameterValue = std::variant<std::monostate, double, std::string, std::vector<double>,
                                    std::vector<std::vector<double>>>;
/// Values by names, an object in JSON.
template <class Value>
using ByName = std::vector<std::pair<std::string, Value>>;

/// Every parameter of the drive by its path, in the order of files; nothing for one that is not
/// given and has no default.
ByName<ParameterValue> parameter_values(const Drive& drive);
/// The paths of the parameters with default values.
std::vector<std::string> defaults_taken(const Drive& drive);

/// "CoulombFriction" is "coulomb friction".
std::string name_in_words(std::string_view name);

/// Numbers by json_text(), enumerations by their words, structs as objects of their members and of
/// what they compute, variants of structs with their "kind", drives by parameter_values(), rows as
/// {"columns": […], "rows": [[…], …]}. What is empty is null.
class JsonWriter {
 public:
  enum class Layout : bool { lines, compact };

  /// `sink` must outlive it. `points`: where the points of curves go, x and y by turns, if not into
  /// the text, which then has their place: {"at": 0, "count": 12}.
  explicit JsonWriter(const TextSink& sink, Layout layout = Layout::lines,
                      std::vector<double>* points = nullptr)
      : sink_(sink), is_compact_(layout == Layout::compact), points_(points) {}

  template <class Type>
  void value(const Type& value) {
    using namespace records;
    if constexpr (std::is_same_v<Type, double>) {
      sink_(json_text(value));
    } else if constexpr (std::is_same_v<Type, bool>) {
      sink_(value ? "true" : "false");
    } else if constexpr (std::is_integral_v<Type>) {
      sink_(std::to_string(value));
    } else if constexpr (std::is_convertible_v<const Type&, std::string_view>) {
      sink_(json_text(std::string_view(value)));
    } else if constexpr (IsWord<Type>) {
      sink_(json_text(std::string_view(Words<Type>::named(value))));
    } else if constexpr (std::is_same_v<Type, std::monostate>) {
      sink_("null");
    } else if constexpr (std::is_same_v<Type, std::complex<double>>) {
      object([&] {
        member("real", value.real());
        member("imaginary", value.imag());
      });
    } else if constexpr (std::is_same_v<Type, Drive>) {
      this->value(parameter_values(value));
    } else if constexpr (IsRecord<Type>) {
      object([&] { members(value); });
    } else if constexpr (is_a<Type, std::optional>) {
      value ? this->value(*value) : sink_("null");
    } else if constexpr (is_a<Type, std::variant>) {
      std::visit([&](const auto& held) { alternative(held); }, value);
    } else if constexpr (is_a<Type, RowsOf>) {
      rows(value);
    } else if constexpr (IsCurve<Type>) {
      points_ != nullptr ? place_of(value) : list(value);
    } else {
      list(value);
    }
  }

  template <class Type>
  void member(std::string_view name, const Type& value) {
    next_line();
    sink_(json_text(name));
    sink_(is_compact_ ? ":" : ": ");
    this->value(value);
  }

  /// The members of a struct, within object().
  template <class Struct>
  void members(const Struct& value) {
    const auto write_one = [&](const auto& one) {
      if constexpr (records::is_a<std::remove_cvref_t<decltype(one)>, records::Opened>) {
        members(std::invoke(one.place, value));
      } else {
        member(one.name, std::invoke(one.place, value));
      }
    };
    const auto write = [&](const auto&... one) { (write_one(one), ...); };
    std::apply(write, records::Record<Struct>::members);
    std::apply(write, records::Record<Struct>::computed);
  }

  template <class Contents>
  void object(const Contents& contents) {
    in_lines('{', '}', contents);
  }

 private:
  template <class Type>
  static constexpr bool is_short =
      std::is_arithmetic_v<Type> || records::IsWord<Type> || records::is_a<Type, std::optional> ||
      records::is_a<Type, std::variant>;

  template <class Contents>
  void in_lines(char first, char last, const Contents& contents) {
    sink_(std::string_view(&first, 1));
    const bool was_empty = std::exchange(is_empty_, true);
    ++depth_;
    contents();
    --depth_;
    if (!is_empty_) indent();
    is_empty_ = was_empty;
    sink_(std::string_view(&last, 1));
  }

  void next_line() {
    if (!is_empty_) sink_(",");
    is_empty_ = false;
    indent();
  }

  void indent() {
    if (!is_compact_) sink_("\n" + std::string(2 * depth_, ' '));
  }

  template <class Held>
  void alternative(const Held& held) {
    if constexpr (records::IsRecord<Held>) {
      object([&] {
        member("kind", name_in_words(records::Record<Held>::name));
        members(held);
      });
    } else {
      value(held);
    }
  }

  /// Numbers and enumerators stand in one line.
  template <class List>
  void list(const List& list) {
    using Element = std::remove_cvref_t<typename List::value_type>;
    if constexpr (requires(Element element) { std::string_view(element.first); }) {
      object([&] {
        for (const auto& [name, of] : list) member(name, of);
      });
    } else if constexpr (is_short<Element>) {
      sink_("[");
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (i > 0) sink_(is_compact_ ? "," : ", ");
        value(Element(list[i]));
      }
      sink_("]");
    } else {
      in_lines('[', ']', [&] {
        for (const Element& element : list) {
          next_line();
          value(element);
        }
      });
    }
  }

  template <class Curve>
  void place_of(const Curve& curve) {
    object([&] {
      member("at", points_->size());
      for (const auto& point : curve) points_->insert(points_->end(), {point.x, point.y});
      member("count", 2 * curve.size());
    });
  }

  template <class Row>
  void rows(const RowsOf<Row>& rows) {
    object([&] {
      std::vector<std::string> columns;
      records::for_each_leaf(Row{}, [&](const auto& member, const char* holder, const auto&) {
        columns.push_back(leaf_name(member, holder));
      });
      member("columns", columns);
      next_line();
      sink_("\"rows\": ");
      in_lines('[', ']', [&] { rows.each([&](const Row& row) { this->row(row); }); });
    });
  }

  template <class Row>
  void row(const Row& row) {
    next_line();
    const char* separator = "[";
    records::for_each_leaf(row, [&](const auto&, const char*, const auto& value) {
      sink_(separator);
      this->value(value);
      separator = ", ";
    });
    sink_("]");
  }

  const TextSink& sink_;
  bool is_compact_;
  std::vector<double>* points_;
  std::size_t depth_ = 0;
  bool is_empty_ = true;  ///< nothing stands yet within the innermost bracket
};

template <class Document>
concept HasDrive = requires(const Document& document) {
  { document.drive } -> std::convertible_to<const Drive&>;
};

/// The JSON of a document with the name of its schema, and the defaults of its drive. Ends with a
/// newline.
template <records::IsDocument Document>
void write_document(const Document& document, const TextSink& sink) {
  JsonWriter writer(sink);
  writer.object([&] {
    writer.member("schema", records::Record<Document>::document);
    writer.member("units", "SI");
    writer.members(document);
    if constexpr (HasDrive<Document>) {
      writer.member("defaults", defaults_taken(document.drive));
    }
  });
  sink("\n");
}

/// In one line; `points` as of JsonWriter.
template <class Type>
std::string json_of(const Type& value, std::vector<double>* points = nullptr) {
  std::string text;
  const TextSink sink = [&](std::string_view part) { text += part; };
  JsonWriter(sink, JsonWriter::Layout::compact, points).value(value);
  return text;
}

template <records::IsDocument Document>
std::string document_text(const Document& document) {
  std::string text;
  write_document(document, [&](std::string_view part) { text += part; });
  return text;
}

}  // namespace gearlash
