// The cases that the native and the WebAssembly build must answer alike.
//
// Each case is a line of text on standard output:
//   <kind> <name> <key>=<value> …
// A value is a word, a number as %a, or <number>~<unit>. The unit is the difference that the number
// may have in two builds, but for the factor in compare_answers.py. Numbers without a unit, and
// words, must be equal.
#pragma once

namespace gearlash::portable {

/// 10,000 seeded servos with a closed form, "servo": verdict, growth at rest, and the largest
/// stable cycle.
void print_servos();

/// 50 seeded drives without a closed form, "drive" with a "cycle" for each of their cycles and an
/// "irregular" for each of their irregular motions.
void print_drives();

/// Drives that hunt irregularly, in the lines of drives; and the swings of servos, "swings".
void print_irregular();

}  // namespace gearlash::portable
