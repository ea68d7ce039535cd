#include "app/fit_record.h"

#include <cmath>

#include "app/version.h"

namespace hoplab {
namespace {

Json IntervalRecord(const std::optional<std::pair<double, double>>& interval) {
  if (!interval) return nullptr;
  return Json::array({NumberOrNull(interval->first), NumberOrNull(interval->second)});
}

// Values by the shared parameters' names.
template <class Values>
Json ByParameter(const FitProblem& problem, const Values& values) {
  Json out = Json::object();
  for (int i = 0; i < problem.shared_count(); ++i)
    out[problem.shared[i].name] = NumberOrNull(values[i]);
  return out;
}

Json ByChannel(const FitProblem& problem, const std::vector<double>& values) {
  Json out = Json::object();
  for (std::size_t c = 0; c < problem.channels.size(); ++c)
    out[std::string(NameOf(problem.channels[c].channel))] =
        c < values.size() ? NumberOrNull(values[c]) : Json(nullptr);
  return out;
}

Json StateRecord(const std::array<double, 4>& state) {
  return {{"x_m", NumberOrNull(state[0])},
          {"y_m", NumberOrNull(state[1])},
          {"vx_m_per_s", NumberOrNull(state[2])},
          {"vy_m_per_s", NumberOrNull(state[3])}};
}

Json ParametersRecord(const FitRun& run) {
  Json out = Json::array();
  for (int i = 0; i < run.problem.shared_count(); ++i) {
    const SharedParameter& s = run.problem.shared[i];
    const ParameterUncertainty none;
    const ParameterUncertainty& u = run.uncertainty ? run.uncertainty->parameters[i] : none;
    const Json found = run.has_result ? NumberOrNull(run.fit.shared[i]) : Json(nullptr);
    const bool determined = run.has_result && !run.Undetermined(i);
    out.push_back({{"name", s.name},
                   {"unit", s.unit},
                   // An undetermined value is where the search happened to stop: no estimate.
                   {"value", determined ? found : Json(nullptr)},
                   {"std_error", NumberOrNull(u.std_error)},
                   {"ci95", IntervalRecord(u.ci95)},
                   {"initial", NumberOrNull(s.initial)},
                   {"at_bound", u.at_bound},
                   {"determined", determined},
                   {"ended_at", found},
                   {"std_error_between_trials", NumberOrNull(u.std_error_between_trials)},
                   {"ci95_between_trials", IntervalRecord(u.ci95_between_trials)},
                   {"bounds", Json::array({s.lower, s.upper})},
                   {"scale", s.scale}});
  }
  return out;
}

Json RoleRecord(const FitRun& run, TrialRole role) {
  if (run.trials.empty()) {
    return {{"rmse", ByChannel(run.problem, {})},
            {"nll_per_sample", nullptr},
            {"samples", nullptr},
            {"trials", nullptr},
            {"incomplete", nullptr}};
  }
  const RoleErrors errors = Summarise(run.problem, run.trials, role);
  return {{"rmse", ByChannel(run.problem, errors.rmse)},
          {"nll_per_sample", NumberOrNull(errors.nll_per_sample)},
          {"samples", errors.samples},
          {"trials", errors.trials},
          {"incomplete", errors.incomplete}};
}

Json TrialsRecord(const FitRun& run) {
  Json out = Json::array();
  for (const TrialErrors& trial : run.trials) {
    Json hops = Json::array();
    for (const HopErrors& hop : trial.hops) {
      hops.push_back(
          {{"begin_s", hop.begin}, {"end_s", hop.end}, {"rmse", ByChannel(run.problem, hop.rmse)}});
    }
    out.push_back({{"file", trial.file},
                   {"role", RoleName(trial.role)},
                   {"outcome", NameOf(trial.outcome)},
                   {"rmse", ByChannel(run.problem, trial.rmse)},
                   {"nll_per_sample", NumberOrNull(trial.nll_per_sample)},
                   {"chi2", trial.complete ? NumberOrNull(trial.chi2) : Json(nullptr)},
                   {"samples", trial.samples},
                   {"complete", trial.complete},
                   {"end_time_s", NumberOrNull(trial.end_time)},
                   {"start", StateRecord(trial.start)},
                   {"max_flexure", NumberOrNull(trial.max_flexure)},
                   {"hops", hops}});
  }
  return out;
}

Json StartsRecord(const FitRun& run) {
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

Json MatrixRecord(const FitProblem& problem, const Eigen::MatrixXd& matrix) {
  Json out = Json::object();
  for (int i = 0; i < problem.shared_count(); ++i)
    out[problem.shared[i].name] = ByParameter(problem, matrix.row(i));
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

}  // namespace

Json IdentifiabilityRecord(const FitProblem& problem, const Identifiability& identifiability) {
  Json weak = Json::array();
  for (const WeakDirection& direction : identifiability.weak_directions) {
    weak.push_back({{"eigenvalue", NumberOrNull(direction.eigenvalue)},
                    {"loadings", ByParameter(problem, direction.loadings)}});
  }
  return {{"condition_number", NumberOrNull(identifiability.condition_number)},
          {"weak_directions", weak},
          {"rank", identifiability.rank}};
}

Json CertificateRecord(const std::optional<GradientCertificate>& certificate) {
  if (!certificate) return {{"max_relative_error", nullptr}, {"worst_parameter", nullptr}};
  Json columns = Json::array(), flags = Json::array();
  for (const CertificateColumn& c : certificate->columns) {
    columns.push_back(
        {{"name", c.name}, {"trial", c.trial}, {"relative_error", NumberOrNull(c.relative_error)}});
  }
  for (const CertificateFlag& f : certificate->flags)
    flags.push_back({{"trial", f.trial}, {"text", f.text}});
  const bool checked = std::isfinite(certificate->max_relative_error);
  return {{"max_relative_error", NumberOrNull(certificate->max_relative_error)},
          {"worst_parameter", checked ? Json(certificate->worst_parameter) : Json(nullptr)},
          {"columns", columns},
          {"flags", flags}};
}

Json ChannelsRecord(const FitProblem& problem) {
  Json out = Json::array();
  for (const ChannelProblem& c : problem.channels) {
    out.push_back({{"name", NameOf(c.channel)},
                   {"sigma", NumberOrNull(c.sigma)},
                   {"sigma_estimated", c.sigma_estimated}});
  }
  if (problem.uses_contact)
    out.push_back(
        {{"name", NameOf(Channel::kContact)}, {"sigma", nullptr}, {"sigma_estimated", false}});
  return out;
}

Json ToolsRecord() {
  Json tools = Json::object();
  for (const auto& [name, version] : LibraryVersions()) tools[name] = version;
  return tools;
}

Json OptionsRecord(const std::string& dataset_argument, const FitProblem& problem,
                   const FitRunOptions& options) {
  Json fix = Json::object();
  for (const auto& [name, value] : options.problem.fix) fix[name] = value;
  return {{"dataset", dataset_argument},
          {"law", NameOf(problem.law)},
          {"free", problem.shared_names()},
          {"fix", fix},
          {"with", options.problem.with_effects},
          {"starts", options.fit.starts},
          {"seed", options.fit.seed},
          {"strategy", NameOf(options.fit.strategy)},
          {"span", NameOf(options.span)},
          {"loss", options.fit.loss.kind == LossKind::kSquared ? "squared" : "pseudo_huber"},
          {"loss_scale", options.fit.loss.scale},
          {"max_iterations", options.fit.max_iterations},
          {"profile", options.profile},
          {"integrator", NameOf(problem.integrator.kind)},
          {"relative_tolerance", problem.integrator.relative_tolerance},
          {"absolute_tolerance", problem.integrator.absolute_tolerance}};
}

Json FitRecord(const Dataset& dataset, const std::string& dataset_argument,
               const FitRunOptions& options, const FitRun& run) {
  RecordHeader header;
  header.command = "fit";
  header.dataset = dataset.name;
  header.law = std::string(NameOf(run.problem.law));
  header.seed = options.fit.seed;
  header.options = OptionsRecord(dataset_argument, run.problem, options);
  Json record = NewRecord(header);
  if (const std::string failure = run.Failure(); !failure.empty()) SetFailed(record, failure);

  record["parameters"] = ParametersRecord(run);
  record["train"] = RoleRecord(run, TrialRole::kTrain);
  record["test"] = RoleRecord(run, TrialRole::kTest);
  record["trials"] = TrialsRecord(run);
  record["identifiability"] =
      run.uncertainty
          ? IdentifiabilityRecord(run.problem, run.uncertainty->identifiability)
          : Json{{"condition_number", nullptr}, {"weak_directions", nullptr}, {"rank", nullptr}};
  record["gradient_check"] = CertificateRecord(run.certificate);
  record["starts"] = StartsRecord(run);
  record["best_start"] = run.has_result ? Json(run.fit.best_start) : Json(nullptr);
  record["cost"] = run.has_result ? NumberOrNull(run.fit.cost) : Json(nullptr);
  record["interrupted"] = run.interrupted;
  const bool assessed = run.uncertainty.has_value();
  record["chi2_per_dof"] = assessed ? NumberOrNull(run.uncertainty->chi2_per_dof) : Json(nullptr);
  record["chi2_p_value"] = assessed ? NumberOrNull(run.uncertainty->chi2_p_value) : Json(nullptr);
  record["misfit"] = assessed ? Json(run.uncertainty->misfit) : Json(nullptr);
  record["covariance"] =
      assessed ? MatrixRecord(run.problem, run.uncertainty->covariance) : Json(nullptr);
  record["correlation"] =
      assessed ? MatrixRecord(run.problem, run.uncertainty->correlation) : Json(nullptr);
  record["profiles"] = ProfilesRecord(run);
  record["channels"] = ChannelsRecord(run.problem);
  record["fitted"] = run.by_hop ? "single hops" : "whole traces";
  record["warnings"] = run.check.warnings;
  record["notes"] = run.check.notes;
  if (!run.note.empty()) record["notes"].push_back(run.note);
  record["tools"] = ToolsRecord();
  return record;
}

}  // namespace hoplab
