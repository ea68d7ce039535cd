#include "app/records/diagnosis_record.h"

#include <algorithm>
#include <cmath>

#include "app/records/cause_record.h"
#include "app/records/diagnosis_words.h"
#include "app/records/fit_words.h"
#include "app/records/record_parts.h"
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

Json TestsRecord(const Detection& detection) {
  Json tests = Json::array();
  for (const DetectionTest& t : detection.tests) {
    const bool seen = t.dof > 0;
    tests.push_back({{"name", t.name},
                     {"statistic", seen ? NumberOrNull(t.statistic) : Json(nullptr)},
                     {"p_value", seen ? NumberOrNull(t.p_value) : Json(nullptr)},
                     {"dof", t.dof}});
  }
  return tests;
}

Json DetectionRecord(const Detection& detection) {
  if (detection.tests.empty()) {
    return {{"p_value", nullptr},
            {"tests", Json::array()},
            {"chi2", nullptr},
            {"degrees_of_freedom", nullptr}};
  }
  return {{"p_value", NumberOrNull(detection.p_value)},
          {"tests", TestsRecord(detection)},
          {"chi2", NumberOrNull(detection.chi2)},
          {"degrees_of_freedom", detection.degrees_of_freedom}};
}

Json PartsRecord(const std::vector<MisfitPart>& parts, const char* key, const auto& name) {
  Json out = Json::array();
  for (const MisfitPart& p : parts) {
    out.push_back({{key, name(p.index)},
                   {"share", NumberOrNull(p.share)},
                   {"rows", p.rows},
                   {"chi2", NumberOrNull(p.chi2)},
                   {"expected", NumberOrNull(p.expected)},
                   {"p_value", NumberOrNull(p.p_value)}});
  }
  return out;
}

std::string ChannelNameOf(const FitProblem& problem, int channel) {
  return std::string(NameOf(channel < 0
                                ? Channel::kContact
                                : problem.channels[static_cast<std::size_t>(channel)].channel));
}

Json LocalisationRecord(const Diagnosis& d) {
  Json out = Json::array();
  for (const MisfitCell& c : d.localisation.cells) {
    out.push_back({{"mode", NameOf(c.mode)},
                   {"phase", c.phase},
                   {"channel", ChannelNameOf(d.problem, c.channel)},
                   {"share", NumberOrNull(c.share)},
                   {"rows", c.rows},
                   {"chi2", NumberOrNull(c.chi2)},
                   {"expected", NumberOrNull(c.expected)},
                   {"p_value", NumberOrNull(c.p_value)}});
  }
  return out;
}

Json GainInterval(const std::optional<HeldOutGain>& gain) {
  return gain ? IntervalRecord(gain->ci95) : Json(nullptr);
}

Json RefitRecord(const CandidateResult& c, const std::optional<HeldOutGain>& gain) {
  if (!c.alone.ok()) return nullptr;
  Json parameters = Json::array();
  for (int i = 0; i < c.alone.problem.shared_count(); ++i) {
    const SharedParameter& s = c.alone.problem.shared[static_cast<std::size_t>(i)];
    parameters.push_back(
        {{"name", s.name}, {"unit", s.unit}, {"value", NumberOrNull(c.alone.shared[i])}});
  }
  return {{"parameters", parameters},
          {"heldout_gain", gain ? NumberOrNull(gain->nats_per_sample) : Json(nullptr)},
          {"ci95", GainInterval(gain)},
          {"gain_nats", NumberOrNull(c.gain)},
          {"at_bound", c.alone.AtPhysicalBound(0)}};
}

// One entry a parameter of the candidate's effect.
template <class Values>
Json ByEffectParameter(const Candidate& candidate, const Values& values) {
  Json out = Json::object();
  for (int i = 0; i < candidate.parameter_count(); ++i) {
    out[std::string(candidate.Parameter(i).name)] =
        i < values.size() ? NumberOrNull(values[i]) : Json(nullptr);
  }
  return out;
}

Json CandidatesRecord(const Diagnosis& d) {
  Json out = Json::array();
  for (std::size_t i = 0; i < d.naming.candidates.size(); ++i) {
    const CandidateResult& c = d.naming.candidates[i];
    const bool seen = c.score.rank > 0;
    const std::optional<HeldOutGain> gain =
        i < d.candidate_gains.size() ? d.candidate_gains[i] : std::nullopt;
    out.push_back({{"effect", c.candidate.effect->info.name},
                   {"score", seen ? NumberOrNull(c.score.score) : Json(nullptr)},
                   {"p_value", seen ? NumberOrNull(c.score.p_value) : Json(nullptr)},
                   {"predicted_gain", seen ? NumberOrNull(c.score.predicted_gain) : Json(nullptr)},
                   {"refit", RefitRecord(c, gain)},
                   {"only_in_trial", TextOrNull(c.candidate.only_recording)},
                   {"status", NameOf(c.status)},
                   {"gain_nats", c.alone.ok() ? NumberOrNull(c.gain) : Json(nullptr)},
                   {"probability", NumberOrNull(c.probability)},
                   {"power", NumberOrNull(c.power)},
                   {"separable", c.separable},
                   {"expected_size", ByEffectParameter(c.candidate, c.score.size)},
                   {"bound95", ByEffectParameter(c.candidate, c.bound95)}});
  }
  return out;
}

// Errors on the held-out trials; nulls where there are none.
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

