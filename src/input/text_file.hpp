// Reading a whole text file of bounded size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace gearlash {

/// What the file holds. Throws InvalidInput for a file that is missing, unreadable, a directory, or
/// longer than `largest` bytes, of which no more is read than that: it may be an endless device.
std::string read_text_file(const std::filesystem::path& path, std::size_t largest);

/// The same of standard input.
std::string read_standard_input(std::size_t largest);

}  // namespace gearlash
