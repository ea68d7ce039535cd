// Gaits of a robot found from nothing but a box of clocks and initial states, seed by seed: the
// figures of docs/statistics/robot.md. ctest -L statistics; the seeds are 1 to 10.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "optimize/gain_search.h"
#include "optimize/stride_measures.h"
#include "tests/support/robot_gaits.h"

namespace hoplab {
namespace {

using namespace testing;

// A robot, and how its legs follow one another.
struct Search {
  const char* name;
  int legs;
  double phase;  // of leg 2
  int budget;
  SearchConstraints constraints = {};
};

SearchProblem GaitProblem(const Search& search) {
  SearchProblem problem;
  problem.variables = {{"period", 0.2, 0.6},  {"duty", 0.3, 0.8},  {"sweep", 0.3, 1.5},
                       {"offset", -0.3, 0.6}, {"speed", 0.1, 1.5}, {"height", 0.185, 0.25}};
  problem.objective = SearchObjective::kSpectralRadius;
  problem.constraints = search.constraints;
  problem.hopper_at = [search](std::span<const double> x) {
    Hopper hopper = ClockedRobot(search.legs, x[0], x[1], x[2], x[3]);
    hopper.request.parameters.robot->phase[1] = search.phase;
    hopper.request.initial = {0.0, x[5], x[4], 0.0};
    hopper.request.integrator = {};
    return hopper;
  };
  return problem;
}

class GaitsFromScratch : public ::testing::TestWithParam<Search> {};

// One seed, until it has a stable stride: what comes after makes it no better found.
SeedResult FirstGait(const SearchProblem& problem, const Search& search, int seed) {
  std::atomic<bool> found = false;
  GainSearchOptions options;
  options.algorithm = SearchAlgorithm::kCrs2;
  options.budget = search.budget;
  options.seed = static_cast<std::uint64_t>(seed);
  options.seeds = 1;
  options.stop = &found;
  options.progress = [&](int, int, const SearchPoint& best) {
    if (best.verdict == PointVerdict::kGood) found = true;
  };
  return SearchGains(problem, options).seeds.front();
}

TEST_P(GaitsFromScratch, AStableOneIsFoundFromMostSeeds) {
  constexpr int kSeeds = 10;
  const Search& search = GetParam();
  const SearchProblem problem = GaitProblem(search);
  std::vector<SeedResult> seeds(kSeeds);
  ParallelFor(kSeeds, static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
    seeds[static_cast<std::size_t>(i)] = FirstGait(problem, search, i + 1);
  });
  int found = 0, evaluations = 0;
  for (const SeedResult& seed : seeds) {
    const bool good = seed.best.verdict == PointVerdict::kGood;
    found += good;
    evaluations += seed.evaluations;
    std::printf("  %s, seed %llu: %s, %s, spectral radius %.3f, %.2f m/s, %d evaluations\n",
                search.name, static_cast<unsigned long long>(seed.seed),
                std::string(NameOf(seed.best.verdict)).c_str(), seed.best.gait.c_str(),
                seed.best.spectral_radius, seed.best.speed, seed.evaluations);
    if (!good) continue;
    // Found again to rounding, and where it goes on for forty strides.
    const SteadyStride steady = FindSteadyStride(problem.hopper_at(seed.best.x));
    EXPECT_TRUE(steady.point.stable()) << seed.seed;
    EXPECT_NEAR(steady.point.spectral_radius, seed.best.spectral_radius, 1e-3);
  }
  std::printf("  %s: stable from %d of %d seeds, %d evaluations\n", search.name, found, kSeeds,
              evaluations);
  EXPECT_GE(found, 8);
}

// Both legs stand at once, and both are in the air at once.
constexpr SearchConstraints kPronk = {.max_legs_apart = 0.1, .min_flight_share = 0.02};

INSTANTIATE_TEST_SUITE_P(Robot, GaitsFromScratch,
                         ::testing::Values(Search{"InPhase", 2, 0.0, 1500},
                                           Search{"Pronk", 2, 0.0, 3000, kPronk},
                                           Search{"Walk", 3, 0.5, 700}),
                         [](const auto& at) { return at.param.name; });

}  // namespace
}  // namespace hoplab
