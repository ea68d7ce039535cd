#include "app/records/diagnosis_record.h"

#include <algorithm>
#include <cmath>

#include "app/records/candidate_record.h"
#include "app/records/carried_on_record.h"
#include "app/records/cause_record.h"
#include "app/records/diagnosis_parts.h"
#include "app/records/diagnosis_words.h"
#include "app/records/fit_words.h"
#include "app/records/misfit_record.h"
#include "app/records/record_parts.h"
#include "app/records/trial_design_record.h"
#include "app/records/trial_tables.h"

namespace hoplab {
namespace {

// Effect names of places in the candidates.
Json NamesOf(const Diagnosis& d, const std::vector<int>& places) {
  Json names = Json::array();
  for (const int place : places)
    names.push_back(
        d.naming.candidates[static_cast<std::size_t>(place)].candidate.effect->info.name);
  return names;
}

// Places of what cannot be told from the cause, itself first.
std::vector<int> GroupOfCause(const Diagnosis& d) {
  const std::optional<int> cause = d.Cause();
  if (!cause) return {};
  for (const std::vector<int>& group : d.naming.groups) {
    if (group.front() == *cause) return group;
  }
  return {*cause};
}

Json MovementsRecord(const std::vector<Movement>& movements) {
  Json out = Json::array();
  for (const Movement& m : movements) {
    out.push_back({{"name", m.name},
                   {"unit", m.unit},
                   {"before", NumberOrNull(m.before)},
                   {"after", NumberOrNull(m.after)},
                   {"std_errors", NumberOrNull(m.std_errors)}});
  }
  return out;
}

Json OtherModelsRecord(const Diagnosis& d) {
  const std::vector<SharedParameter>& shared = d.naming.best.problem.shared;
  const auto candidate = [&](int place) -> const Candidate& {
    return d.naming.candidates[static_cast<std::size_t>(place)].candidate;
  };
  Json out = Json::array();
  for (const OtherModel& other : d.extension->other_models) {
    const Candidate& cause = candidate(other.candidate);
    Json parameters = Json::array(), moves = Json::object();
    for (int i = 0; i < cause.parameter_count(); ++i) {
      const EffectParameter& p = cause.Parameter(i);
      parameters.push_back({{"name", std::string(p.name)},
                            {"value", NumberOrNull(p.null + other.size[i])},
                            {"unit", std::string(p.unit)}});
    }
    for (std::size_t k = 0; k < shared.size(); ++k)
      moves[shared[k].name] = NumberOrNull(other.moved[static_cast<Eigen::Index>(k)]);
    const bool rival = other.instead_of >= 0;
    out.push_back({{"cause", cause.Name()},
                   {"instead_of", rival ? Json(candidate(other.instead_of).Name()) : Json(nullptr)},
                   {"parameters", parameters},
                   {"log_odds", NumberOrNull(other.log_odds)},
                   {"moves", moves}});
  }
  return out;
}

Json ExtensionRecord(const Diagnosis& d) {
  if (!d.extension) return nullptr;
  const ExtensionReport& e = *d.extension;
  const FittedModel& best = d.naming.best;
  Json before = Json::object(), after = Json::object();
  for (const Movement& m : e.movements) {
    before[m.name] = NumberOrNull(m.before);
    after[m.name] = NumberOrNull(m.after);
  }
  return {{"parameters", ParametersRecord({&best.problem, &best.shared, &e.uncertainty})},
          {"other_models", OtherModelsRecord(d)},
          {"test_before", HeldOutRecord(d.problem, d.before)},
          {"test_after", HeldOutRecord(best.problem, e.after)},
          {"heldout_gain",
           {{"nats_per_sample", NumberOrNull(e.gain.nats_per_sample)},
            {"ci95", IntervalRecord(e.gain.ci95)},
            {"samples", e.gain.samples},
            {"hops", e.gain.hops},
            {"claim", e.gain.IsClaim()},
            {"left_out", e.left_out}}},
          {"base_parameters_before", before},
          {"base_parameters_after", after},
          {"movements", MovementsRecord(e.movements)},
          {"gain_nats", NumberOrNull(best.GainOver(d.null))},
          {"explained", NumberOrNull(e.explained)},
          {"at_bound", e.at_bound},
          {"at_wall", e.at_wall},
          {"chi2_per_dof", NumberOrNull(e.uncertainty.chi2_per_dof)},
          {"misfit", e.uncertainty.misfit},
          {"remainder", DetectionRecord(e.remainder)},
          {"trials", TrialsRecord(best.problem, e.after.trials)},
          {"mechanism",
           FittedMechanismRecord({&best.problem, &best.shared, &e.after.trials, "after"})}};
}

Json BalanceRecord(const HopBalance& b) {
  return {{"begin_J", NumberOrNull(b.begin)},
          {"end_J", NumberOrNull(b.end)},
          {"loss_share", NumberOrNull(b.LossShare())}};
}

Json EnergyRecord(const EnergyLedger& ledger) {
  if (ledger.hops.empty()) return nullptr;
  Json hops = Json::array();
  for (const HopEnergy& h : ledger.hops) {
    hops.push_back({{"measured", BalanceRecord(h.measured)},
                    {"before", BalanceRecord(h.before)},
                    {"after", h.after ? BalanceRecord(*h.after) : Json(nullptr)}});
  }
  return {{"trial", ledger.recording}, {"hops", hops}};
}

// The model as it was: fitted values with intervals, errors.
Json NullRecord(const Diagnosis& d) {
  const bool fitted = d.fit.ok && !d.uncertainty.parameters.empty();
  return {{"parameters", ParametersRecord({&d.problem, fitted ? &d.null.shared : nullptr,
                                           fitted ? &d.uncertainty : nullptr})},
          {"train", RoleRecord(d.problem, d.before.trials, TrialRole::kTrain)},
          {"test", HeldOutRecord(d.problem, d.before)},
          {"cost", fitted ? NumberOrNull(d.null.cost) : Json(nullptr)},
          {"chi2_per_dof", fitted ? NumberOrNull(d.uncertainty.chi2_per_dof) : Json(nullptr)},
          {"misfit", fitted ? Json(d.uncertainty.misfit) : Json(nullptr)},
          {"trials", TrialsRecord(d.problem, d.before.trials)}};
}

Json GateRecord(const Diagnosis& d) {
  Json checks = Json::array();
  for (const GateCheck& c : d.gate.checks)
    checks.push_back({{"name", c.name}, {"passed", c.passed}, {"text", c.text}});
  return {{"passed", d.refusal.empty() && !checks.empty()}, {"checks", checks}};
}

Json ResolvedOptions(const std::string& dataset_argument, const DiagnosisOptions& options,
                     const Diagnosis& d) {
  Json record =
      OptionsRecord(d.problem, {dataset_argument, &options.problem, &options.fit, options.span});
  record["effects"] = options.candidates.only;
  record["without"] = options.candidates.without;
  record["max_effects"] = options.max_effects;
  record["material"] = options.material;
  return record;
}

// Verdict, cause and what cannot be told from it.
void AddVerdict(const Diagnosis& d, const std::string& failure, Json& record) {
  // The best extension of an unexplained misfit is no cause.
  const bool has_cause =
      failure.empty() && (d.verdict == Verdict::kNamed || d.verdict == Verdict::kConfounded);
  const std::optional<int> cause = has_cause ? d.Cause() : std::nullopt;
  const Candidate* caused_by =
      cause ? &d.naming.candidates[static_cast<std::size_t>(*cause)].candidate : nullptr;
  record["verdict"] = failure.empty() ? Json(NameOf(d.verdict)) : Json(nullptr);
  record["sentence"] = failure.empty() ? TextOrNull(VerdictSentence(d)) : Json(nullptr);
  record["reason"] = TextOrNull(d.reason);
  record["cause"] = caused_by ? Json(caused_by->effect->info.name) : Json(nullptr);
  record["only_in_trial"] = caused_by ? OneTrial(*caused_by) : Json(nullptr);
  record["only_in_trials"] = caused_by ? Json(caused_by->only_recordings) : Json::array();
  record["group"] = NamesOf(d, has_cause ? GroupOfCause(d) : std::vector<int>());
}

Json OddChannelRecord(const std::optional<OddChannel>& odd) {
  if (!odd) return nullptr;
  Json record = {{"channel", std::string(NameOf(odd->channel))}, {"left_out", !odd->offset_s}};
  record["offset_s"] = odd->offset_s ? Json(*odd->offset_s) : Json(nullptr);
  record["ci95"] = odd->offset_ci95
                       ? Json::array({odd->offset_ci95->first, odd->offset_ci95->second})
                       : Json(nullptr);
  return record;
}

// The model before, what no cause explains, and the causes found.
void AddModels(const DiagnosisRun& run, Json& record) {
  const Diagnosis& d = run.diagnosis;
  record["null"] = NullRecord(d);
  record["free_forces"] = ForcesRecord(d.free_forces);
  record["energy"] = EnergyRecord(run.energy);
  record["penalty_nats"] = d.naming.log_odds > 0.0 ? Json(d.naming.log_odds) : Json(nullptr);
  record["causes"] = CausesRecord(d);
  record["set_aside"] = SetAsideRecord(d);
  record["shows_late_alone"] = d.ShowsLateAlone();
  // A model that is adequate lacks nothing, listed or not.
  record["probability_unlisted"] =
      d.verdict == Verdict::kAdequate ? Json(nullptr) : NumberOrNull(d.UnlistedProbability());
  record["left"] = LeftRecord(d.naming.best.problem);
  record["left_share"] = NumberOrNull(d.left.share);
  record["odd_channel"] = OddChannelRecord(d.odd_channel);
  record["posterior"] = PosteriorRecord(d);
  record["discrepancy"] = {{"before", LeftRecord(d.null.problem)},
                           {"probability", NumberOrNull(d.left.probability)}};
  record["refits"] = d.naming.refits;
}

// Why it may be believed, and in which words a report says so.
void AddChecks(const Diagnosis& d, Json& record) {
  record["gate"] = GateRecord(d);
  record["gradient_check"] = CertificateRecord(
      d.gate.certificate.columns.empty() ? std::nullopt
                                         : std::optional<GradientCertificate>(d.gate.certificate));
  record["channels"] = ChannelsRecord(d.problem);
  record["known"] = KnownRecord(d.problem);
  if (!d.problem.formulas.empty()) record["formulas"] = FormulasRecord(d.problem);
  const bool determined = !d.uncertainty.parameters.empty();
  record["sentences"] = {
      {"determined",
       determined ? Json(DeterminedLine(d.problem, d.uncertainty, "")) : Json(nullptr)},
      {"gradients", CertificateLine(d.gate.certificate)},
      {"remainder", d.extension ? Json(RemainderSentence(d)) : Json(nullptr)}};
}

}  // namespace

Json DiagnosisRecord(const Dataset& dataset, const std::string& dataset_argument,
                     const DiagnosisOptions& options, const DiagnosisRun& run) {
  const Diagnosis& d = run.diagnosis;
  RecordHeader header;
  header.command = "diagnose";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(d.problem.law));
  header.reading = dataset.mechanism.reading;
  header.seed = options.fit.seed;
  header.options = ResolvedOptions(dataset_argument, options, d);
  Json record = NewRecord(header);
  const std::string failure = run.Failure();
  if (!failure.empty()) SetFailed(record, failure);

