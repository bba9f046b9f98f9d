// Reading a whole text file of bounded size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace gearlash {

/// The file's contents. Throws InvalidInput for a file that is missing, unreadable, a directory, or
/// longer than `largest` bytes. Reading stops at that length, because the file may be an endless
/// device.
std::string read_text_file(const std::filesystem::path& path, std::size_t largest);

/// read_text_file() of standard input.
std::string read_standard_input(std::size_t largest);

}  // namespace gearlash
