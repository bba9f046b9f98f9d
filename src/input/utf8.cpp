#include "input/utf8.hpp"

#include <utf8/checked.h>

#include <iterator>

namespace gearlash {

std::optional<char32_t> take_code_point(std::string_view& text) {
  const char* at = text.data();
  try {
    const char32_t code_point = utf8::next(at, text.data() + text.size());
    text.remove_prefix(static_cast<std::size_t>(at - text.data()));
    return code_point;
  } catch (const utf8::exception&) {
    return std::nullopt;
  }
}

std::string as_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::string_view before = text;
    if (take_code_point(text)) {
      result += before.substr(0, before.size() - text.size());
    } else {
      utf8::append(static_cast<unsigned char>(text[0]), std::back_inserter(result));
      text.remove_prefix(1);
    }
  }
  return result;
}

}  // namespace gearlash