  AddVerdict(d, failure, record);
  record["effects"] = MembersRecord(d.naming.best.members);
  record["detection"] = DetectionRecord(d.detection);
  record["localisation"] = LocalisationRecord(d);
  record["candidates"] = CandidatesRecord(d);
  record["extension"] = ExtensionRecord(d);
  record["separating_experiment"] = ExperimentRecord(d);
  record["experiment_search"] = SearchRecord(d);
  record["groups"] = GroupsRecord(d);
  record["misfit_by_hop"] =
      PartsRecord(d.localisation.hops, "hop", [](int index) { return index; });
  const std::vector<TrialProblem> train = TrialsOf(d.problem, TrialRole::kTrain);
  record["misfit_by_trial"] = PartsRecord(d.localisation.trials, "trial", [&](int index) {
    return train[static_cast<std::size_t>(index)].file;
  });
  AddModels(run, record);
  AddChecks(d, record);
  record["mechanism"] =
      FittedMechanismRecord({&d.problem, &d.null.shared, &d.before.trials, "before"});
  RecordSpan(d.by_hop, d.until, record);
  record["whole_trials"] = WholeTrialsRecord(d);
  record["trace_faults"] = TraceFaultsRecord(d.problem, dataset);
  record["warnings"] = d.warnings;
  record["notes"] = d.notes;
  record["interrupted"] = d.interrupted || d.cut_short;
  record["tools"] = ToolsRecord();
  return record;
}

}  // namespace hoplab
