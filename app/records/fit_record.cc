#include "app/records/fit_record.h"

#include "app/records/fit_words.h"
#include "app/records/record_parts.h"
#include "app/records/trial_tables.h"

namespace hoplab {
namespace {

Json RestartsRecord(const FitRun& run) {
  Json out = Json::array();
  for (const StartRecord& start : run.fit.records) {
    Json rejected = Json::object();
    for (const auto& [reason, count] : start.rejected) rejected[reason] = count;
    const bool led_somewhere = start.shared.size() == run.problem.shared_count();
    out.push_back({{"cost", NumberOrNull(start.cost)},
                   {"status", NameOf(start.status)},
                   {"message", start.message},
                   {"from", ByParameter(run.problem, start.from)},
                   {"to", led_somewhere ? ByParameter(run.problem, start.shared) : Json(nullptr)},
                   {"iterations", start.iterations},
                   {"rejected", rejected}});
  }
  return out;
}

Json ProfilesRecord(const FitRun& run) {
  Json out = Json::array();
  for (const Profile& profile : run.profiles) {
    Json points = Json::array();
    for (const ProfilePoint& p : profile.points) {
      points.push_back({{"value", p.value},
                        {"delta_chi2", NumberOrNull(p.delta_chi2)},
                        {"parameters", ByParameter(run.problem, p.shared)}});
    }
    out.push_back(
        {{"name", run.problem.shared[profile.parameter].name},
         {"ci95", Json::array({NumberOrNull(profile.lower95), NumberOrNull(profile.upper95)})},
         {"points", points}});
  }
  return out;
}

// The cost of the train trials and its derivative by the shared values, initial states held.
Json ObjectiveRecord(const FitProblem& problem, const std::optional<Objective>& objective) {
  const bool known = objective && objective->complete;
  return {{"cost", known ? NumberOrNull(objective->cost) : Json(nullptr)},
          {"gradient", known ? ByParameter(problem, objective->gradient) : Json(nullptr)}};
}

// What the terminal says in words, for the report to say the same.
Json FitSentences(const FitRun& run) {
  const bool assessed = run.uncertainty.has_value();
  const bool misfit = assessed && run.uncertainty->misfit;
  return {{"misfit", misfit ? Json(MisfitLine(run.problem, *run.uncertainty)) : Json(nullptr)},
          {"determined",
           assessed ? Json(DeterminedLine(run.problem, *run.uncertainty, "")) : Json(nullptr)},
          {"gradients", CertificateLine(run.certificate)},
          {"remarks", Remarks(run)}};
}

// How sure the values are together; nulls where they were not assessed.
void AddUncertainty(const FitRun& run, Json& record) {
  const bool assessed = run.uncertainty.has_value();
  record["chi2_per_dof"] = assessed ? NumberOrNull(run.uncertainty->chi2_per_dof) : Json(nullptr);
  record["chi2_p_value"] = assessed ? NumberOrNull(run.uncertainty->chi2_p_value) : Json(nullptr);
  record["misfit"] = assessed ? Json(run.uncertainty->misfit) : Json(nullptr);
  record["covariance"] =
      assessed ? MatrixRecord(run.problem, run.uncertainty->covariance) : Json(nullptr);
  record["correlation"] =
      assessed ? MatrixRecord(run.problem, run.uncertainty->correlation) : Json(nullptr);
}

// Why the search may have ended where it did.
Json StopRecord(const FitRun& run) {
  return {
      {"minimum", run.has_result && run.faults.empty()},
      {"complete", run.has_result && run.fit.stop.complete},
      {"promised_nats", run.has_result ? NumberOrNull(run.fit.stop.promised_nats) : Json(nullptr)},
      {"on_edges_of", run.fit.stop.on_edges_of},
      {"at_wall", run.fit.stop.at_wall},
      {"faults", run.faults}};
}

}  // namespace

Json FitRecord(const Dataset& dataset, const std::string& dataset_argument,
               const FitRunOptions& options, const FitRun& run) {
  RecordHeader header;
  header.command = "fit";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(run.problem.law));
  header.reading = dataset.mechanism.reading;
  header.seed = options.fit.seed;
  header.options =
      OptionsRecord(run.problem, {dataset_argument, &options.problem, &options.fit, options.span});
  header.options["profile"] = options.profile;
  Json record = NewRecord(header);
  record["status"] = NameOf(run.Standing());
  record["message"] = run.Caveat();

  record["parameters"] = ParametersRecord({&run.problem, run.has_result ? &run.fit.shared : nullptr,
                                           run.uncertainty ? &*run.uncertainty : nullptr});
  record["train"] = RoleRecord(run.problem, run.trials, TrialRole::kTrain);
  record["test"] = RoleRecord(run.problem, run.trials, TrialRole::kTest);
  record["trials"] = TrialsRecord(run.problem, run.trials);
  record["identifiability"] =
      run.uncertainty
          ? IdentifiabilityRecord(run.problem, run.uncertainty->identifiability)
          : Json{{"condition_number", nullptr}, {"weak_directions", nullptr}, {"rank", nullptr}};
  record["objective"] = {{"at_nominal", ObjectiveRecord(run.problem, run.at_nominal)},
                         {"at_optimum", ObjectiveRecord(run.problem, run.at_optimum)}};
  record["gradient_check"] = CertificateRecord(run.certificate);
  record["starts"] = RestartsRecord(run);
  record["best_start"] = run.has_result ? Json(run.fit.best_start) : Json(nullptr);
  record["cost"] = run.has_result ? NumberOrNull(run.fit.cost) : Json(nullptr);
  record["interrupted"] = run.interrupted;
  AddUncertainty(run, record);
  record["profiles"] = ProfilesRecord(run);
  record["channels"] = ChannelsRecord(run.problem);
  record["trace_faults"] = TraceFaultsRecord(run.problem, dataset);
  record["known"] = KnownRecord(run.problem);
  if (!run.problem.formulas.empty()) record["formulas"] = FormulasRecord(run.problem);
  record["sentences"] = FitSentences(run);
  record["mechanism"] =
      run.has_result ? FittedMechanismRecord({&run.problem, &run.fit.shared, &run.trials, ""})
                     : Json(nullptr);
  RecordSpan(run.by_hop, run.until, record);
  record["left_out"] = run.left_out;
  record["left"] = run.fit.discrepancy ? LeftRecord(run.problem) : Json(nullptr);
  record["stop"] = StopRecord(run);
  record["warnings"] = run.check.warnings;
  for (const std::string& warning : run.warnings) record["warnings"].push_back(warning);
  record["notes"] = run.check.notes;
  if (!run.note.empty()) record["notes"].push_back(run.note);
  record["tools"] = ToolsRecord();
  return record;
}

}  // namespace hoplab
