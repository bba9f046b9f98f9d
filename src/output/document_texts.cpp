// The JSON of every document.
#include "gearlash/output.hpp"
#include "output/answer_report.hpp"
#include "output/comparison_report.hpp"
#include "output/describe_report.hpp"
#include "output/design_report.hpp"
#include "output/documents.hpp"
#include "output/drive_text.hpp"
#include "output/grid_table.hpp"
#include "output/json_writer.hpp"
#include "output/motion_report.hpp"
#include "output/tolerance_report.hpp"
#include "output/tune_report.hpp"

namespace gearlash {

std::string answer_json(const AnswerReport& report) { return document_text(report); }
std::string comparison_json(const ComparisonReport& report) { return document_text(report); }
std::string describe_json(const DescribeReport& report) { return document_text(report); }
std::string design_json(const DesignReport& report) { return document_text(report); }
std::string tolerance_json(const ToleranceReport& report) { return document_text(report); }
std::string tune_json(const TuneReport& report) { return document_text(report); }

std::string show_json(const Drive& drive, const Provenance& provenance) {
  return document_text(shown_drive(drive, provenance));
}

void write_grid_json(const GridTable& table, const TextSink& sink) {
  write_document(document_of(table), sink);
}

void write_motion_json(const MotionReport& report, const TextSink& sink, Progress& progress) {
  write_document(document_of(report, progress), sink);
}

std::string to_json(const Drive& drive, const Answer& answer) {
  return answer_json(report_of(drive, answer));
}

}  // namespace gearlash
