// Drawing any plot through gnuplot, in the format of a file's name.
#pragma once

#include <filesystem>
#include <string>

#include "picture/plot.hpp"

namespace gearlash {

enum class PictureFormat { svg, png, pdf };
inline constexpr std::string_view picture_endings[] = {".svg", ".png", ".pdf"};

/// The extension of a file's name in small letters: ".svg".
std::string ending_of(const std::filesystem::path& path);

/// The format by the file name's ending: .svg, .png or .pdf, in small or capital letters. Throws
/// InvalidInput, naming `field`, for any other.
PictureFormat picture_format(const std::string& field, const std::filesystem::path& path);

/// Returns the bytes of the picture; the same plot gives the same SVG. Throws OutputError if
/// gnuplot is missing or fails.
std::string draw(const Plot& plot, PictureFormat format);

}  // namespace gearlash