Json ExtensionRecord(const Diagnosis& d) {
  if (!d.extension) return nullptr;
  const ExtensionReport& e = *d.extension;
  const Extension& best = d.naming.best;
  Json before = Json::object(), after = Json::object();
  for (const Movement& m : e.movements) {
    before[m.name] = NumberOrNull(m.before);
    after[m.name] = NumberOrNull(m.after);
  }
  return {{"parameters", ParametersRecord({&best.problem, &best.shared, &e.uncertainty})},
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
          {"chi2_per_dof", NumberOrNull(e.uncertainty.chi2_per_dof)},
          {"misfit", e.uncertainty.misfit},
          {"remainder", DetectionRecord(e.remainder)},
          {"trials", TrialsRecord(best.problem, e.after.trials)},
          {"mechanism",
           FittedMechanismRecord({&best.problem, &best.shared, &e.after.trials, "after"})}};
}

Json SettingsRecord(const TrialDesign& design) {
  return {{"like", design.like},
          {"touchdown_angle_rad", NumberOrNull(design.touchdown_angle)},
          {"height_m", NumberOrNull(design.height)},
          {"speed_m_per_s", NumberOrNull(design.speed)},
          {"kp_N_s", NumberOrNull(design.kp)}};
}

// The best trial found, whether or not it would settle anything.
Json SearchRecord(const Diagnosis& d) {
  if (!d.experiment) return nullptr;
  const SeparatingExperiment& e = *d.experiment;
  return {{"description", Describe(e.design)},
          {"settings", SettingsRecord(e.design)},
          {"expected_nats", NumberOrNull(e.expected_nats)},
          {"closest_rival", e.closest_rival},
          {"designs_tried", e.designs_tried},
          {"separates", e.Separates()}};
}

Json ExperimentRecord(const Diagnosis& d) {
  if (!d.experiment || !d.experiment->Separates()) return nullptr;
  return {{"description", Describe(d.experiment->design)},
          {"settings", SettingsRecord(d.experiment->design)},
          {"expected_nats", NumberOrNull(d.experiment->expected_nats)},
          {"closest_rival", d.experiment->closest_rival}};
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

}  // namespace

Json HeldOutRecord(const FitProblem& problem, const HeldOutErrors& errors) {
  Json record = RoleRecord(problem, errors.trials, TrialRole::kTest);
  const FeatureErrors& f = errors.features;
  const auto computed = [&](double value) {
    return errors.trials.empty() ? Json(nullptr) : NumberOrNull(value);
  };
  record["apex_height_rmse_m"] = computed(f.apex_height_rmse);
  record["apex_time_rmse_s"] = computed(f.apex_time_rmse);
  record["touchdown_time_rmse_s"] = computed(f.touchdown_time_rmse);
  record["stance_time_rmse_s"] = computed(f.stance_time_rmse);
  return record;
}

Json ForceRecord(const ReconstructedForce& f) {
  Json points = Json::array(), terms = Json::array();
  for (const ForcePoint& p : f.points) {
    points.push_back({{"at", NumberOrNull(p.at)},
                      {"value", NumberOrNull(p.value)},
                      {"band95", NumberOrNull(p.band95)}});
  }
  for (const RegressionTerm& t : f.terms) {
    terms.push_back({{"term", t.term},
                     {"coefficient", NumberOrNull(t.coefficient)},
                     {"inclusion", NumberOrNull(t.inclusion)}});
  }
  return {{"name", f.group.name},
          {"against", TextOrNull(f.group.against)},
          {"unit", f.group.unit},
          {"score", NumberOrNull(f.score)},
          {"p_value", NumberOrNull(f.p_value)},
          {"points", points},
          {"terms", terms}};
}

Json ForcesRecord(const std::optional<FreeForces>& free_forces) {
  if (!free_forces) return nullptr;
  Json out = Json::array();
  for (const ReconstructedForce& f : free_forces->forces) out.push_back(ForceRecord(f));
  return out;
}

Json DiagnosisRecord(const Dataset& dataset, const std::string& dataset_argument,
                     const DiagnosisOptions& options, const DiagnosisRun& run) {
  const Diagnosis& d = run.diagnosis;
  RecordHeader header;
  header.command = "diagnose";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(d.problem.law));
  header.seed = options.fit.seed;
  header.options = ResolvedOptions(dataset_argument, options, d);
  Json record = NewRecord(header);
  const std::string failure = run.Failure();
  if (!failure.empty()) SetFailed(record, failure);

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
  record["only_in_trial"] = caused_by ? TextOrNull(caused_by->only_recording) : Json(nullptr);
  record["group"] = NamesOf(d, has_cause ? GroupOfCause(d) : std::vector<int>());
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
  record["null"] = NullRecord(d);
  record["free_forces"] = ForcesRecord(d.free_forces);
  record["energy"] = EnergyRecord(run.energy);
  record["penalty_nats"] = d.naming.log_odds > 0.0 ? Json(d.naming.log_odds) : Json(nullptr);
  record["causes"] = CausesRecord(d);
  record["probability_unlisted"] = NumberOrNull(d.UnlistedProbability());
  record["left"] = LeftRecord(d.naming.best.problem);
  record["left_share"] = NumberOrNull(d.left.share);
  record["posterior"] = PosteriorRecord(d);
  record["discrepancy"] = {{"before", LeftRecord(d.null.problem)},
                           {"probability", NumberOrNull(d.left.probability)}};
  record["refits"] = d.naming.refits;
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
      {"gradients", CertificateLine(d.gate.certificate)}};
  record["mechanism"] =
      FittedMechanismRecord({&d.problem, &d.null.shared, &d.before.trials, "before"});
  record["fitted"] = d.by_hop ? "single hops" : "whole traces";
  record["notes"] = d.notes;
  record["interrupted"] = d.interrupted;
  record["tools"] = ToolsRecord();
  return record;
}

}  // namespace hoplab
