#include "app/reports/check_report.h"

#include <cmath>

#include "app/records/fit_words.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "app/terminal/warnings.h"
#include "base/text.h"

namespace hoplab {

std::string CheckRunReport(const Dataset& dataset, const CheckRun& run, bool colours) {
  const FitProblem& problem = run.problem;
  const CheckReport& check = run.check;
  using enum TextTable::Align;
  std::string text = Styled(Printable(dataset.name, 100), Emphasis::kBold, colours) + "  law " +
                     std::string(NameOf(problem.law)) + ", free " + Join(problem.shared_names()) +
                     "\n\n";
  TextTable trials({kLeft, kLeft, kRight, kRight, kRight, kRight, kLeft});
  trials.AddRow({"trial", "role", "rows", "seconds", "hops", "simulated", "at the nominal values"});
  for (const TrialCheck& t : check.trials) {
    trials.AddRow({t.file, RoleName(t.role), std::to_string(t.rows), Fixed(t.duration_s, 3),
                   t.hops_in_data < 0 ? "-" : std::to_string(t.hops_in_data),
                   std::to_string(t.hops_in_simulation), std::string(SentenceOf(t.outcome))});
  }
  TextTable channels({kLeft, kRight, kRight});
  channels.AddRow({"channel", "sigma stated", "sigma in the traces"});
  for (const ChannelNoise& n : run.noise) {
    channels.AddRow({WithoutUnit(n.channel),
                     std::isnan(n.stated) ? "estimate" : ErrorText(n.stated, n.unit),
                     ErrorText(n.in_traces, n.unit)});
  }
  for (const TextTable& table : {trials, channels}) {
    const std::vector<std::string> lines = table.Lines();
    if (lines.size() < 2) continue;
    text += WithHeader(lines, colours) + "\n";
  }
  text += "  determined  " +
          (check.uncertainty ? DeterminedLine(problem, *check.uncertainty, " at the nominal values")
                             : std::string("not computed: no train trial could be simulated")) +
          "\n  gradients   " + CertificateLine(check.certificate) + "\n";
  for (const std::string& note : check.notes) text += "  note        " + note + "\n";
  if (check.warnings.empty()) text += "  warnings    none\n";
  for (const std::string& warning : CollapseWarnings(check.warnings)) {
    text += "  " + Styled("warning", Emphasis::kWarning, colours) + "     " + warning + "\n";
  }
  return text;
}

}  // namespace hoplab
