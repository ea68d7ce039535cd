#include <chrono>
#include <ostream>

#include "app/records/reproduction_record.h"
#include "app/records/reproduction_runs.h"
#include "app/records/solver_record.h"
#include "app/reports/reproduction_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "base/input_error.h"
#include "base/range.h"
#include "base/text.h"

namespace hoplab {
namespace {

constexpr const char* kConstants = "experiments/published.yaml";

struct ReproduceSettings : RunSettings {
  std::vector<std::string> items;
  ScenarioSettings constants{.scenario = kConstants};
  TwoLegs legs;
  int jobs = 0;
  SolverSettings solver;
};

void CheckLength(const std::string& option, double value) {
  constexpr Range kLength = Positive(1e3, "m");
  if (!kLength.Contains(value))
    throw InputError(
        {option, FormatDouble(value), "must be in " + kLength.Text(), RangeRemedy(value, kLength)});
}

Json NewReproductionRecord(const ReproduceSettings& settings, const Study& study,
                           const std::vector<std::string>& items, const std::string& constants) {
  RecordHeader header;
  header.command = "reproduce";
  header.law = study.constants.law;
  header.options = {{"items", items},
                    {"constants", settings.constants.scenario},
                    {"set", settings.constants.set},
                    {"hip_distance_m", settings.legs.hip_distance},
                    {"leg_diameter_m", settings.legs.leg_diameter}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = study.constants.name;
  record["constants"] = constants;  // dotted.key=text, one a line
  return record;
}

ExitCode RunReproduceCommand(const ReproduceSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  CheckLength("--hip-distance", settings.legs.hip_distance);
  CheckLength("--leg-diameter", settings.legs.leg_diameter);
  ReproductionRequest request;
  request.items =
      ResolveStudyItems(settings.items.empty() ? std::vector<std::string>{"all"} : settings.items);
  const ScenarioDocument document = ScenarioDocumentOf(settings.constants);
  request.study = StudyOfScenario(document.Read(), IntegratorOptionsOf(settings.solver));
  request.legs = settings.legs;
  request.jobs = JobsOf(settings.jobs);
  const std::string& name = request.study.constants.name;
  const RunFolder folder(RunFolderOptionsOf(settings), name, "reproduce");

  const InterruptGuard interrupt;
  request.stop = interrupt.flag();
  Progress progress(console, settings.quiet);
  progress.Stage("reproducing " + std::to_string(request.items.size()) + " items");
  request.progress = [&](int done, const std::string& item) {
    progress.Step("reproducing: " + std::to_string(done) + " of " +
                      std::to_string(request.items.size()) + ", last " + item,
                  done, static_cast<long>(request.items.size()));
  };
  const Reproduction reproduction = Reproduce(request);
  progress.Clear();

  Json record =
      NewReproductionRecord(settings, request.study, request.items, document.ResolvedText());
  AddReproduction(reproduction, record);
  std::string failure;
  if (!reproduction.left_out.empty())
    failure = "interrupted; left out " + Join(reproduction.left_out);
  if (!failure.empty()) SetFailed(record, failure);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  std::map<std::string, std::string> files = ReproductionTables(reproduction);
  if (const auto runs = ComparedLegs(request.study, reproduction)) {
    files["trajectories.csv"] = runs->table;
    record["mechanisms"] = runs->mechanisms;
  }
  files["run.json"] = TextOf(record);
  const std::string written = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << ReproductionReport(name, reproduction, console.out_colours) << "  run folder  "
                << written << '\n';
  }
  if (failure.empty()) return ExitCode::kDone;
  console.err << "hoplab reproduce: " << failure << '\n';
  return ExitCode::kInterrupted;
}

void AddReproduce(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ReproduceSettings>();
  sub.add_option("ITEM", settings->items,
                 "table-6.1, figure-6.23, claim-a ...; or tables, figures, kinematics, claims, all "
                 "(default)");
  sub.add_option("--constants", settings->constants.scenario,
                 std::string("What the study does not print, a scenario (default ") + kConstants +
                     "); its start is that of table 6.5")
      ->option_text("FILE");
  sub.add_option("--set", settings->constants.set,
                 "key=value over the constants, as mechanism.body_mass_kg=0.5; repeatable")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--law", settings->constants.law, "Another law than the constants have")
      ->option_text("LAW");
  sub.add_option("--hip-distance", settings->legs.hip_distance,
                 "Kinematics: between the hips, m (default 0.4)")
      ->option_text("M");
  sub.add_option("--leg-diameter", settings->legs.leg_diameter,
                 "Kinematics: of a leg's half circle, m (default 0.18)")
      ->option_text("M");
  AddJobsOption(sub, settings->jobs);
  AddSolverOptions(sub, settings->solver);
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<constants>-reproduce-NNN)");
  OnParsed(sub, invocation, settings, RunReproduceCommand);
}

}  // namespace

namespace commands {
extern constexpr Command reproduce = {
    .place = 110,
    .name = "reproduce",
    .what = "Tables, figures and claims of the published study beside ours",
    .footer =
        "A verdict is \"reproduced\", \"only under stated settings\" or \"not reproduced\";\n"
        "the exit code is 0 with any of them. See docs/published-study.md.\n"
        "Examples:\n"
        "  hoplab reproduce table-6.5 claim-h\n"
        "  hoplab reproduce all --out runs/study\n"
        "  hoplab reproduce kinematics --hip-distance 0.5\n"
        "  hoplab reproduce claims --law consistent",
    .add = AddReproduce};
}  // namespace commands
}  // namespace hoplab
