#include "input/utf8.hpp"

#include <array>

namespace gearlash {
namespace {

/// By the length of a sequence: what its first byte looks like and the least it may encode.
struct SequenceForm {
  unsigned mask;
  unsigned lead;
  char32_t smallest;
};
constexpr std::array<SequenceForm, 4> forms{
    {{0x80, 0x00, 0x0}, {0xE0, 0xC0, 0x80}, {0xF0, 0xE0, 0x800}, {0xF8, 0xF0, 0x10000}}};

bool is_scalar_value(char32_t code_point) {
  return code_point <= 0x10FFFF && !(code_point >= 0xD800 && code_point <= 0xDFFF);
}

}  // namespace

std::optional<char32_t> take_code_point(std::string_view& text) {
  for (std::size_t length = 1; length <= forms.size() && length <= text.size(); ++length) {
    const SequenceForm& form = forms[length - 1];
    const unsigned first = static_cast<unsigned char>(text[0]);
    if ((first & form.mask) != form.lead) continue;
    char32_t code_point = first & ~form.mask;
    for (std::size_t i = 1; i < length; ++i) {
      const unsigned next = static_cast<unsigned char>(text[i]);
      if ((next & 0xC0U) != 0x80U) return std::nullopt;
      code_point = (code_point << 6U) | (next & 0x3FU);
    }
    if (code_point < form.smallest || !is_scalar_value(code_point)) return std::nullopt;
    text.remove_prefix(length);
    return code_point;
  }
  return std::nullopt;
}

}  // namespace gearlash
