#include "experiments/identification/identification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/experiments/study_hoppers.h"

namespace hoplab {
namespace {

using namespace testing;
using C = StudyConstant;

IdentificationRequest RequestFor(const StudyData& data, std::vector<StudyReading> readings) {
  IdentificationRequest request;
  request.context.data = data;
  request.context.convergence = {{}, {.speed = ConvergenceReading::Speed::kApex}};
  request.context.integrator.relative_tolerance = 1e-8;
  request.readings = std::move(readings);
  request.free = {C::kMass, C::kRadius,     C::kBendingStiffness,
                  C::kGain, C::kStartSpeed, C::kPlacedShare};
  request.budget = 1000;
  request.keep = 4;
  request.refine = 1;
  request.with_front = false;
  return request;
}

TEST(AllReadings, AreAllCombinationsOnce) {
  const std::vector<StudyReading> readings = AllReadings();
  EXPECT_EQ(readings.size(), 192U);  // 2^5 of two words, 3 damping rates, 2 lift-off rules
  for (std::size_t i = 0; i < readings.size(); ++i)
    EXPECT_EQ(std::count(readings.begin(), readings.end(), readings[i]), 1) << i;
  EXPECT_EQ(readings.front(), StudyReading());
}

// Tables made from constants and a reading that the identification is not told.
TEST(Identification, FindsTheReadingAndTheConstantsThatMadeTheTables) {
  StudyHopper truth = SomeHopper();
  truth.reading.law.stiffness_radius = ThesisReading::StiffnessRadius::kRest;
  std::vector<StudyReading> readings(2);
  readings[1] = truth.reading;
  IdentificationRequest request = RequestFor(TablesOf(truth, {}, 3), readings);
  request.keep = 2;
  const IdentificationResult result = Identify(request, ThreadedFits().On(request.context));
  EXPECT_EQ(result.by_energy.front().reading, truth.reading);
  EXPECT_LT(result.best_by_energy.scores.energy_rms, 0.002);
  const ScoredFit& best = result.by_all.front();
  EXPECT_EQ(best.fit.reading, truth.reading);
  EXPECT_EQ(best.convergence, ConvergenceReading());
  for (const C c : request.free)
    EXPECT_NEAR(At(best.fit.constants, c) / At(truth.constants, c), 1.0, 0.02) << InfoOf(c).name;
  EXPECT_LT(best.scores.stiffness_worst, 0.01);
  EXPECT_LT(best.scores.times[1].rms_s, 0.02);
  // The other readings do visibly worse on what the truth prints to a thousandth of a point.
  EXPECT_GT(result.by_energy[1].misfit, 10.0 * result.by_energy[0].misfit);
}

TEST(Identification, DoesNotDependOnTheNumberOfThreads) {
  IdentificationRequest request =
      RequestFor(TablesOf(SomeHopper(), {}, 2), std::vector<StudyReading>(2));
  request.readings[1].liftoff = LiftoffRule::kRestLength;
  request.context.data.energy.resize(3);
  request.budget = 25;
  request.keep = 2;
  request.with_front = true;
  const auto with = [&](int jobs) {
    return Identify(request, ThreadedFits{.jobs = jobs}.On(request.context));
  };
  const IdentificationResult one = with(1), three = with(3);
  ASSERT_EQ(one.by_all.size(), three.by_all.size());
  for (std::size_t i = 0; i < one.by_all.size(); ++i) {
    EXPECT_EQ(one.by_all[i].fit.reading, three.by_all[i].fit.reading);
    EXPECT_EQ(one.by_all[i].fit.constants, three.by_all[i].fit.constants);
  }
  EXPECT_EQ(one.evaluations, three.evaluations);
  EXPECT_EQ(one.front.size(), 9U);  // all parts alike, and each one emphasised or left out
}

TEST(Identification, OfTableSixFiveAloneEndsThere) {
  IdentificationRequest request =
      RequestFor(OnlyTables(TablesOf(SomeHopper(), {}, 2), {StudyTableId::k65}), {StudyReading()});
  const IdentificationResult result = Identify(request, ThreadedFits().On(request.context));
  ASSERT_EQ(result.by_all.size(), 1U);
  EXPECT_LT(result.by_all.front().scores.energy_rms, 0.002);
  EXPECT_TRUE(result.by_steady.empty());
}

TEST(Identification, TellsWhatATableSaysAboutAnOpenPoint) {
  IdentificationRequest request =
      RequestFor(TablesOf(SomeHopper(), {}, 2), std::vector<StudyReading>(2));
  request.readings[1].law.rolling = ThesisReading::Rolling::kExplicit;
  request.budget = 100;
  const IdentificationResult result = Identify(request, ThreadedFits().On(request.context));
  const auto decision = std::find_if(result.decisions.begin(), result.decisions.end(),
                                     [](const PointDecision& d) { return d.point == "rolling"; });
  ASSERT_NE(decision, result.decisions.end());
  EXPECT_LT(decision->words[0].energy_misfit, 0.01 * decision->words[1].energy_misfit);
  EXPECT_EQ(result.times.size(), AllConvergenceReadings().size());
  double shares = 0.0;
  for (const PullingCell& cell : result.cells) shares += cell.share;
  EXPECT_NEAR(shares, 3.0, 1e-9);  // each part's add up to 1; nothing undamped is printed
}

// The searches that a request asks for, without making them.
TEST(Identification, SearchesAToeMassFromScratchWithBothSignsOfTheTorque) {
  IdentificationRequest request = RequestFor(TablesOf(SomeHopper(), {}, 2), {StudyReading()});
  request.toe_free = {C::kToeMass, C::kPlacementRate, C::kPlacementDamping};
  request.keep_toe = 1;
  const auto from_scratch = [&](int toe_budget) {
    request.toe_budget = toe_budget;
    std::vector<StudyUnit> found;
    Identify(request, [&](const std::string& stage, const std::vector<StudyUnit>& units) {
      std::vector<StudyFit> fits;
      for (const StudyUnit& unit : units) {
        const bool all_free = unit.free.size() == request.free.size() + request.toe_free.size();
        if (stage == "toe mass" && unit.box == kWholeBox && all_free) found.push_back(unit);
        fits.push_back({unit.reading, SomeHopper().constants, 1.0, {}, 0});
      }
      return fits;
    });
    return found;
  };
  EXPECT_TRUE(from_scratch(0).empty());
  const std::vector<StudyUnit> units = from_scratch(500);
  ASSERT_EQ(units.size(), 2U);
  EXPECT_NE(units[0].reading.law.torque_sign, units[1].reading.law.torque_sign);
  for (const StudyUnit& unit : units) {
    EXPECT_EQ(unit.budget, 500);
    EXPECT_EQ(unit.runs, StudyUnit::Runs::kSteady);
  }
}

}  // namespace
}  // namespace hoplab
