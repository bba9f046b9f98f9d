// The report of describing functions: predictions beside the exact answer, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "gearlash/answer.hpp"
#include "gearlash/drive.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"
#include "question/loop/describing/describing.hpp"

namespace gearlash {

/// "gearlash/describe/3": predictions of describing functions beside the exact answer.
struct DescribeReport {
  std::vector<drive::DescribingAnalysis> analyses{};  ///< one for each nonlinearity
  Drive drive{};                                      ///< its parameters
  Answer answer{};          ///< exact; not predicted if a sine drives the drive
  double backlash = 0.0;    ///< rad; predictions too small beside it are left out
  Provenance provenance{};  ///< how it was made
};

/// The describing functions of the drive beside its exact answer.
DescribeReport describe_report_of(const Drive& drive, const Answer& answer,
                                  const Provenance& provenance = {});

/// The headline of the exact answer. Then for each analysis a table of predicted and exact values
/// with the error in per cent, the loop and the assumptions. Ends with a newline.
std::string describe_text(const DescribeReport& report);

/// The report as JSON, in SI. Numbers read back exactly. Ends with a newline.
std::string describe_json(const DescribeReport& report);

}  // namespace gearlash
