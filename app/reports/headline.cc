#include "app/reports/headline.h"

#include <algorithm>
#include <array>

#include "app/reports/headline_parts.h"

namespace hoplab {
namespace {

struct RunKind {
  const char* command;
  const char* title;
  void (*fill)(const Json&, Headline&);
};
constexpr std::array<RunKind, 11> kKinds = {{{"check", "Check", CheckHeadline},
                                             {"fit", "Fit", FitHeadline},
                                             {"diagnose", "Diagnosis", DiagnosisHeadline},
                                             {"discover", "Formula", DiscoveryHeadline},
                                             {"design", "Trial to record next", DesignHeadline},
                                             {"gait", "Gait", GaitHeadline},
                                             {"optimize", "Optimisation", OptimizeHeadline},
                                             {"sweep", "Sweep", SweepHeadline},
                                             {"simulate", "Simulation", SimulationHeadline},
                                             {"report", "Comparison", ComparisonHeadline},
                                             {"reproduce", "Reproduction", ReproductionHeadline}}};

}  // namespace

Headline HeadlineOf(const Json& record) {
  Headline out;
  const std::string command = TextAt(record, "/command");
  std::string subject = TextAt(record, "/dataset");
  if (subject.empty()) subject = TextAt(record, "/scenario");
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(),
                                 [&](const RunKind& k) { return command == k.command; });
  const bool known = kind != kKinds.end();
  out.title =
      (known ? kind->title : "hoplab " + command) + (subject.empty() ? "" : " of ") + subject;
  const bool failed = TextAt(record, "/status") == "failed";
  if (known) kind->fill(record, out);
  if (out.sentence.empty()) out.sentence = out.title + ".";
  if (failed) {  // an interrupted run may have a result all the same
    const std::string message = TextAt(record, "/message");
    out.sentence = message.empty() ? "The run failed." : message + ".";
  }
  return out;
}

}  // namespace hoplab
