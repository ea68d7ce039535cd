#include "fitting/diagnosis/sizes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// An extension that explains nine tenths of the misfit, errors of two channels in units of the
// noise, and a gain that may be claimed.
struct OwnSizes {
  ExtensionReport report;
  SizesReport sizes;
};
OwnSizes With(double explained, std::vector<double> one_size, std::vector<double> own) {
  OwnSizes t;
  t.report.explained = 0.9;
  t.report.after.test.rmse = std::move(one_size);
  t.sizes.explained = explained;
  t.sizes.held_out_rmse = std::move(own);
  t.sizes.held_out_gain.nats_per_sample = 0.1;
  t.sizes.held_out_gain.ci95 = {0.05, 0.15};
  return t;
}
bool AreTold(const OwnSizes& t) { return SizesMatter(t.sizes, t.report, kMaterial); }

TEST(SizesMatter, WhereTheyExplainAFiftiethMoreOrTakeAnErrorDown) {
  EXPECT_TRUE(AreTold(With(0.919, {1.05, 1.0}, {1.0, 1.0})));
  EXPECT_FALSE(AreTold(With(0.917, {1.05, 1.0}, {1.0, 1.0})));
  EXPECT_TRUE(AreTold(With(0.901, {1.2, 1.0}, {1.0, 1.0})));
}

TEST(SizesMatter, WhereHeldOutTrialsConfirmThem) {
  OwnSizes t = With(0.95, {1.2, 1.0}, {1.0, 1.0});
  t.sizes.held_out_gain.ci95 = {-0.01, 0.15};
  EXPECT_FALSE(AreTold(t));
  t.sizes.held_out_gain.ci95.reset();  // too few hops to tell
  EXPECT_TRUE(AreTold(t));
}

TEST(SizesMatter, NotWhereAHeldOutErrorGrowsOrIsLost) {
  EXPECT_TRUE(AreTold(With(0.99, {1.4, 1.0}, {1.0, 1.04})));
  EXPECT_FALSE(AreTold(With(0.99, {1.4, 1.0}, {1.0, 1.06})));
  EXPECT_FALSE(AreTold(With(0.99, {1.4, 1.0}, {kNone, kNone})));
}

TEST(SizesMatter, ByTrainTrialsAloneWhereNothingIsHeldOut) {
  OwnSizes t = With(0.95, {}, {});
  t.sizes.held_out_gain = {};
  EXPECT_TRUE(AreTold(t));
  EXPECT_TRUE(AreTold(With(0.95, {kNone}, {kNone})));
}

// A size is told to differ where some refit came to rest, pays and matters; never to first order.
TEST(SizesTold, AreThoseOfARefitThatPaysAndMatters) {
  ExtensionReport report;
  CauseReport cause;
  cause.sizes.resize(1);
  cause.sizes[0].spread = 0.1;
  cause.sizes[0].p_value = 1e-6;
  EXPECT_FALSE(report.TellsSizesOf(cause, 0));
  report.sizes.emplace();
  EXPECT_FALSE(report.TellsSizesOf(cause, 0));
  report.sizes->refitted = report.sizes->pays = report.sizes->matters = true;
  cause.refitted = {std::nullopt};
  EXPECT_FALSE(report.TellsSizesOf(cause, 0));
  cause.refitted = {VaryingValue()};
  EXPECT_TRUE(report.TellsSizesOf(cause, 0));
  for (bool SizesReport::*needed :
       {&SizesReport::refitted, &SizesReport::pays, &SizesReport::matters}) {
    (*report.sizes).*needed = false;
    EXPECT_FALSE(report.TellsSizesOf(cause, 0));
    (*report.sizes).*needed = true;
  }
}

// Where the drag of each trial differs, a marker that sits elsewhere in all of them does not.
TEST(Diagnose, TellsSizesOfTheCauseThatDiffersAlone) {
  Dataset dataset = testing::HopsWithDrag({0.03, 0.09, 0.05, 0.07, 0.02, 0.08}, {0.03, 0.09}, 3);
  constexpr double kOffset_m = 0.004;
  for (Trial& trial : dataset.trials)
    for (TraceColumn& column : trial.trace.columns)
      if (column.name == "body_y_m")
        for (double& value : column.values) value += kOffset_m;
  const Diagnosis d =
      Diagnose(dataset, testing::OptionsWith({"air_drag", "sensor_offset_y", "sensor_scale_x"}));
  ASSERT_TRUE(d.extension) << d.reason;
  int told = 0;
  for (const CauseReport* c : d.extension->ToldCauses()) {
    told += d.extension->TellsSizesOf(*c, 0);
    EXPECT_EQ(d.extension->TellsSizesOf(*c, 0), c->cause.effect->info.name == "air_drag")
        << c->cause.Name();
  }
  EXPECT_EQ(told, 1);
  EXPECT_EQ(d.extension->ToldCauses().size(), 2u);
}

}  // namespace
}  // namespace hoplab
