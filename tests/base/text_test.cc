#include "base/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>

#include "base/random.h"

namespace hoplab {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(ParseDouble, TakesEveryUsualNotation) {
  EXPECT_EQ(ParseDouble("22e9"), 22e9);
  EXPECT_EQ(ParseDouble("1.0E-9"), 1e-9);
  EXPECT_EQ(ParseDouble("+3"), 3);
  EXPECT_EQ(ParseDouble(".5"), .5);
  EXPECT_EQ(ParseDouble("-5."), -5);
  EXPECT_EQ(ParseDouble("1e+06"), 1e6);
  EXPECT_EQ(ParseDouble(" 007\t"), 7);
}

TEST(ParseDouble, RefusesWhatIsNoNumber) {
  for (const char* text : {"", " ", "-", ".", "e5", "1e", "1,5", "0x10", "1_000", "--1", "+-1",
                           "22 e9", "1.2.3", "12mm", "one", "nan(1)", "infinite", "-+inf", "1e5.0"})
    EXPECT_FALSE(ParseDouble(text)) << text;
}

TEST(ParseDouble, SaysInfinityAndNanForTheCallerToRefuse) {
  EXPECT_EQ(ParseDouble("inf"), kInf);
  EXPECT_EQ(ParseDouble("-.Inf"), -kInf);
  EXPECT_TRUE(std::isnan(*ParseDouble("NaN")));
  EXPECT_TRUE(std::isnan(*ParseDouble(".nan")));
}

TEST(ParseDouble, TooLargeIsInfinityAndTooSmallIsZero) {
  EXPECT_EQ(ParseDouble("1e999"), kInf);
  EXPECT_EQ(ParseDouble("-1e999"), -kInf);
  EXPECT_EQ(ParseDouble("1e-999"), 0);
  EXPECT_EQ(ParseDouble("0.001e-330"), 0);
  EXPECT_EQ(ParseDouble(std::string(400, '9')), kInf);
  EXPECT_EQ(ParseDouble(std::string(400, '9') + "e-1"), kInf);
  EXPECT_EQ(ParseDouble("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(ParseDouble("1e-99999999999999999999"), 0);
  EXPECT_EQ(ParseDouble("1e99999999999999999999"), kInf);
  EXPECT_EQ(ParseDouble("0e99999"), 0);
}

class CommaDecimals : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
};

TEST(ParseDouble, DoesNotHeedTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaDecimals));
  EXPECT_EQ(ParseDouble("1.5"), 1.5);
  EXPECT_EQ(FormatDouble(1.5), "1.5");
  std::locale::global(before);
}

TEST(FormatDouble, IsTheShortestThatReadsBack) {
  EXPECT_EQ(FormatDouble(0.1), "0.1");
  EXPECT_EQ(FormatDouble(22e9), "2.2e10");
  EXPECT_EQ(FormatDouble(-0.0), "-0");
  EXPECT_EQ(FormatDouble(std::nan("")), "nan");
  EXPECT_EQ(FormatDouble(-kInf), "-inf");
}

TEST(FormatDouble, ReadsBackBitForBitWhateverTheBits) {
  RandomStream random(1, 0);
  for (int i = 0; i < 20'000; ++i) {
    const auto high = static_cast<std::uint64_t>(random.Uniform(0, 4294967296.0));
    const auto low = static_cast<std::uint64_t>(random.Uniform(0, 4294967296.0));
    const std::uint64_t bits = high << 32 | low;
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const double back = ParseDouble(FormatDouble(value)).value();
    // Bit for bit: the sign of zero counts.
    std::uint64_t back_bits = 0;
    std::memcpy(&back_bits, &back, sizeof back);
    ASSERT_EQ(back_bits, bits) << FormatDouble(value);
  }
}

TEST(Printable, ShowsControlCharactersAndCutsBetweenCharacters) {
  EXPECT_EQ(Printable("a\nb\x1b"), "a\\x0ab\\x1b");
  EXPECT_EQ(Printable("abcdef", 3), "abc...");
  EXPECT_EQ(Printable("ab\xC3\xA4"
                      "cd",
                      3),
            "ab\xC3\xA4...");
}

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(EditDistance("", "abc"), 3u);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(EditDistance("tarin", "train"), 1u);
  EXPECT_EQ(EditDistance("E_PA", "e_pa"), 0u);
}

TEST(NearestWord, FindsTheMisspeltOne) {
  EXPECT_EQ(NearestWord("thicknes_m", {"width_m", "thickness_m"}), "thickness_m");
  EXPECT_EQ(NearestWord("tets", {"train", "test"}), "test");
  // Both one slip away: letters that changed places go before one that was replaced.
  for (const std::vector<std::string>& known :
       {std::vector<std::string>{"report", "export"}, {"export", "report"}}) {
    EXPECT_EQ(NearestWord("xeport", known), "export");
    EXPECT_EQ(NearestWord("erport", known), "report");
  }
}

TEST(NearestWord, GoesOnWithABeginningThatIsOneWordsAlone) {
  EXPECT_EQ(NearestWord("condition", {"chi2", "condition-number"}), "condition-number");
  EXPECT_FALSE(NearestWord("sensor", {"sensor_offset_x", "sensor_offset_y"}));
  EXPECT_FALSE(NearestWord("se", {"sensor_offset_x"}));
}

TEST(NearestWord, KeepsSilentWhereNothingIsNear) {
  EXPECT_FALSE(NearestWord("banana", {"width_m", "thickness_m"}));
  EXPECT_FALSE(NearestWord("", {"a"}));
  EXPECT_FALSE(NearestWord(std::string(1000, 'a'), {"a"}));
  EXPECT_FALSE(NearestWord("a", {}));
}

TEST(DidYouMean, ListsAllWordsWhereNoneIsNear) {
  EXPECT_EQ(DidYouMean("banana", {"train", "test"}), "Known: train, test.");
  EXPECT_EQ(DidYouMean("trian", {"train", "test"}), "Did you mean train?");
}

}  // namespace
}  // namespace hoplab
