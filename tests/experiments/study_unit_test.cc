#include "experiments/identification/study_unit.h"

#include <gtest/gtest.h>

#include <fstream>

#include "experiments/identification/fit_journal.h"
#include "tests/experiments/study_hoppers.h"
#include "tests/support/input_error_of.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using namespace testing;
using C = StudyConstant;

StudyUnit SomeUnit() {
  StudyUnit unit;
  unit.runs = StudyUnit::Runs::kSteady;
  unit.reading.law.damping_rate = ThesisReading::DampingRate::kDeflection;
  unit.reading.liftoff = LiftoffRule::kRestLength;
  unit.weights = {1.0, 0.1, 10.0, 0.0};
  unit.free = {C::kMass, C::kPlacedShare};
  unit.constants = SomeHopper().constants;
  unit.box = 0.3;
  unit.seed = 7;
  unit.budget = 30;
  return unit;
}

UnitContext ContextFor(const StudyHopper& truth) {
  UnitContext context;
  context.data = TablesOf(truth, {}, 2);
  context.convergence = {ConvergenceReading()};
  return context;
}

TEST(StudyUnit, ReadsBackFromItsText) {
  EXPECT_EQ(UnitOfText(TextOf(SomeUnit())), SomeUnit());
  StudyUnit by_one_reading = SomeUnit();
  by_one_reading.times = 3;
  EXPECT_EQ(UnitOfText(TextOf(by_one_reading)), by_one_reading);
  EXPECT_FALSE(UnitOfText(TextOf(by_one_reading) + " 1").has_value());
  EXPECT_FALSE(UnitOfText(TextOf(SomeUnit()).substr(4)).has_value());
  EXPECT_FALSE(UnitOfText("").has_value());
}

TEST(StudyFit, ReadsBackFromItsText) {
  StudyFit fit{SomeUnit().reading, SomeHopper().constants, 1.0 / 3.0, {{0.1, 0.2, 0.3, 0.4}, 5}, 9};
  const auto read = FitOfText(TextOf(fit));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->reading, fit.reading);
  EXPECT_EQ(read->constants, fit.constants);
  EXPECT_EQ(read->misfit, fit.misfit);
  EXPECT_EQ(read->parts.parts, fit.parts.parts);
  EXPECT_EQ(read->parts.reading, 5);
  EXPECT_EQ(read->evaluations, 9);
}

TEST(StudyUnit, OfTheTruthHasNoMisfitButTheDigits) {
  const StudyHopper truth = SomeHopper();
  const UnitContext context = ContextFor(truth);
  const StudyMisfit misfit = MisfitOf(truth, context, StudyUnit::Runs::kTables, kAllParts);
  for (const double part : misfit.parts) EXPECT_LT(part, 1e-2);
  StudyHopper off = truth;
  At(off.constants, C::kMass) *= 1.1;
  EXPECT_GT(MisfitOf(off, context, StudyUnit::Runs::kTables, kAllParts).Total(), 0.3);
}

TEST(StudyUnit, IsFoundAgainFromNearby) {
  const StudyHopper truth = SomeHopper();
  const UnitContext context = ContextFor(truth);
  StudyUnit unit;
  unit.free = {C::kMass, C::kBendingStiffness};
  unit.constants = truth.constants;
  At(unit.constants, C::kMass) *= 1.05;
  At(unit.constants, C::kBendingStiffness) *= 1.05;
  unit.budget = 150;
  const StudyFit fit = FitUnit(context, unit);
  EXPECT_LT(fit.misfit, 0.05);
  EXPECT_NEAR(At(fit.constants, C::kMass) / At(truth.constants, C::kMass), 1.0, 0.01);
  EXPECT_LE(fit.evaluations, 2 * 150);
  EXPECT_EQ(TextOf(FitUnit(context, unit)), TextOf(fit));
}

