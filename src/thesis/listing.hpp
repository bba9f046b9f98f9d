// Table I of the thesis: its symbolic code, its octal words, and their differences.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "thesis/ar_assembler.hpp"

namespace gearlash::thesis {

struct Listing {
  std::vector<Statement> program;  ///< the symbolic column
  std::map<unsigned, Word> octal;  ///< the octal column, by address
};

/// Table I as transcribed from the thesis (src/thesis/data/table-1.txt), with its errors.
const Listing& thesis_table_1();

/// A word for which the assembled symbolic column differs from the octal column.
struct ListingDifference {
  unsigned address;
  Word listed;
  Word assembled;
  std::string source;  ///< the symbolic code

  bool operator==(const ListingDifference&) const = default;
};

/// All differences, by address.
std::vector<ListingDifference> differences_of_listing();

/// Our RUNGE, assembled (src/thesis/data/runge.ar).
const Assembly& runge();

/// A word as the listing prints it: "75 4 20022 00 0 00000".
std::string octal_text(Word word);

}  // namespace gearlash::thesis
