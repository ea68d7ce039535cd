#include "datasets/trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace hoplab {
namespace {

TEST(Trace, FindsAColumnByChannelAndByName) {
  const Trace trace = ParseTraceCsv("time_s,body_y_m,extra\n0,0.3,7\n", "a.csv");
  EXPECT_EQ(trace.Find(Channel::kBodyY)->at(0), 0.3);
  EXPECT_EQ(trace.Find("extra")->at(0), 7);
  EXPECT_EQ(trace.Find(Channel::kBodyX), nullptr);
}

TEST(Trace, TakesQuotedCells) {
  EXPECT_EQ(ParseTraceCsv("\"time_s\",\"body_y_m\"\n\"0\",\"0.3\"\n", "a.csv"),
            ParseTraceCsv("time_s,body_y_m\n0,0.3\n", "a.csv"));
}

TEST(Trace, TakesAClockThatCountsFrom1970) {
  EXPECT_EQ(ParseTraceCsv("time_s\n1700000000.25\n", "a.csv").time_s[0], 1700000000.25);
}

TEST(Trace, MissingEqualsMissingButNothingElse) {
  const double nan = std::nan("");
  EXPECT_EQ((TraceColumn{"a", {nan, 1}}), (TraceColumn{"a", {nan, 1}}));
  EXPECT_FALSE((TraceColumn{"a", {nan, 1}}) == (TraceColumn{"a", {0, 1}}));
  EXPECT_FALSE((TraceColumn{"a", {1}}) == (TraceColumn{"a", {1, 1}}));
}

TEST(Trace, ComesBackExactlyFromItsOwnText) {
  RandomStream random(3, 0);
  Trace trace;
  trace.columns = {{"body_y_m", {}}, {"extra", {}}};
  double time = -5;
  for (int i = 0; i < 500; ++i) {
    time += std::exp(5 * random.Normal()) + 1e-12;
    trace.time_s.push_back(time);
    trace.columns[0].values.push_back(i % 7 == 0 ? std::nan("") : random.Normal());
    trace.columns[1].values.push_back(random.Normal() * std::pow(10, random.Uniform(-300, 300)));
  }
  EXPECT_EQ(ParseTraceCsv(FormatTraceCsv(trace), "a.csv"), trace);
}

TEST(Channel, EveryNameLeadsBackToItsChannel) {
  for (const Channel c : RecordedChannels()) EXPECT_EQ(ChannelFromName(ChannelName(c)), c);
  EXPECT_EQ(NameOf(Channel::kBodyPitch), "body_pitch_rad");
  EXPECT_EQ(NameOf(Channel::kLegForceY4), "leg_force_y_4_N");  // rows stand as the enumerators
  EXPECT_FALSE(ChannelFromName("leg_force_y_4_N")) << "no trace has it";
  EXPECT_FALSE(ChannelFromName("body_z_m"));
}

}  // namespace
}  // namespace hoplab
