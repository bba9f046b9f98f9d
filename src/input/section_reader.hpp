// Reading the keys of one section of a TOML file and collecting its faults.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "input/toleranced_value.hpp"
#include "input/toml_document.hpp"

namespace gearlash {

/// The faults of one file. Only the first fault of a field is kept.
class Findings {
 public:
  explicit Findings(const TomlDocument& document) : document_(document) {}

  /// Records a missing value; `place` is where it belongs.
  void missing(Place place, const std::string& field, const std::string& permitted);
  /// Records a value at fault, quoted as its author wrote it.
  void refuse(const std::string& field, const toml::node& value, const std::string& permitted);
  void refuse(Place place, const std::string& field, const std::string& value,
              const std::string& permitted);

  /// Records where the value of `field` stands, to locate a fault that faults() may find in it.
  void remember(const std::string& field, const toml::node& value) { values_[field] = &value; }
  /// Adds the faults that faults() found. Each is located at the value remembered under its path,
  /// or the name that `field_of` gives for it. A fault of no single value follows from several: it
  /// is located at `otherwise`, and is added only if every value could be read, because
  /// placeholders could have caused it.
  void take(
      const std::vector<Fault>& faults, Place otherwise,
      const std::function<std::string(const std::string&)>& field_of = [](const std::string& path) {
        return path;
      });

  bool none() const { return found_.empty(); }
  /// What the first finding permits; "" if there is none.
  std::string first() const { return none() ? "" : found_.front().fault.permitted; }
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

/// One section. A reading function that records a fault returns a placeholder within every range,
/// so that reading continues and finds the other faults.
class SectionReader {
 public:
  /// The section `name` of the document. A missing section that is `required` is recorded as one
  /// fault, its keys are not; `contents` describes what belongs there.
  SectionReader(const TomlDocument& document, Findings& findings, std::string name, bool required,
                const std::string& contents);

  /// From now on quantities may be bare numbers, in the SI unit of their dimension.
  void accept_bare_numbers() { bare_numbers_ = true; }

  /// From now on numbers may carry tolerances, which are added to `tolerances` under their keys.
  void collect_tolerances(std::vector<ParameterTolerance>& tolerances) {
    tolerances_ = &tolerances;
  }

  /// Whether collect_tolerances() was called and the number of this key was read with a tolerance.
  bool has_tolerance(const std::string& key) const;

  /// Accepts a key of this section without reading it.
  void know(const std::string& key);
  /// Whether the key holds a quantity of that dimension.
  bool is_of(const std::string& key, const Dimension& dimension);

  /// A number with its unit, given as text, times the factor.
  Measured quantity(const std::string& key, const Dimension& expected, double factor = 1.0);
  /// A number without unit: a TOML number, or text (a fraction). `permitted` describes the number
  /// in the fault of a missing key.
  double number(const std::string& key, const std::string& permitted,
                NumberText read_text = read_number);
  /// One of `choices`. Anything else is recorded as a fault and gives nothing; a missing key is a
  /// fault if `required`.
  std::optional<std::string> choice(const std::string& key, const std::vector<std::string>& choices,
                                    bool required);

  /// A list of texts; faults name them "key[0]", "key[1]", …. Empty if the key is missing; that is
  /// a fault if `permitted`, the description of the list, is not empty.
  std::vector<std::string> texts(const std::string& key, const std::string& permitted = "");
  /// A text, by the same rule.
  std::string text(const std::string& key, const std::string& permitted);
  /// A list of numbers; empty if the key is missing, which is a fault.
  std::vector<double> numbers(const std::string& key, const std::string& permitted);
  /// A list of lists of numbers, by the same rule.
  std::vector<std::vector<double>> rows(const std::string& key, const std::string& permitted);
  /// The key's value. Records a fault if the key is missing.
  const toml::node* require(const std::string& key, const std::string& permitted);
  /// Records a fault if the key is given.
  void refuse(const std::string& key, const std::string& permitted);

  /// The same if the key holds this text.
  void refuse_word(const std::string& key, std::string_view word, const std::string& permitted);

  /// Records a fault for every key that has not been read.
  void refuse_other_keys();
  using Reason =
      std::function<std::string(const std::string& key, const std::vector<std::string>& known)>;
  /// The same, with the reason that is given for it.
  void refuse_other_keys(const Reason& reason);

  bool has(const std::string& key) const { return table_ != nullptr && table_->contains(key); }
  /// The section's header, or the beginning of the file.
  Place place() const;

 private:
  const toml::node* find(const std::string& key);
  Measured read(const std::string& key, const toml::node& value, const Dimension& expected,
                double factor);
  double read(const std::string& key, const toml::node& value, NumberText read_text);
  /// What `read` makes of each element, "name[0]", "name[1]", …
  template <class Read>
  auto read_list(const std::string& name, const toml::node& value, const std::string& permitted,
                 const Read& read);
  std::vector<double> read_numbers(const std::string& name, const toml::node& value,
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

}  // namespace gearlash
