// The kinds of files that pictures are written to.
#pragma once

#include <filesystem>
#include <string>

namespace gearlash {

enum class PictureFormat { svg, png, pdf };

/// By the ending of the file's name, .svg, .png or .pdf in small or capital letters. Throws
/// InvalidInput, with `field` at fault, for any other.
PictureFormat picture_format(const std::string& field, const std::filesystem::path& path);

}  // namespace gearlash
