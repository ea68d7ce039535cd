#include <gtest/gtest.h>

#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"
#include "app/terminal/warnings.h"
#include "base/nan.h"

namespace hoplab {
namespace {

TEST(Quantity, LargeAndSmallValuesGetAPrefix) {
  EXPECT_EQ(ReadableUnitOf(22.98e9, "Pa").unit, "GPa");
  EXPECT_DOUBLE_EQ(22.98e9 * ReadableUnitOf(22.98e9, "Pa").factor, 22.98);
  EXPECT_EQ(ReadableUnitOf(0.0005, "m").unit, "um");
  EXPECT_EQ(ReadableUnitOf(0.09, "m").unit, "mm");
  EXPECT_EQ(ReadableUnitOf(3.0, "N s/m").unit, "N s/m") << "no prefix on a compound unit";
  EXPECT_EQ(ReadableUnitOf(0.0, "Pa").unit, "Pa");
  EXPECT_EQ(ReadableUnitOf(0.85, "-").unit, "");
}

TEST(Quantity, DigitsFollowTheUncertainty) {
  EXPECT_EQ(DecimalsFor(0.18), 2);
  EXPECT_EQ(DecimalsFor(0.0095), 4);
  EXPECT_EQ(DecimalsFor(42.0), 0);
  EXPECT_EQ(Fixed(22.9765, 2), "22.98");
  EXPECT_EQ(Fixed(kNaN, 2), "-");
  EXPECT_EQ(Significant(0.012345, 3), "0.0123");
  EXPECT_EQ(Significant(17.46, 3), "17.5");
  EXPECT_EQ(Significant(0.0, 3), "0");
}

TEST(Quantity, AValueThatIsSmallBesideItsIntervalIsNotZero) {
  EXPECT_EQ(FixedOrMore(-0.297, DecimalsFor(102.5)), "-0.30");
  EXPECT_EQ(FixedOrMore(-103.2, DecimalsFor(102.5)), "-103");
  EXPECT_EQ(FixedOrMore(3.04, 0), "3.0");
  EXPECT_EQ(FixedOrMore(22.014, 3), "22.014");
  EXPECT_EQ(FixedOrMore(2e-7, 2), "2e-07");
  EXPECT_EQ(FixedOrMore(0.0, 2), "0.00");
}

TEST(Quantity, ErrorsOfLengthAreInMillimetres) {
  EXPECT_EQ(ErrorText(0.000702, "m"), "0.702 mm");
  EXPECT_EQ(ErrorText(0.25, "rad"), "0.250 rad");
  EXPECT_EQ(ErrorText(kNaN, "m"), "not computed");
  EXPECT_EQ(WithoutUnit("body_vx_m_per_s"), "body_vx");
  EXPECT_EQ(WithoutUnit("hip_torque_N_m"), "hip_torque");
}

TEST(TextTable, ColumnsLineUpAndEmptyOnesGo) {
  using enum TextTable::Align;
  TextTable table({kLeft, kRight, kLeft, kLeft});
  table.AddRow({"", "value", "unused", "unit"});
  table.AddRow({"E", "1.5", "", "GPa"});
  EXPECT_EQ(table.Lines(), (std::vector<std::string>{"     value  unit", "  E    1.5  GPa"}));
}

TEST(Warnings, TheSameOfManyFilesIsSaidOnce) {
  EXPECT_EQ(CollapseWarnings({"d/a.csv: spans 1.14e+03 s", "d/b.csv: spans 2 s", "d/a.csv: else"}),
            (std::vector<std::string>{"d/a.csv: spans 1.14e+03 s (likewise in 1 more file)",
                                      "d/a.csv: else"}));
}

}  // namespace
}  // namespace hoplab
