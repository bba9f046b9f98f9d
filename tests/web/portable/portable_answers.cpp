// Prints the answers that compare_answers.py compares between builds.
#include "portable_answers.hpp"

#include <cstdio>
#include <string_view>

namespace {

/// False if there is no such part.
bool print_part(std::string_view part) {
  using namespace gearlash::portable;
  if (part == "servos") {
    print_servos();
  } else if (part == "drives") {
    print_drives();
  } else if (part == "irregular") {
    print_irregular();
  } else {
    return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    for (const char* part : {"servos", "drives", "irregular"}) print_part(part);
    return 0;
  }
  for (int i = 1; i < argc; ++i) {
    if (!print_part(argv[i])) {
      std::fputs("usage: portable_answers [servos] [drives] [irregular]\n", stderr);
      return 2;
    }
  }
  return 0;
}
