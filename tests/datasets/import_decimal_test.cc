// Numbers keep the digits they were printed with: integer arithmetic is the oracle.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "base/random.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/import/decimal.h"
#include "datasets/import/unit.h"

namespace hoplab {
namespace {

TEST(ImportDecimal, AShiftedPointKeepsEveryDigit) {
  EXPECT_EQ(ShiftDecimal("412.50", -3), "0.41250");
  EXPECT_EQ(ShiftDecimal("-0.07", -3), "-0.00007");
  EXPECT_EQ(ShiftDecimal("1700000000123456789", -9), "1700000000.123456789");
  EXPECT_EQ(ShiftDecimal("+12", 0), "12");
  EXPECT_EQ(ShiftDecimal(".5", 3), "500");
  EXPECT_EQ(ShiftDecimal("5.", -1), "0.5");
  EXPECT_EQ(ShiftDecimal("1.25e3", -3), "1.25");
  EXPECT_EQ(ShiftDecimal("0.000", -3), "0.000000");
  EXPECT_EQ(ShiftDecimal("-0", -3), "0.000");
  EXPECT_EQ(ShiftDecimal("3e-300", -3), "3e-303");
  EXPECT_EQ(ShiftDecimal("0e99999999999999999999", 2), "0");
}

TEST(ImportDecimal, SignsAndSumsAreExact) {
  EXPECT_EQ(NegateDecimal("0.30"), "-0.30");
  EXPECT_EQ(NegateDecimal("-0.30"), "0.30");
  EXPECT_EQ(NegateDecimal("0.00"), "0.00");
  EXPECT_EQ(AddDecimals("12.345", "-12.343"), "0.002");
  EXPECT_EQ(AddDecimals("0.1", "0.2"), "0.3");
  EXPECT_EQ(AddDecimals("1700000000.123456789", "-1700000000.123456788"), "0.000000001");
  EXPECT_EQ(AddDecimals("-1", "0.25"), "-0.75");
  EXPECT_EQ(AddDecimals("5", "-5"), "0");
  EXPECT_EQ(AddDecimals("0", "1e-40"), "1e-40");
  EXPECT_EQ(AddDecimals("1e30", "1e-30"), std::nullopt);
}

// n / 10^decimals as text, by integers alone.
std::string Printed(long long n, int decimals) {
  long long scale = 1;
  for (int i = 0; i < decimals; ++i) scale *= 10;
  char text[64];
  const long long size = n < 0 ? -n : n;
  if (decimals == 0) {
    std::snprintf(text, sizeof text, "%s%lld", n < 0 ? "-" : "", size);
  } else {
    std::snprintf(text, sizeof text, "%s%lld.%0*lld", n < 0 ? "-" : "", size / scale, decimals,
                  size % scale);
  }
  return text;
}

TEST(ImportDecimal, TenThousandRandomLogValuesComeBackDigitForDigitFromEveryMetricUnit) {
  RandomStream random(17, 0);
  for (int i = 0; i < 10'000; ++i) {
    const int decimals = i % 7;
    const auto n = static_cast<long long>(1e9 * random.Normal());
    const std::string printed = Printed(n, decimals);
    const std::string metres = ToSi(printed, *FindUnit("mm"));
    ASSERT_EQ(metres, Printed(n, decimals + 3));
    // Through the double that a fit sees, and back to the digits of the log.
    char back[64];
    std::snprintf(back, sizeof back, "%.*f", decimals, *ParseDouble(metres) * 1e3);
    ASSERT_EQ(back, printed);
    ASSERT_EQ(ToSi(printed, *FindUnit("us")), Printed(n, decimals + 6));
    ASSERT_EQ(ToSi(printed, *FindUnit("m")), printed);
  }
}

TEST(ImportDecimal, DegreesComeBackToTheDigitsTheyWerePrintedWith) {
  RandomStream random(18, 0);
  for (int i = 0; i < 10'000; ++i) {
    const int decimals = i % 7;
    const std::string printed = Printed(static_cast<long long>(1e8 * random.Normal()), decimals);
    const double rad = *ParseDouble(ToSi(printed, *FindUnit("deg")));
    char back[64];
    std::snprintf(back, sizeof back, "%.*f", decimals, RadToDeg(rad));
    ASSERT_EQ(back, printed);
  }
}

TEST(ImportUnit, NamesAreReadAsPeopleWriteThem) {
  EXPECT_EQ(FindUnit("Millimeters")->name, "mm");
  EXPECT_EQ(FindUnit("MM")->name, "mm");
  EXPECT_EQ(FindUnit("sec")->name, "s");
  EXPECT_EQ(FindUnit("µs")->name, "us");
  EXPECT_EQ(FindUnit("°")->name, "deg");
  EXPECT_EQ(FindUnit("N·m")->name, "N m");
  EXPECT_EQ(FindUnit("m s^-1")->name, "m/s");
  EXPECT_FALSE(FindUnit("furlong"));
  EXPECT_FALSE(FindUnit(""));
}

TEST(ImportUnit, ANewtonMetreIsNoNanometre) {
  EXPECT_EQ(FindUnit("Nm")->dimension, Dimension::kTorque);
  EXPECT_FALSE(FindUnit("nm"));
}

TEST(ImportUnit, NonMetricFactorsAreThoseOfNist) {
  EXPECT_EQ(ToSi("1", *FindUnit("in")), "0.0254");
  EXPECT_EQ(ToSi("10", *FindUnit("ft")), "3.048");
  EXPECT_EQ(ToSi("1", *FindUnit("kgf")), "9.80665");
  EXPECT_EQ(ToSi("1", *FindUnit("lbf")), "4.4482216152605");
  EXPECT_EQ(ToSi("2", *FindUnit("min")), "120");
}

TEST(ImportUnit, ATitleIsTakenApartIntoNameAndUnit) {
  const auto parts = [](const char* title) {
    const ColumnTitle t = SplitTitle(title);
    return t.stem + "|" + t.unit;
  };
  EXPECT_EQ(parts("z [mm]"), "z|mm");
  EXPECT_EQ(parts("Time (ms)"), "Time|ms");
  EXPECT_EQ(parts("pitch deg"), "pitch|deg");
  EXPECT_EQ(parts("t / s"), "t|s");
  EXPECT_EQ(parts("body_vx_m_per_s"), "body_vx|m per s");
  EXPECT_EQ(parts("hip_torque_N_m"), "hip_torque|N m");
  EXPECT_EQ(parts("supply [V]"), "supply|V");
  EXPECT_EQ(parts("pos (filtered)"), "pos (filtered)|");
  EXPECT_EQ(parts("/body/pos[:,1]"), "/body/pos[:,1]|");
  EXPECT_EQ(parts("m"), "m|");
  EXPECT_EQ(parts("foot in"), "foot in|");
  EXPECT_EQ(parts(""), "|");
}

}  // namespace
}  // namespace hoplab
