// Reading a whole text file of bounded size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace gearlash {

/// What the file holds, of which no more is read than one byte beyond `largest`: enough to tell
/// that it is exceeded, of however endless a device. Throws InvalidInput for a file that is
/// missing, unreadable or a directory.
std::string read_text_file(const std::filesystem::path& path, std::size_t largest);

/// The same of standard input.
std::string read_standard_input(std::size_t largest);

}  // namespace gearlash
