// A fit with a model that is wrong in a way nobody has told it: every effect of the catalogue
// planted at 5, 15 and 40 delta80, records cut at random instants, fitted without it. Nothing is
// refused, and one search reaches what eight reach, or says that it is no minimum. ctest -L
// statistics -R WrongModel; HOPLAB_STATISTICS_SEEDS for fewer seeds

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <thread>

#include "base/parallel.h"
#include "base/random.h"
#include "fitting/fit_dataset.h"
#include "tests/fitting/diagnosis/study.h"
#include "tests/support/effect_cases.h"

namespace hoplab {
namespace {

using testing::EffectCase;
using testing::EffectDirection;

constexpr std::array kSizes = {5.0, 15.0, 40.0};  // delta80
constexpr int kMostSeeds = 3, kRestarts = 8;
// Two searches that stop within a tenth of a nat, or this share of a large cost, agree.
constexpr double kSameNats = 0.1, kSameShare = 1e-4;

struct Wrong {
  testing::Truth truth;
  std::string name;
};

std::vector<Wrong> CasesOf(Law law) {
  const int seeds = testing::SeedCount(kMostSeeds);
  std::vector<Wrong> cases;
  for (const EffectCase& e : testing::EffectCasesOf(law)) {
    if (!e.excluded.empty()) continue;
    for (const double size : kSizes) {
      for (int seed = 1; seed <= seeds; ++seed) {
        const EffectDirection& direction =
            e.directions[static_cast<std::size_t>(seed) % e.directions.size()];
        Wrong w;
        w.truth.law = law;
        w.truth.size = size;
        w.truth.seed = static_cast<std::uint64_t>(seed);
        w.truth.effects = {{std::string(e.effect->info.name), direction.Values(*e.effect, size)}};
        const auto& parameters = e.effect->info.parameters;
        for (std::size_t k = 0; k < parameters.size(); ++k) {
          double& value = w.truth.effects.front().values[k];
          value = std::clamp(value, parameters[k].lower, parameters[k].upper);
        }
        w.name = w.truth.effects.front().name + " " + std::to_string(static_cast<int>(size)) +
                 " delta80, seed " + std::to_string(seed);
        cases.push_back(std::move(w));
      }
    }
  }
  return cases;
}

// Every trial cut at an instant between half its time and its end; at least 20 rows stay.
void CutAtRandom(Dataset& dataset, std::uint64_t seed) {
  RandomStream random(seed, 77);
  for (Trial& t : dataset.trials) {
    const auto rows = static_cast<double>(t.trace.time_s.size());
    const auto kept = static_cast<std::size_t>(std::max(20.0, rows * random.Uniform(0.5, 1.0)));
    if (kept >= t.trace.time_s.size()) continue;
    t.trace.time_s.resize(kept);
    for (TraceColumn& c : t.trace.columns) c.values.resize(kept);
  }
}

enum class End { kReached, kTold, kMissed, kRefused, kNotMade };

struct Ending {
  End end = End::kNotMade;
  double cost = 0.0, best = 0.0;
  bool by_hop = false;
  std::size_t left_out = 0;
  std::string told;
};

Ending Try(const Wrong& wrong, std::uint64_t number) {
  Ending out;
  Dataset dataset;
  try {
    dataset = testing::MakeDataset(wrong.truth);
  } catch (const std::exception&) {
    return out;  // this world falls before its second row
  }
  CutAtRandom(dataset, number);
  ProblemOptions options;
  options.law = std::string(NameOf(wrong.truth.law));
  const DatasetFit one = FitDataset(dataset, options, {});
  FitOptions more;
  more.restarts = kRestarts;
  const DatasetFit best = FitDataset(dataset, options, more);
  out.by_hop = one.by_hop;
  out.left_out = one.left_out.size();
  if (!one.result.ok) {
    out.end = End::kRefused;
    out.told = one.result.message;
    return out;
  }
  out.cost = one.result.cost;
  out.best = best.result.ok && best.by_hop == one.by_hop && best.left_out == one.left_out
                 ? std::min(best.result.cost, one.result.cost)
                 : one.result.cost;
  const bool same = out.cost - out.best < kSameNats + kSameShare * out.best;
  if (!one.result.stop.IsMinimum()) out.told = one.result.stop.faults.front();
  out.end = !out.told.empty() ? End::kTold : same ? End::kReached : End::kMissed;
  return out;
}

class WrongModelStatistics : public ::testing::TestWithParam<Law> {};

TEST_P(WrongModelStatistics, IsFittedAllTheSame) {
  std::vector<Wrong> cases = CasesOf(GetParam());
  if (const char* most = std::getenv("HOPLAB_STATISTICS_CASES"))
    cases.resize(std::min<std::size_t>(cases.size(), static_cast<std::size_t>(std::atoi(most))));
  std::vector<Ending> endings(cases.size());
  ParallelFor(static_cast<int>(cases.size()), static_cast<int>(std::thread::hardware_concurrency()),
              [&](int i) { endings[i] = Try(cases[i], static_cast<std::uint64_t>(i)); });
  std::map<End, int> count;
  int by_hop = 0, left_out = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Ending& e = endings[i];
    ++count[e.end];
    by_hop += e.by_hop;
    left_out += e.left_out > 0;
    if (e.end == End::kReached || e.end == End::kNotMade) continue;
    std::printf("  %s: %s, cost %.6g, best of %d starts %.6g%s %s\n", cases[i].name.c_str(),
                e.end == End::kRefused  ? "REFUSED"
                : e.end == End::kMissed ? "missed"
                                        : "told as no minimum",
                e.cost, kRestarts, e.best, e.by_hop ? ", hop by hop" : "", e.told.c_str());
  }
  const int made = static_cast<int>(cases.size()) - count[End::kNotMade];
  std::printf(
      "%s: %d cases; %d reached the best of %d starts, %d missed it, %d told as no minimum, "
      "%d refused; %d hop by hop, %d with hops left out\n",
      std::string(NameOf(GetParam())).c_str(), made, count[End::kReached], kRestarts,
      count[End::kMissed], count[End::kTold], count[End::kRefused], by_hop, left_out);
  EXPECT_EQ(count[End::kRefused], 0);
  EXPECT_GE(count[End::kReached], 0.95 * made);
}

INSTANTIATE_TEST_SUITE_P(Laws, WrongModelStatistics,
                         ::testing::Values(Law::kElastica, Law::kLargeDeflection, Law::kConsistent,
                                           Law::kNoSlip, Law::kThesis, Law::kStraightLeg,
                                           Law::kBall),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

}  // namespace
}  // namespace hoplab
