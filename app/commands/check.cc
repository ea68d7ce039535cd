#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <ostream>

#include "app/records/fit_words.h"
#include "app/records/record_parts.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/progress.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "app/terminal/warnings.h"
#include "base/text.h"
#include "datasets/read_dataset.h"
#include "fitting/noise.h"

namespace hoplab {
namespace {

struct CheckSettings : RunSettings {
  ProblemSettings problem;
};

// What the traces alone show of a channel's noise.
struct ChannelNoise {
  std::string channel, unit;
  double stated = std::numeric_limits<double>::quiet_NaN();  // NaN: to be estimated
  double in_traces = 0.0;                                    // NaN: too few samples
};

std::vector<ChannelNoise> NoiseOf(const Dataset& dataset) {
  std::vector<ChannelNoise> noise;
  for (const ChannelSpec& spec : dataset.channels) {
    if (IsContact(spec.id)) continue;
    std::vector<SampledColumn> columns;
    for (const Trial& trial : dataset.trials) {
      if (const std::vector<double>* values = trial.trace.Find(spec.id))
        columns.push_back({trial.trace.time_s, *values});
    }
    ChannelNoise entry{ChannelName(spec.id), ChannelUnit(spec.id)};
    if (spec.sigma) entry.stated = *spec.sigma;
    entry.in_traces = EstimateNoise(columns);
    noise.push_back(entry);
  }
  return noise;
}

Json TrialRecord(const TrialCheck& t) {
  return {{"file", t.file},
          {"role", RoleName(t.role)},
          {"rows", t.rows},
          {"samples", t.samples},
          {"duration_s", t.duration_s},
          {"hops_in_data", t.hops_in_data < 0 ? Json(nullptr) : Json(t.hops_in_data)},
          {"hops_in_simulation", t.hops_in_simulation},
          {"outcome", NameOf(t.outcome)},
          {"end_time_s", NumberOrNull(t.end_time_s)}};
}

Json RecordOf(const Dataset& dataset, const CheckSettings& settings, const FitProblem& problem,
              const CheckReport& check, const std::vector<ChannelNoise>& noise) {
  RecordHeader header;
  header.command = "check";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(problem.law));
  const ProblemOptions problem_options = ProblemOptionsOf(settings.problem);
  const FitOptions no_search;
  header.options =
      OptionsRecord(problem, {settings.problem.dataset, &problem_options, &no_search, {}});
  for (const char* of_the_search :
       {"starts", "seed", "strategy", "span", "loss", "loss_scale", "max_iterations"})
    header.options.erase(of_the_search);
  Json record = NewRecord(header);
  record["warnings"] = check.warnings;
  record["notes"] = check.notes;
  record["known"] = KnownRecord(problem);
  if (!problem.formulas.empty()) record["formulas"] = FormulasRecord(problem);
  record["trials"] = Json::array();
  for (const TrialCheck& t : check.trials) record["trials"].push_back(TrialRecord(t));
  record["noise"] = Json::array();
  for (const ChannelNoise& n : noise) {
    record["noise"].push_back({{"channel", n.channel},
                               {"sigma_stated", NumberOrNull(n.stated)},
                               {"sigma_in_traces", NumberOrNull(n.in_traces)}});
  }
  record["identifiability"] =
      check.uncertainty ? IdentifiabilityRecord(problem, check.uncertainty->identifiability)
                        : Json{{"condition_number", nullptr}, {"weak_directions", nullptr}};
  record["gradient_check"] = CertificateRecord(check.certificate);
  record["parameters"] = Json::array();
  for (int i = 0; i < problem.shared_count(); ++i) {
    const SharedParameter& s = problem.shared[i];
    record["parameters"].push_back(
        {{"name", s.name},
         {"unit", s.unit},
         {"initial", s.initial},
         {"std_error_at_initial",
          check.uncertainty ? NumberOrNull(check.uncertainty->parameters[i].std_error) : nullptr}});
  }
  return record;
}

std::string Report(const Dataset& dataset, const FitProblem& problem, const CheckReport& check,
                   const std::vector<ChannelNoise>& noise, bool colours) {
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
  for (const ChannelNoise& n : noise) {
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

ExitCode RunCheck(const CheckSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  const ProblemOptions options = ProblemOptionsOf(settings.problem);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "check");
  const FitProblem problem = MakeProblem(dataset, options);
  const CheckReport check = CheckDataset(dataset, problem, JobsOf(settings.problem.jobs));
  const std::vector<ChannelNoise> noise = NoiseOf(dataset);

  Json record = RecordOf(dataset, settings, problem, check, noise);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  if (!settings.out.empty()) folder.Write({{"run.json", TextOf(record)}});
  if (settings.json) {
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  console.out << Report(dataset, problem, check, noise, console.out_colours);
  if (!settings.out.empty()) console.out << "  run folder  " << settings.out << '\n';
  return ExitCode::kDone;
}

void AddCheck(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<CheckSettings>();
  AddProblemOptions(sub, settings->problem);
  AddRunFolderOptions(sub, *settings, "Write a run folder here (default: nothing is written)");
  OnParsed(sub, invocation, settings, RunCheck);
}

}  // namespace

namespace commands {
extern constexpr Command check = {
    .place = 20,
    .name = "check",
    .what = "Data quality, identifiability and gradients of a dataset, before any fit",
    .footer =
        "Examples:\n"
        "  hoplab check datasets/rig-drops\n"
        "  hoplab check my-hops --free E,d,m --law consistent --json",
    .add = AddCheck};
}  // namespace commands
}  // namespace hoplab
