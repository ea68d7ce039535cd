#include "app/records/check_record.h"

#include "app/records/record_parts.h"

namespace hoplab {
namespace {

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

}  // namespace

Json CheckRecord(const Dataset& dataset, const CheckSettings& settings, const CheckRun& run) {
  const FitProblem& problem = run.problem;
  const CheckReport& check = run.check;
  RecordHeader header;
  header.command = "check";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(problem.law));
  header.reading = dataset.mechanism.reading;
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
  record["trace_faults"] = TraceFaultsRecord(problem, dataset);
  record["known"] = KnownRecord(problem);
  if (!problem.formulas.empty()) record["formulas"] = FormulasRecord(problem);
  record["trials"] = Json::array();
  for (const TrialCheck& t : check.trials) record["trials"].push_back(TrialRecord(t));
  record["noise"] = Json::array();
  for (const ChannelNoise& n : run.noise) {
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

}  // namespace hoplab
