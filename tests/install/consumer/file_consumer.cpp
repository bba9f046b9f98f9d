// A project that reads a drive's file.
#include <cstdio>
#include <gearlash/analyse.hpp>
#include <gearlash/input.hpp>

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return std::puts("usage: file_consumer DRIVE.toml"), 2;
  const gearlash::Answer answer = analyse(gearlash::read_drive(arguments[1]));
  std::puts(name_of(answer.verdict));
  return answer.normal_form.has_value() ? 0 : 1;
}
