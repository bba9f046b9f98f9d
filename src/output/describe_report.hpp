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
  Answer answer = {};     ///< what is exact; of a drive that a sine drives nothing predicts it
  double backlash = 0.0;  ///< rad; predictions that are too small beside it are left out
  AngleUnit angle = {};   ///< in which the author gave the backlash
  std::string time_unit = "s";  ///< of the drive; else periods are given in it, and ω as angles
  Provenance provenance = {};
};

/// "0.54 s", "1.85 Hz"; in another unit of time "6.456 / ω_n", "ω = 0.973 ω_n".
std::string period_text(double period, const std::string& time_unit, int digits);
std::string frequency_text(double period, const std::string& time_unit, int digits);

/// What is exact in a line; for each analysis a table of what is predicted, what is exact and the
/// error in per cent, the loop and what is assumed. Ends with a newline.
std::string describe_text(const DescribeReport& report);

/// The contract of docs/schemas/describe.schema.json ("gearlash/describe/2"), in SI, ending with a
/// newline; numbers read back exactly.
std::string describe_json(const DescribeReport& report);

}  // namespace gearlash
