#include "base/range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hoplab {
namespace {

TEST(Range, TextShowsOpenEndsAndTheUnit) {
  EXPECT_EQ(Positive(1e13, "Pa").Text(), "(0, 1e13] Pa");
  EXPECT_EQ(NonNegative(1, "").Text(), "[0, 1]");
  EXPECT_EQ((Range{-90, 180, true, true, "deg"}).Text(), "(-90, 180) deg");
}

TEST(Range, TextOfNoLimitsSaysAnyFiniteNumber) { EXPECT_EQ(Range{}.Text(), "any finite number"); }

TEST(Range, AnOpenEndIsNotContained) {
  EXPECT_FALSE(Positive(1, "").Contains(0));
  EXPECT_TRUE(Positive(1, "").Contains(std::numeric_limits<double>::min()));
  EXPECT_TRUE(Positive(1, "").Contains(1));
  EXPECT_FALSE((Range{0, 1, false, true, ""}).Contains(1));
}

TEST(Range, NeitherNanNorInfinityIsContained) {
  EXPECT_FALSE(Range{}.Contains(std::nan("")));
  EXPECT_FALSE(Range{}.Contains(std::numeric_limits<double>::infinity()));
}

TEST(Range, TheRemedyForANegativeMassIsTheSign) {
  EXPECT_EQ(RangeRemedy(-4, Positive(1, "kg")), "Check the sign.");
}

TEST(Range, TheRemedyForALargeMassIsTheUnit) {
  EXPECT_EQ(RangeRemedy(4, Positive(1, "kg")), "Check the unit: kg is meant.");
}

}  // namespace
}  // namespace hoplab
