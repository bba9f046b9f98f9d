#include "input/toleranced_value.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/lists.hpp"
#include "input/section_reader.hpp"

namespace gearlash {
namespace {

/// The texts on either side of "±".
struct Halves {
  std::string nominal;
  std::string tolerance;
};

std::optional<Halves> halves_of(const toml::node& value) {
  const std::optional<std::string> text = value.value_exact<std::string>();
  if (!text) return std::nullopt;
  for (const std::string_view sign : {"±", "+/-", "+-"}) {
    const std::size_t place = text->find(sign);
    if (place == std::string::npos) continue;
    const std::string_view whole = *text;
    return Halves{std::string(trimmed(whole.substr(0, place))),
                  std::string(trimmed(whole.substr(place + sign.size())))};
  }
  return std::nullopt;
}

class TolerancedReader {
 public:
  TolerancedReader(std::string field, const ExactReader& read_exact)
      : field_(std::move(field)), read_exact_(read_exact) {}

  TolerancedValue read(const toml::node& value) const {
    if (const auto halves = halves_of(value)) return read_halves(*halves);
    if (const toml::table* table = value.as_table()) return read_table(*table);
    return {.nominal = read_exact_(field_, value), .distribution = std::nullopt};
  }

 private:
  Measured exact(const std::string& text) const {
    return read_exact_(field_, toml::value<std::string>(text));
  }

  TolerancedValue read_halves(const Halves& halves) const {
    std::string nominal_text = halves.nominal;
    if (!is_percent(halves.tolerance) && bare_number(nominal_text)) {
      nominal_text += " " + unit_of(halves.tolerance);  // "0.61 ± 0.05 oz in2"
    }
    const Measured nominal = exact(nominal_text);
    return {nominal, UniformAbout{nominal.si, spread(halves.tolerance, nominal.si)}};
  }

  static bool is_percent(const std::string& text) { return text.ends_with('%'); }

  static std::string unit_of(const std::string& text) {
    const std::size_t end =
        text.find_first_of(" \tabcdfghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    return end == std::string::npos ? "" : std::string(trimmed(std::string_view(text).substr(end)));
  }

  /// The tolerance in SI, given as a share of the nominal value or as a value.
  double spread(const std::string& text, double nominal) const {
    if (!is_percent(text)) return not_negative(text, exact(text).si);
    constexpr double percent = 0.01;
    const double share =
        percent * read_number(field_, trimmed(std::string_view(text).substr(0, text.size() - 1)));
    return not_negative(text, share) * std::abs(nominal);
  }

  double spread(const toml::node& node, double nominal) const {
    if (const auto text = node.value_exact<std::string>()) return spread(*text, nominal);
    return not_negative("", read_exact_(field_, node).si);
  }

  double not_negative(const std::string& text, double spread) const {
    if (spread >= 0.0) return spread;
    refuse(field_, text, "must not have a tolerance below zero");
  }

  TolerancedValue read_table(const toml::table& table) const {
    require_keys(table, {"value", "tolerance", "normal", "min", "max", "lots"});
    if (const toml::node* lots = table.get("lots")) return read_lots(*lots, table);
    const auto limit = [&](const char* key) -> std::optional<double> {
      const toml::node* node = table.get(key);
      return node == nullptr ? std::nullopt : std::optional(read_exact_(field_, *node).si);
    };
    const std::optional<double> min = limit("min");
    const std::optional<double> max = limit("max");
    const toml::node* value = table.get("value");
    const toml::node* normal = table.get("normal");
    const toml::node* tolerance = table.get("tolerance");
    const bool is_between = normal == nullptr && tolerance == nullptr && min && max;
    if (is_between && value == nullptr) {
      Measured middle = read_exact_(field_, *table.get("min"));
      middle.si = 0.5 * (*min + *max);
      return {middle, UniformBetween{*min, *max}};
    }
    if (value == nullptr) refuse(field_, "", forms());
    const Measured nominal = read_exact_(field_, *value);
    if (is_between) return {nominal, UniformBetween{*min, *max}};
    if (normal != nullptr && tolerance == nullptr) {
      return {nominal, Normal{nominal.si, spread(*normal, nominal.si), min, max}};
    }
    if (tolerance != nullptr && normal == nullptr && !min && !max) {
      return {nominal, UniformAbout{nominal.si, spread(*tolerance, nominal.si)}};
    }
    refuse(field_, "", forms());
  }

  TolerancedValue read_lots(const toml::node& node, const toml::table& table) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->empty() || table.size() > 1) refuse(field_, "", forms());
    DiscreteLots lots;
    std::vector<Measured> values;
    for (const toml::node& element : *array) {
      double weight = 1.0;
      const toml::node* value = &element;
      if (const toml::table* lot = element.as_table()) {
        require_keys(*lot, {"value", "weight"});
        value = lot->get("value");
        if (value == nullptr) refuse(field_, "", "must have a value in each of its lots");
        weight = lot->get("weight") == nullptr ? 1.0 : lot->get("weight")->value_or(std::nan(""));
      }
      values.push_back(read_exact_(field_, *value));
      lots.lots.push_back({values.back().si, weight});
    }
    const auto heaviest = std::max_element(lots.lots.begin(), lots.lots.end(), by(&Lot::weight));
    return {values[static_cast<std::size_t>(heaviest - lots.lots.begin())], lots};
  }

  void require_keys(const toml::table& table, const std::vector<std::string>& known) const {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (contains(known, name)) continue;
      refuse(field_, name, "must not have this key: " + one_of(known, name));
    }
  }

  static std::string forms() {
    return "must be { value, tolerance }, { value, normal } (with min and max if samples are "
           "sorted), { min, max } or { lots = [...] }";
  }

  std::string field_;
  const ExactReader& read_exact_;
};

}  // namespace

TolerancedValue read_toleranced(const std::string& field, const toml::node& value,
                                const ExactReader& read_exact) {
  return TolerancedReader(field, read_exact).read(value);
}

}  // namespace gearlash
