// Samples of the text formats with bytes changed, cut, doubled and swapped at random: whatever
// comes of it is a dataset's trace or an InputError, never another exception and never a crash.

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "base/random.h"
#include "tests/datasets/import_samples.h"

namespace hoplab {
namespace {

using testing::Fall;
using testing::MakeFall;

std::string Mutated(std::string text, RandomStream* random) {
  static constexpr std::string_view kBytes = "\t\n\r ,;:\"'-+.eE09#%[]()=\xC3\xFFXnN/";
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random->Uniform(0, static_cast<double>(n)));
  };
  for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
    // Half of the changes in the header, where they do the most.
    const std::size_t at =
        below(below(2) == 0 ? std::min<std::size_t>(text.size(), 300) : text.size());
    switch (below(5)) {
      case 0:
        text[at] = kBytes[below(kBytes.size())];
        break;
      case 1:
        text.erase(at, 1 + below(20));
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), below(40)));
        break;
      case 3:
        text.resize(text.size() - below(text.size() / 2 + 1));
        break;
      default:
        std::swap(text[at], text[below(text.size())]);
    }
  }
  return text;
}

// Nothing, or what is wrong with how the text was taken.
std::string Outcome(const std::string& text, Table (*read)(std::string, const std::string&)) {
  try {
    const Table table = read(text, "log");
    const ColumnMap map = ResolveColumns(table, {}, false);
    const ImportedTrace trace = TraceOfTable(table, map, {});
    ParseTraceCsv(trace.csv, "trace.csv");
  } catch (const InputError& error) {
    const InputError::Parts& parts = error.parts();
    if (parts.place.empty() || parts.rule.empty()) return error.what();
    // A trace that was written must be one: its own reader has nothing to say.
    if (parts.place.starts_with("trace.csv")) return error.what();
  } catch (const std::exception& error) {
    return std::string("other exception: ") + error.what();
  }
  return "";
}

TEST(ImportMutation, FourTextFormatsTakeAnythingWithoutACrash) {
  const Fall fall = MakeFall(20);
  std::string csv = "Time (ms);hip X [mm];hip Z [mm]\n";
  for (std::size_t i = 0; i < fall.t_s.size(); ++i)
    csv += testing::Format("%.1f", 1e3 * fall.t_s[i]) + ";" +
           testing::Format("%.2f", fall.x_mm[i]) + ";" + testing::Format("%.2f", fall.y_mm[i]) +
           "\n";
  struct Sample {
    std::string text;
    Table (*read)(std::string, const std::string&);
  };
  const std::vector<Sample> samples = {{csv, ReadPlainCsv},
                                       {testing::FallTrc(fall), ReadTrc},
                                       {testing::FallSto(fall), ReadStorage},
                                       {testing::FallMotive(fall), ReadMotiveCsv}};
  RandomStream random(5, 0);
  for (const Sample& sample : samples) {
    ASSERT_EQ(Outcome(sample.text, sample.read), "");
    for (int i = 0; i < 1500; ++i) {
      const std::string text = Mutated(sample.text, &random);
      ASSERT_EQ(Outcome(text, sample.read), "") << text;
      // Any reader may be told to read any file.
      ASSERT_EQ(Outcome(text, samples[i % samples.size()].read), "") << text;
    }
  }
}

}  // namespace
}  // namespace hoplab
