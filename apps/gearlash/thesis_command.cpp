// gearlash thesis: the program of 1960, its printout and its charts, beside the exact answer.
#include "thesis_command.hpp"

namespace gearlash::cli {
namespace {

constexpr char thesis_examples[] =
    "  gearlash thesis table-2\n"
    "  gearlash thesis machine\n"
    "  gearlash thesis run --damping 0.19 --inertia-ratio 2 --friction-ratio 0.1\n";

}  // namespace

std::optional<WrittenDrive> resolve_charted_drive(ServoOptions typed, Faults& faults) {
  if (has_drive(typed) && typed.file.empty() && !typed.backlash()) typed.backlash() = "0.3";
  return resolve_drive(typed, {}, faults);
}

void add_thesis_command(const Command& app, Action& action) {
  const Command thesis = app.add_subcommand(
      "thesis", "Run the program of 1960 and draw its charts, beside the exact answer");
  thesis.require_subcommand();
  thesis.footer(help_footer(thesis_examples));
  for (AddVerb* add : {add_thesis_table_2, add_thesis_machine, add_thesis_run, add_thesis_figure,
                       add_thesis_chart_reading, add_thesis_extension, add_thesis_all}) {
    add(thesis, action);
  }
}

}  // namespace gearlash::cli
