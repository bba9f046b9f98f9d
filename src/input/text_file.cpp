#include <cerrno>
#include <fstream>
#include <iostream>
#include <system_error>

#include "gearlash/input.hpp"
#include "gearlash/units.hpp"

namespace gearlash {
namespace {

[[noreturn]] void refuse_file(const std::filesystem::path& path, const std::string& problem) {
  throw InvalidInput({{"file", shown(path.string(), std::string_view::npos),
                       "must be a readable file (" + problem + ")"}});
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, std::size_t largest) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse_file(path, "it is a directory");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse_file(path, std::generic_category().message(errno));
  std::string text(largest + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) refuse_file(path, std::generic_category().message(errno));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest) {
    throw InvalidInput({{"file", shown(path.string(), std::string_view::npos),
                         "must be at most " + std::to_string(largest) + " bytes long"}});
  }
  return text;
}

std::string read_standard_input(std::size_t largest) {
  std::string text(largest + 1, '\0');
  std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::cin.gcount()));
  return text;
}

}  // namespace gearlash
