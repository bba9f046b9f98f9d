#include "output/json_writer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/decimal.hpp"

namespace gearlash {

std::string json_text(double value) {
  if (std::isnan(value)) return "null";
  if (std::isinf(value)) return value > 0.0 ? "\"inf\"" : "\"-inf\"";
  return shortest_text(value);
}

std::string json_text(std::string_view text) {
  if (text.empty()) return "null";
  using Json = nlohmann::json;
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string name_in_words(std::string_view name) {
  std::string words;
  for (const char letter : name) {
    const bool is_capital = letter >= 'A' && letter <= 'Z';
    const bool is_after_small = !words.empty() && words.back() >= 'a' && words.back() <= 'z';
    if (is_capital && is_after_small) words += ' ';
    words += is_capital ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return words;
}

}  // namespace gearlash
