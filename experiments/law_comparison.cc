#include "experiments/law_comparison.h"

#include "fitting/model_of_spec.h"

namespace hoplab {

std::vector<Variant> AllLaws(const Dataset& dataset) {
  std::vector<Variant> variants;
  for (Law law : LawsOf(dataset.mechanism.type)) variants.push_back({std::string(NameOf(law)), {}});
  return variants;
}

LawComparison CompareLaws(const Dataset& dataset, const std::vector<Variant>& variants,
                          const ProblemOptions& problem_options, const FitOptions& fit_options,
                          Segmentation span, const std::function<void(int done)>& progress) {
  LawComparison comparison;
  for (const Variant& variant : variants) {
    if (fit_options.stop && *fit_options.stop) break;
    ProblemOptions options = problem_options;
    options.law = variant.law;
    options.with_effects = variant.with_effects;
    VariantResult row{variant, FitDataset(dataset, options, fit_options, span), {}, {}, {}};
    const FitProblem& problem = row.fit.problem;
    const FitResult& result = row.fit.result;
    if (result.ok) {
      row.uncertainty =
          AssessUncertainty(problem, TrialsOf(problem, TrialRole::kTrain), result.shared,
                            result.starts, fit_options.loss, fit_options.jobs);
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
