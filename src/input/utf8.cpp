#include "input/utf8.hpp"

#include <utf8/checked.h>

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

}  // namespace gearlash
