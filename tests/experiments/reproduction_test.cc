// Which tables, figures and claims there are, and that they come out the same whatever runs them.
#include "experiments/study/reproduction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "experiments/study/kinematics_items.h"
#include "tests/support/input_error_of.h"
#include "tests/support/study_cases.h"

namespace hoplab::testing {
namespace {

TEST(Reproduction, KnowsEveryTableFigureAndClaim) {
  std::set<std::string> expected = {"figure-3.5", "figure-3.6",  "figure-3.7", "figure-4.5",
                                    "figure-4.6", "claim-level", "claim-sign"};
  for (int i = 1; i <= 5; ++i) expected.insert("table-6." + std::to_string(i));
  for (int i = 5; i <= 34; ++i) expected.insert("figure-6." + std::to_string(i));
  for (char c = 'a'; c <= 'h'; ++c) expected.insert(std::string("claim-") + c);
  const std::vector<std::string> names = StudyItemNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), expected);
  EXPECT_EQ(names.size(), expected.size()) << "each once";
}

TEST(Reproduction, GroupsCoverAllItems) {
  EXPECT_EQ(ResolveStudyItems({"all"}), StudyItemNames());
  EXPECT_EQ(ResolveStudyItems({"tables", "figures", "claims"}), StudyItemNames());
  EXPECT_EQ(ResolveStudyItems({"kinematics"}),
            (std::vector<std::string>{"claim-level", "claim-sign", "figure-3.5", "figure-3.6",
                                      "figure-3.7"}));
}

TEST(Reproduction, ItemsComeOnceInAFixedOrder) {
  EXPECT_EQ(ResolveStudyItems({"claim-a", "table-6.5", "tables", "claim-a"}),
            ResolveStudyItems({"tables", "claim-a"}));
}

TEST(Reproduction, AnUnknownNameGetsTheNearestOne) {
  const std::string message = InputErrorOf([] { ResolveStudyItems({"figure-6.4"}); });
  EXPECT_NE(message.find("Did you mean figure-6.5?"), std::string::npos) << message;
  EXPECT_NE(InputErrorOf([] {
              ResolveStudyItems({"claims", "clam-a"});
            }).find("claim-a"),
            std::string::npos);
  EXPECT_NE(InputErrorOf([] { ResolveStudyItems({"nonsense"}); }).find("table-6.1"),
            std::string::npos);
}

ReproductionRequest Request(const std::vector<std::string>& items, int jobs) {
  ReproductionRequest request;
  request.study = MadeUpStudy();
  request.items = ResolveStudyItems(items);
  request.jobs = jobs;
  return request;
}

TEST(Reproduction, JobsDoNotChangeIt) {
  const std::vector<std::string> items = {"table-6.5", "figure-6.29", "figure-3.5", "claim-a"};
  const Reproduction one = Reproduce(Request(items, 1)), three = Reproduce(Request(items, 3));
  ASSERT_EQ(one.figures.size(), 2u);
  EXPECT_EQ(one.tables[0].rows, three.tables[0].rows);
  for (std::size_t f = 0; f < one.figures.size(); ++f) {
    for (std::size_t c = 0; c < one.figures[f].curves.size(); ++c)
      EXPECT_EQ(one.figures[f].curves[c].rows, three.figures[f].curves[c].rows);
  }
  EXPECT_EQ(one.claims[0].alternatives.size(), three.claims[0].alternatives.size());
}

TEST(Reproduction, WhatWasNotBegunIsNamed) {
  ReproductionRequest request = Request({"table-6.5", "figure-6.6", "figure-6.7"}, 1);
  std::atomic<bool> stop = false;
  request.stop = &stop;
  request.progress = [&](int, const std::string&) { stop = true; };
  const Reproduction reproduction = Reproduce(request);
  EXPECT_EQ(reproduction.tables.size(), 1u);
  EXPECT_EQ(reproduction.left_out, (std::vector<std::string>{"figure-6.6", "figure-6.7"}));
}

TEST(Kinematics, ThePitchKeepsItsSignOnlyBecauseTheFrontLegEnds) {
  const StudyClaim sign = RunKinematicsClaim("claim-sign", TwoLegs{}, 2);
  EXPECT_TRUE(sign.checks.at(0).holds);
  EXPECT_FALSE(sign.alternatives.at(0).holds.at(0));
  EXPECT_EQ(sign.verdict, StudyVerdict::kOnlyUnderSettings);
  TwoLegs circle;
  circle.front_stops_upright = false;
  EXPECT_EQ(RunKinematicsClaim("claim-sign", circle, 2).verdict, StudyVerdict::kOnlyUnderSettings);
  EXPECT_EQ(RunKinematicsClaim("claim-level", TwoLegs{}, 2).verdict, StudyVerdict::kReproduced);
}

TEST(Kinematics, SurfacesStandOnTheStudysGrid) {
  const StudyFigure surfaces = RunKinematicsFigure("figure-3.5", TwoLegs{}, 2);
  EXPECT_EQ(surfaces.kind, StudyFigure::Kind::kSurface);
  ASSERT_EQ(surfaces.curves.at(0).rows.size(), 49u);
  for (const std::vector<double>& row : surfaces.curves[0].rows) EXPECT_LE(row[2], row[3]);
}

}  // namespace
}  // namespace hoplab::testing
