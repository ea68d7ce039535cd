#include "experiments/law_comparison.h"

#include "fitting/model_of_spec.h"

namespace hoplab {

std::vector<ComparedModel> AllLaws(const Dataset& dataset) {
  std::vector<ComparedModel> models;
  for (Law law : LawsOf(dataset.mechanism.type)) models.push_back({std::string(NameOf(law)), {}});
  return models;
}

ProblemOptions OptionsOf(const ComparedModel& model, ProblemOptions options) {
  options.law = model.law;
  options.with_effects = model.with_effects;
  return options;
}

LawComparison CompareLaws(const Dataset& dataset, const std::vector<ComparedModel>& models,
                          const ProblemOptions& problem_options, const FitOptions& fit_options,
                          Segmentation span, const std::function<void(int done)>& progress) {
  LawComparison comparison;
  for (const ComparedModel& model : models) {
    if (fit_options.IsStopped()) break;
    ModelResult row{model,
                    FitDataset(dataset, OptionsOf(model, problem_options), fit_options, span),
                    {},
                    {},
                    {}};
    const FitProblem& problem = row.fit.problem;
    const FitResult& result = row.fit.result;
    if (result.ok) {
      row.uncertainty =
          AssessUncertainty(problem, TrialsOf(problem, TrialRole::kTrain), result.shared,
                            result.initial_states, fit_options.loss, fit_options.jobs);
      const std::vector<TrialErrors> errors = AssessTrials(problem, result, fit_options);
      row.train = Summarise(problem, errors, TrialRole::kTrain);
      row.test = Summarise(problem, errors, TrialRole::kTest);
    }
    comparison.rows.push_back(std::move(row));
    if (progress) progress(static_cast<int>(comparison.rows.size()));
  }
  return comparison;
}

}  // namespace hoplab