// The truth's reading fits its tables, another one does not, and a fit says which it took.
TEST(StudyUnit, IsMeasuredByTheReadingOfTheTimesThatItNames) {
  const StudyHopper truth = SomeHopper();
  UnitContext context = ContextFor(truth);
  context.convergence.push_back({ConvergenceReading::Speed::kHopMean});
  StudyUnit unit;
  unit.reading = truth.reading;
  unit.constants = truth.constants;
  unit.free = {C::kGain};
  unit.budget = 20;
  EXPECT_EQ(LikelyTimes(context, unit, 2), (std::vector<int>{0, 1}));
  EXPECT_EQ(LikelyTimes(context, unit, 1), (std::vector<int>{0}));
  const StudyFit any = FitUnit(context, unit);
  unit.times = 1;
  const StudyFit other = FitUnit(context, unit);
  EXPECT_EQ(any.parts.reading, 0);
  EXPECT_EQ(other.parts.reading, 1);
  EXPECT_GT(other.misfit, 2.0 * any.misfit);
}

TEST(StudyUnit, EveryPartOfAMisfitHasItsTables) {
  const StudyHopper truth = SomeHopper();
  UnitContext context;
  context.data = PublishedStudyData();
  context.convergence = {ConvergenceReading()};
  const StudyMisfit all = MisfitOf(truth, context, StudyUnit::Runs::kTables, kAllParts);
  const std::vector<std::pair<StudyTableId, StudyPart>> alone = {
      {StudyTableId::k65, StudyPart::kEnergy},
      {StudyTableId::k62, StudyPart::kDampedTimes},
      {StudyTableId::k61, StudyPart::kUndampedTimes}};
  for (const auto& [table, part] : alone) {
    UnitContext one = context;
    one.data = OnlyTables(context.data, {table});
    const StudyMisfit misfit = MisfitOf(truth, one, StudyUnit::Runs::kTables, kAllParts);
    for (int i = 0; i < kStudyPartCount; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (static_cast<StudyPart>(i) == part) {
        EXPECT_GT(misfit.parts[at], 0.0) << NameOf(table);
      } else {
        EXPECT_EQ(misfit.parts[at], 0.0) << NameOf(table);
      }
    }
  }
  EXPECT_GT(all.Total(), 0.0);
}

TEST(FitJournal, GoesOnWhereItWas) {
  const TempFolder temp;
  const UnitContext context = ContextFor(SomeHopper());
  const auto file = temp.path() / "fits.partial";
  const StudyFit fit{SomeUnit().reading, SomeHopper().constants, 2.5, {}, 3};
  {
    FitJournal journal(file, context, "1", false);
    EXPECT_FALSE(journal.Find(SomeUnit()).has_value());
    journal.Add(SomeUnit(), fit);
  }
  std::ofstream(file, std::ios::app) << "torn";  // by an interruption
  FitJournal journal(file, context, "1", false);
  EXPECT_EQ(journal.size(), 1U);
  ASSERT_TRUE(journal.Find(SomeUnit()).has_value());
  EXPECT_EQ(TextOf(*journal.Find(SomeUnit())), TextOf(fit));
  StudyUnit other = SomeUnit();
  other.budget += 1;
  EXPECT_FALSE(journal.Find(other).has_value());
}

TEST(FitJournal, RefusesFitsToOtherTables) {
  const TempFolder temp;
  const auto file = temp.path() / "fits.partial";
  UnitContext context = ContextFor(SomeHopper());
  { FitJournal journal(file, context, "1", false); }
  context.data.energy[0].percent += 0.01;
  const std::string refused = InputErrorOf([&] { FitJournal journal(file, context, "1", false); });
  EXPECT_NE(refused.find("fits to other tables"), std::string::npos) << refused;
  EXPECT_EQ(InputErrorOf([&] { FitJournal journal(file, context, "1", true); }), "(no error)");
}

}  // namespace
}  // namespace hoplab
