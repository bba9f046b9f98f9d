// What describing functions predict of a drive beside what is exact, for a person and a program.
#pragma once

#include <string>
#include <vector>

#include "analysis/describing/describing.hpp"
#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "output/report_units.hpp"

namespace gearlash {

struct DescribeReport {
  std::vector<drive::DescribingAnalysis> analyses = {};
  Drive drive = {};
  Answer answer = {};          ///< what is exact; of a drive that a sine drives nothing predicts it
  double backlash = 0.0;       ///< rad; predictions that are too small beside it are left out
  AngleUnit angle = {};        ///< in which the author gave the backlash
  bool is_normalized = false;  ///< text has times in units of 1/ω_n
  Provenance provenance = {};
};

/// What is exact in a line; for each analysis a table of what is predicted, what is exact and the
/// error in per cent, the loop and what is assumed. Ends with a newline.
std::string describe_text(const DescribeReport& report);

/// The contract of docs/schemas/describe.schema.json ("gearlash/describe/2"), in SI, ending with a
/// newline; numbers read back exactly.
std::string describe_json(const DescribeReport& report);

}  // namespace gearlash
