#include "app/records/record_parts.h"

#include <algorithm>
#include <cmath>

#include "app/records/formula_words.h"
#include "app/version.h"
#include "model/formula/formula_effect.h"

namespace hoplab {
namespace {

Json StateRecord(const Eigen::VectorXd& state) {
  return {{"x_m", NumberOrNull(state[0])},
          {"y_m", NumberOrNull(state[1])},
          {"vx_m_per_s", NumberOrNull(state[2])},
          {"vy_m_per_s", NumberOrNull(state[3])}};
}

// All values that a trial has of its own, by name, each in its own unit.
Json OwnRecord(const TrialProblem& trial, const OwnValues& values) {
  Json out = Json::object();
  for (int k = 0; k < std::min<int>(trial.own_count(), static_cast<int>(values.size())); ++k)
    out[trial.own[static_cast<std::size_t>(k)].name] = NumberOrNull(values[k]);
  return out;
}

// Leg angle that the first touch-down of a trial is commanded at [rad].
double FirstAngle(const TrialProblem& trial) {
  if (!trial.touchdown_angles.empty()) return trial.touchdown_angles.front();
  const double first = trial.parameters.start_angle;
  return std::isnan(first) ? trial.parameters.theta_td : first;
}

}  // namespace

Json IntervalRecord(const std::optional<std::pair<double, double>>& interval) {
  if (!interval) return nullptr;
  return Json::array({NumberOrNull(interval->first), NumberOrNull(interval->second)});
}

Json ByChannel(const FitProblem& problem, const std::vector<double>& values) {
  Json out = Json::object();
  for (std::size_t c = 0; c < problem.channels.size(); ++c)
    out[std::string(NameOf(problem.channels[c].channel))] =
        c < values.size() ? NumberOrNull(values[c]) : Json(nullptr);
  return out;
}

Json ParametersRecord(const FittedValues& fitted) {
  const FitProblem& problem = *fitted.problem;
  Json out = Json::array();
  for (int i = 0; i < problem.shared_count(); ++i) {
    const SharedParameter& s = problem.shared[i];
    const ParameterUncertainty none;
    const ParameterUncertainty& u = fitted.uncertainty ? fitted.uncertainty->parameters[i] : none;
    const Json found = fitted.shared ? NumberOrNull((*fitted.shared)[i]) : Json(nullptr);
    const bool determined = fitted.shared && (u.std_error || u.at_bound);
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
    if (u.ci95_given_model) out.back()["ci95_given_model"] = IntervalRecord(u.ci95_given_model);
  }
  return out;
}

Json RoleRecord(const FitProblem& problem, const std::vector<TrialErrors>& trials, TrialRole role) {
  if (trials.empty()) {
    return {{"rmse", ByChannel(problem, {})},
            {"nll_per_sample", nullptr},
            {"samples", nullptr},
            {"trials", nullptr},
            {"incomplete", nullptr}};
  }
  const RoleErrors errors = Summarise(problem, trials, role);
  return {{"rmse", ByChannel(problem, errors.rmse)},
          {"nll_per_sample", NumberOrNull(errors.nll_per_sample)},
          {"samples", errors.samples},
          {"trials", errors.trials},
          {"incomplete", errors.incomplete}};
}

Json TrialsRecord(const FitProblem& problem, const std::vector<TrialErrors>& trials) {
  Json out = Json::array();
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialErrors& trial = trials[i];
    const double begin = problem.trials[i].begin_s;  // times are those of the trial's file
    Json hops = Json::array();
    for (const HopErrors& hop : trial.hops) {
      hops.push_back({{"begin_s", hop.begin + begin},
                      {"end_s", hop.end + begin},
                      {"rmse", ByChannel(problem, hop.rmse)}});
    }
    out.push_back({{"file", trial.file},
                   {"role", RoleName(trial.role)},
                   {"outcome", NameOf(trial.outcome)},
                   {"rmse", ByChannel(problem, trial.rmse)},
                   {"nll_per_sample", NumberOrNull(trial.nll_per_sample)},
                   {"chi2", trial.complete ? NumberOrNull(trial.chi2) : Json(nullptr)},
                   {"samples", trial.samples},
                   {"complete", trial.complete},
                   {"end_time_s", NumberOrNull(trial.end_time + begin)},
                   {"start", StateRecord(trial.start)},
                   {"own_values", OwnRecord(problem.trials[i], trial.start)},
                   {"touchdown_angle_rad", NumberOrNull(FirstAngle(problem.trials[i]))},
                   {"max_flexure", NumberOrNull(trial.max_deflection_ratio)},
                   {"hops", hops}});
  }
  return out;
}

