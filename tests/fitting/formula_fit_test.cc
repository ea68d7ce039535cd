#include <gtest/gtest.h>

#include <filesystem>

#include "fitting/diagnosis/candidate.h"
#include "fitting/fit_dataset.h"
#include "fitting/generate.h"
#include "fitting/model_of_spec.h"
#include "fitting/uncertainty.h"
#include "tests/support/hop_scenarios.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using namespace testing;
namespace fs = std::filesystem;

const fs::path kFolder = fs::path(HOPLAB_SOURCE_DIR) / "experiments/effects";

std::vector<std::string> Examples() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (IsEffectFile(entry.path().string())) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// Data with the effect at its typical size.
Dataset DatasetWith(const std::string& file) {
  Scenario s = HopScenario(2);
  EffectSpec spec;
  spec.formula = ReadEffectFile(kFolder / file);
  spec.name = spec.formula->source.name;
  spec.at_typical = true;
  s.effects = {spec};
  GenerateOptions options;
  options.seed = 4;
  return GenerateDataset(s, options).dataset;
}

class WorkedExample : public ::testing::TestWithParam<std::string> {};

TEST_P(WorkedExample, IsGeneratedAndFoundAgain) {
  const Dataset dataset = DatasetWith(GetParam());
  const Effect& effect = EffectOfFile(ReadEffectFile(kFolder / GetParam()));
  ProblemOptions options;
  options.with_effects = {(kFolder / GetParam()).string()};
  const DatasetFit fit = FitDataset(dataset, options, {});
  ASSERT_TRUE(fit.result.ok) << fit.result.message;
  const std::vector<TrialProblem> train = TrialsOf(fit.problem, TrialRole::kTrain);
  const Uncertainty known =
      AssessUncertainty(fit.problem, train, fit.result.shared, fit.result.initial_states, {}, 1);
  int fitted = 0;
  for (int i = 0; i < fit.problem.shared_count(); ++i) {
    const SharedParameter& s = fit.problem.shared[i];
    if (s.direction.of != SensitivityDirection::Of::kEffect) continue;
    ++fitted;
    const EffectParameter& p = effect.info.parameters[s.direction.component];
    EXPECT_FALSE(p.is_shape);
    ASSERT_TRUE(known.parameters[i].std_error) << s.name;
    const double off = std::abs(fit.result.shared[i] - p.null - p.typical);
    EXPECT_LT(off, 4.0 * *known.parameters[i].std_error) << s.name;
    EXPECT_LT(*known.parameters[i].std_error, p.typical) << "the data say nothing of " << s.name;
  }
  EXPECT_EQ(fitted, 1);
}

INSTANTIATE_TEST_SUITE_P(Effects, WorkedExample, ::testing::ValuesIn(Examples()),
                         [](const auto& info) {
                           std::string name = info.param.substr(0, info.param.find('.'));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(FormulaInAProblem, AShapeIsFreedByItsName) {
  const Dataset dataset = DatasetWith("umbilical.yaml");
  ProblemOptions options;
  options.with_effects = {(kFolder / "umbilical.yaml").string()};
  options.free = {"E", "d", "umbilical.x_end"};
  const FitProblem problem = MakeProblem(dataset, options);
  EXPECT_EQ(problem.shared_names(),
            (std::vector<std::string>{"E", "d", "umbilical.x_end", "umbilical.k"}));
  EXPECT_EQ(problem.shared[2].initial, 0.5);
  EXPECT_EQ(problem.effects[0].values[1], 0.5);
}

TEST(FormulaInAProblem, TheDatasetsOwnIsACandidateAmongTheCatalogue) {
  Dataset dataset = DatasetWith("umbilical.yaml");
  dataset.effects = {ReadEffectFile(kFolder / "umbilical.yaml")};
  const FitProblem problem = MakeProblem(dataset, {});
  EXPECT_TRUE(problem.effects.empty()) << "known, not asked for";
  const std::vector<Candidate> all = CandidatesOf(problem, {});
  EXPECT_EQ(std::count_if(all.begin(), all.end(),
                          [](const Candidate& c) { return c.Name() == "umbilical"; }),
            1);
  EXPECT_EQ(all.back().parameter_count(), 1) << "x_end only shapes it";
  const std::vector<Candidate> only = CandidatesOf(problem, {.only = {"umbilical", "air_drag"}});
  EXPECT_EQ(only.size(), 2u);
  ProblemOptions by_name;
  by_name.with_effects = {"umbilical"};
  EXPECT_EQ(MakeProblem(dataset, by_name).shared.back().name, "umbilical.k");
}

// Of what was found the sign is known, and the steps of a search have none.
TEST(FormulaInAProblem, ATypicalSizeMayBeNegative) {
  const std::string text =
      "format: hoplab-effect/1\nname: cable\nacts_as: body_force_x\nformula: \"c * x\"\n"
      "parameters:\n  c: {unit: N/m, null: 0, lower: -200, upper: 200, typical: -2}\n";
  const FormulaSource source = ParseEffectFile(text, "cable.yaml").source;
  Dataset dataset = DatasetWith("umbilical.yaml");
  dataset.effects = {ReadEffectFile(kFolder / "umbilical.yaml")};
  dataset.effects[0].source = source;
  ProblemOptions options;
  options.with_effects = {"cable"};
  const FitProblem problem = MakeProblem(dataset, options);
  EXPECT_EQ(problem.shared.back().scale, 2.0);
  const Candidate candidate(problem.effects.front().effect);
  const FitProblem extended =
      Extend(MakeProblem(DatasetWith("umbilical.yaml"), {}), {&candidate, 1});
  EXPECT_EQ(extended.shared.back().scale, 2.0);
}

TEST(FormulaInAProblem, TwoOfOneNameAreRefused) {
  Dataset dataset = DatasetWith("umbilical.yaml");
  dataset.effects = {ReadEffectFile(kFolder / "umbilical.yaml"),
                     ReadEffectFile(kFolder / "umbilical.yaml")};
  EXPECT_NO_THROW(MakeProblem(dataset, {})) << "the same file twice is one effect";
  dataset.effects[1].source.formula = "-k * max(x - 2 * x_end, 0)";
  EXPECT_THROW(MakeProblem(dataset, {}), InputError);
}

TEST(FormulaInAProblem, AMistakeIsToldWithItsLineAndACaret) {
  const std::string text =
      "format: hoplab-effect/1\nname: cable\nacts_as: body_force_x\n"
      "formula: \"-k * max(xx - x_end, 0)\"\n"
      "parameters:\n  k: {unit: N/m, null: 0, lower: 0, upper: 200, typical: 2}\n"
      "  x_end: {unit: m, value: 0.5, lower: -10, upper: 10}\n";
  try {
    EffectOfFile(ParseEffectFile(text, "cable.yaml"));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.parts().place, "cable.yaml:4");
    EXPECT_NE(e.parts().value.find("xx"), std::string::npos);
    EXPECT_NE(e.parts().remedy.find("Did you mean x?"), std::string::npos) << e.parts().remedy;
    EXPECT_NE(e.parts().remedy.find("\n             ^~"), std::string::npos) << e.parts().remedy;
  }
}

}  // namespace
}  // namespace hoplab
