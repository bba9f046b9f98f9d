// What the list of all parameters and quantities says of each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "output/json_writer.hpp"

namespace gearlash::listed {

using Words = std::vector<std::string>;

/// Another form of a parameter.
struct Alias {
  std::string path{};       ///< as in files
  std::string unit{};       ///< SI, of another relation; empty without
  bool is_same = false;     ///< whether its value is the parameter's own
  std::string permitted{};  ///< values: "> 0"
};

struct ListedParameter {
  std::string path{};                ///< as in files
  std::string kind{};                ///< "number", "choice", "list", "matrix", "file"
  std::string meaning{};             ///< one sentence, without a full stop
  std::string unit{};                ///< SI; empty without
  std::string example{};             ///< a value with its unit; empty without
  ByName<ByName<Words>> units{};     ///< path of a word, unit, words: what its unit depends on
  ByName<ByName<Words>> defaults{};  ///< the default of a word, likewise
  ByName<Words> exists_with{};       ///< words of a path, where others rule it out
  std::string permitted{};           ///< values of a number; else empty
  bool is_required = false;          ///< a file must give it
  ParameterValue otherwise{};        ///< its default, or the path of the parameter that has it
  Words words{};                     ///< all that a choice may be given by
  ByName<std::string> synonyms{};    ///< those for others of them
  std::vector<Alias> aliases{};      ///< its other forms
  double usual_low = 0.0;            ///< a range worth studying; both 0 without one
  double usual_high = 0.0;           ///< its upper end
};

struct ListedQuantity {
  std::string_view name{};     ///< in targets and tables
  std::string_view unit{};     ///< SI; empty of a word
  std::string_view meaning{};  ///< what it is
  std::string_view scope{};    ///< what it is of
};

/// Everything that files, targets and tables can name.
struct Lists {
  ByName<std::string> sections{};             ///< of files, with their contents
  std::vector<ListedParameter> parameters{};  ///< in the order of files
  std::vector<ListedQuantity> quantities{};   ///< in the order of tables
};

}  // namespace gearlash::listed
