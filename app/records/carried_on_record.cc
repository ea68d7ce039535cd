#include "app/records/carried_on_record.h"

#include <fmt/format.h>

#include <vector>

#include "app/records/diagnosis_parts.h"
#include "app/records/diagnosis_words.h"
#include "app/records/record_parts.h"
#include "app/terminal/quantity.h"
#include "base/channel.h"
#include "base/text.h"

namespace hoplab {
namespace {

constexpr double kFarOff = 10.0;  // chi2 a sample: three times the noise

double Chi2PerSample(const FittedModel& model) {
  long samples = 0;
  for (const TrialProblem& t : TrialsOf(model.problem, TrialRole::kTrain))
    samples += t.sample_count;
  return 2.0 * model.cost / static_cast<double>(samples);
}

}  // namespace

std::string WholeTrialsSentence(const CarriedOn& carried) {
  if (!carried.stop.IsMinimum())
    return "with it the simulation does not follow them, so something else may show later: " +
           carried.stop.faults.front();
  const FitProblem& problem = carried.model.problem;
  std::vector<std::string> errors;
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    const std::string name(NameOf(problem.channels[c].channel));
    errors.push_back(WithoutUnit(name) + " " +
                     ErrorText(carried.errors.test.rmse[c], ChannelUnit(*ChannelFromName(name))));
  }
  const double chi2 = Chi2PerSample(carried.model);
  const char* how = chi2 < kFarOff
                        ? "follows them to their end"
                        : "runs to their end, but so far from them that its values say little";
  return fmt::format(
      "with it the simulation {}: {}{}; test error {}; chi2 {:.3g} a sample", how,
      ValuesText(problem, carried.model.shared, carried.uncertainty),
      problem.noise.IsWhite()
          ? ""
          : " (a smooth error is left, so the intervals hold those of the first parts, too)",
      Join(errors), chi2);
}

Json WholeTrialsRecord(const Diagnosis& diagnosis) {
  if (!diagnosis.carried_on) return nullptr;
  const CarriedOn& carried = *diagnosis.carried_on;
  const bool followed = carried.stop.IsMinimum();
  const FitProblem& problem = carried.model.problem;
  return {
      {"followed", followed},
      {"faults", carried.stop.faults},
      {"parameters", ParametersRecord({&problem, followed ? &carried.model.shared : nullptr,
                                       followed ? &carried.uncertainty : nullptr})},
      {"test", HeldOutRecord(problem, carried.errors)},
      {"chi2_per_sample", followed ? NumberOrNull(Chi2PerSample(carried.model)) : Json(nullptr)},
      {"sentence", WholeTrialsSentence(carried)}};
}

}  // namespace hoplab