void RecordSpan(bool by_hop, std::optional<double> until, Json& record) {
  record["fitted"] = by_hop ? "single hops" : until ? "first parts" : "whole traces";
  record["fitted_until_s"] = until ? NumberOrNull(*until) : Json(nullptr);
}

Json MatrixRecord(const FitProblem& problem, const Eigen::MatrixXd& matrix) {
  Json out = Json::object();
  for (int i = 0; i < problem.shared_count(); ++i)
    out[problem.shared[i].name] = ByParameter(problem, matrix.row(i));
  return out;
}

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

Json TraceFaultsRecord(const FitProblem& problem, const Dataset& dataset) {
  Json out = Json::array();
  for (const TraceFault& fault : problem.trace_faults) {
    const Trial& trial = dataset.trials[fault.trial];
    Json times = Json::array();
    for (const std::size_t row : fault.rows) times.push_back(trial.trace.time_s[row]);
    out.push_back({{"kind", NameOf(fault.kind)},
                   {"file", trial.file},
                   {"channel", ChannelName(fault.channel)},
                   {"unit", ChannelUnit(fault.channel)},
                   {"times_s", std::move(times)},
                   {"largest", fault.largest},
                   {"compared", problem.keeps_stray}});
  }
  return out;
}

Json KnownRecord(const FitProblem& problem) {
  Json out = Json::array();
  for (const KnownParameter& known : problem.known.parameters()) {
    const EffectParameter& p =
        known.effect->info.parameters[static_cast<std::size_t>(known.parameter)];
    out.push_back({{"effect", known.effect->info.name},
                   {"parameter", p.name},
                   {"unit", p.unit},
                   {"at_most", known.at_most}});
  }
  return out;
}

Json FormulaRecord(const Effect& effect) {
  const FormulaSource& source = *SourceOf(effect);
  const PlaceInfo& place = InfoOf(effect.formula->place());
  Json parameters = Json::array();
  for (const EffectParameter& p : effect.info.parameters)
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {p.is_shape ? "value" : "null", p.null},
                          {"bounds", Json::array({NumberOrNull(p.lower), NumberOrNull(p.upper)})},
                          {"typical", p.typical}});
  return {{"name", source.name},         {"acts_as", source.acts_as},
          {"symbol", place.symbol},      {"unit", place.unit},
          {"formula", source.formula},   {"mathml", MathMlOf(*effect.formula)},
          {"sentence", source.sentence}, {"parameters", parameters}};
}

Json FormulasRecord(const FitProblem& problem) {
  Json out = Json::array();
  for (const Effect* effect : problem.formulas) out.push_back(FormulaRecord(*effect));
  return out;
}

Json ToolsRecord() {
  Json tools = Json::object();
  for (const auto& [name, version] : LibraryVersions()) tools[name] = version;
  return tools;
}

Json LeftRecord(const FitProblem& problem) {
  Json out = Json::object();
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    const double amplitude = problem.noise.AmplitudeOf(c) * problem.channels[c].sigma;
    out[std::string(NameOf(problem.channels[c].channel))] = {
        {"amplitude", amplitude},
        {"time_scale_s", amplitude > 0.0 ? Json(problem.noise.time_scale) : Json(nullptr)}};
  }
  return out;
}

Json OptionsRecord(const FitProblem& problem, const FitConfiguration& configuration) {
  const FitOptions& fit = *configuration.fit;
  Json fix = Json::object();
  for (const auto& [name, value] : configuration.problem_options->fix) fix[name] = value;
  return {{"dataset", configuration.dataset_argument},
          {"law", NameOf(problem.law)},
          {"free", problem.shared_names()},
          {"fix", fix},
          {"with", configuration.problem_options->with_effects},
          {"keep_stray", configuration.problem_options->keep_stray},
          {"starts", fit.restarts},
          {"seed", fit.seed},
          {"strategy", NameOf(fit.strategy)},
          {"span", NameOf(configuration.span)},
          {"loss", fit.loss.kind == LossKind::kSquared ? "squared" : "pseudo_huber"},
          {"loss_scale", fit.loss.scale},
          {"discrepancy", NameOf(fit.discrepancy)},
          {"max_iterations", fit.max_iterations},
          {"integrator", NameOf(problem.integrator.kind)},
          {"relative_tolerance", problem.integrator.relative_tolerance},
          {"absolute_tolerance", problem.integrator.absolute_tolerance}};
}

Json TextOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json OneTrial(const Candidate& cause) {
  const Recordings& files = cause.only_recordings;
  return files.size() == 1 ? Json(files.front()) : Json(nullptr);
}

}  // namespace hoplab
