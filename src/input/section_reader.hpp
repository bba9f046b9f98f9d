// Reading the keys of one section of a TOML file, and noting everything that is wrong with it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "gearlash/tolerance.hpp"
#include "input/toleranced_value.hpp"
#include "input/toml_document.hpp"
#include "input/units.hpp"

namespace gearlash {

/// The faults of one file. A field is reported once, whoever finds it at fault first.
class Findings {
 public:
  explicit Findings(const TomlDocument& document) : document_(document) {}

  /// A value that is missing, at the place where it should have been.
  void missing(Place place, const std::string& field, const std::string& permitted);
  /// A value at fault, in its author's writing.
  void refuse(const std::string& field, const toml::node& value, const std::string& permitted);
  void refuse(Place place, const std::string& field, const std::string& value,
              const std::string& permitted);

  /// Notes where the value of `field` stands, in case validate() finds fault with it.
  void remember(const std::string& field, const toml::node& value) { values_[field] = &value; }
  /// Takes what validate() found, each at the value remembered under the name that `field_of` gives
  /// it. Findings about no value of the file follow from several: they are told at `otherwise`, and
  /// only where every value could be read, since placeholders could have caused them.
  void take(const std::vector<Fault>& faults,
            const std::function<std::string(const std::string&)>& field_of, Place otherwise);

  bool none() const { return found_.empty(); }
  /// Throws InvalidInput with all findings in the order of the file.
  void require_none();

 private:
  struct Found {
    Place place;
    Fault fault;
  };

  const TomlDocument& document_;
  std::map<std::string, const toml::node*> values_;
  std::vector<Found> found_;
  std::set<std::string> fields_;  ///< of found_
};

/// One section. Each reading function returns a placeholder within every range where it has noted a
/// finding, so that reading can go on and find the rest.
class SectionReader {
 public:
  /// The section `name` of the document. A section that is `required` and missing is noted, with
  /// `contents` saying what belongs there; its keys are not.
  SectionReader(const TomlDocument& document, Findings& findings, std::string name, bool required,
                std::string contents);

  /// From now on a quantity may be a bare number, in its dimension's SI unit.
  void accept_bare_numbers() { bare_numbers_ = true; }

  /// From now on numbers may carry tolerances, which are added to `tolerances` by their keys.
  void collect_tolerances(std::vector<ParameterTolerance>& tolerances) {
    tolerances_ = &tolerances;
  }

  /// A key of this section that is not given.
  void know(const std::string& key);
  /// Whether the key has a quantity of that dimension.
  bool is_of(const std::string& key, const Dimension& dimension);

  /// A number with a unit, in text.
  Measured quantity(const std::string& key, const Dimension& expected);
  std::optional<Measured> optional_quantity(const std::string& key, const Dimension& expected);
  /// A number without unit: of TOML, or in text (a fraction). Where it is missing, `permitted` says
  /// what it must be.
  double number(const std::string& key, const std::string& permitted);
  /// One of `choices`. Empty, and noted, for anything else; a missing key is noted if `required`.
  std::optional<std::string> choice(const std::string& key, const std::vector<std::string>& choices,
                                    bool required);

  /// A list of texts, each under the name "key[0]", "key[1]", … in findings; empty where it is
  /// missing, which is noted if `permitted` says what it must be.
  std::vector<std::string> texts(const std::string& key, const std::string& permitted = "");
  /// A text; empty where it is missing, which is noted if `permitted` says what it must be.
  std::string text(const std::string& key, const std::string& permitted);
  /// A list of numbers; empty where it is missing, which is noted.
  std::vector<double> numbers(const std::string& key, const std::string& permitted);
  /// A list of such lists.
  std::vector<std::vector<double>> rows(const std::string& key, const std::string& permitted);
  /// Notes the key, and the name it is told by, where it is given.
  void refuse(const std::string& key, const std::string& permitted);

  /// Notes every key that has not been read.
  void refuse_other_keys();

  bool has(const std::string& key) const { return table_ != nullptr && table_->contains(key); }
  /// The section's header, or the beginning of the file.
  Place place() const;

 private:
  const toml::node* find(const std::string& key);
  const toml::node* require(const std::string& key, const std::string& permitted);
  Measured read(const std::string& key, const toml::node& value, const Dimension& expected);
  double read(const std::string& key, const toml::node& value);
  std::vector<double> read_list(const std::string& name, const toml::node& value,
                                const std::string& permitted);
  Measured read(const std::string& key, const toml::node& value, const ExactReader& read_exact,
                double placeholder);
  std::string field(const std::string& key) const { return name_ + "." + key; }

  const TomlDocument& document_;
  Findings& findings_;
  std::string name_;
  bool bare_numbers_ = false;
  std::vector<ParameterTolerance>* tolerances_ = nullptr;
  const toml::table* table_ = nullptr;
  std::vector<std::string> known_;
};

/// " (did you mean b?)", or nothing where none is near.
std::string guess_of(const std::vector<std::string>& known, std::string_view written);

/// "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

/// "must be one of a, b, c (did you mean b?)".
std::string one_of(const std::vector<std::string>& known, std::string_view written);

}  // namespace gearlash
