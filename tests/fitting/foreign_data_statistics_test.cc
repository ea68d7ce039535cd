// Data made by others, where they are (HOPLAB_EXTRA_DATA): every record gives a fit and a diagnosis
// under every law of its mechanism, or says what is not whole; the practice sets' truths are found;
// and no search from a far start ends at a wrong place that it calls a result.
// ctest -L statistics -R Foreign

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/parallel.h"
#include "base/random.h"
#include "datasets/read_dataset.h"
#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kData = HOPLAB_EXTRA_DATA;

int Jobs() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

double SharedValue(const FitProblem& problem, const Eigen::VectorXd& shared,
                   const std::string& name) {
  for (std::size_t i = 0; i < problem.shared.size(); ++i)
    if (problem.shared[i].name == name) return shared[static_cast<Eigen::Index>(i)];
  return std::nan("");
}

struct PracticeSet {
  std::string name, law;
  double modulus = 0.0;
  std::vector<std::string> effects;
  Dataset dataset;
};

std::vector<PracticeSet> PracticeSets() {
  std::vector<PracticeSet> sets;
  if (!fs::exists(kData / "practice/truth.json")) return sets;
  std::ifstream file(kData / "practice/truth.json");
  const Json truth = Json::parse(file);
  for (const auto& [name, of] : truth.at("sets").items()) {
    PracticeSet set{name, of.at("analyse_with_law"), of.at("E_true_Pa"), {}, {}};
    for (const auto& [effect, size] : of.at("effects").items()) set.effects.push_back(effect);
    set.dataset = ReadDataset(kData / "practice" / name);
    sets.push_back(std::move(set));
  }
  return sets;
}

// ---- every record, every law -------------------------------------------------------------------

// The folders of the data: each is a set itself or holds sets. The robots lie in the project.
const std::vector<std::string> kFolders = {"practice",   "practice_unlisted", "rig",
                                           "ball_drops", "laminate_hopper",   "table_tennis_even",
                                           "robots"};

std::vector<fs::path> RecordsOf(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  const bool robots = name == "robots";
  const fs::path folder = robots ? fs::path(HOPLAB_SOURCE_DIR) / "datasets" : kData / name;
  std::vector<fs::path> found;
  if (fs::exists(folder / "dataset.yaml")) return {folder};
  if (!fs::exists(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (robots && !entry.path().filename().string().starts_with("robot-")) continue;
    if (fs::exists(entry.path() / "dataset.yaml")) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Every law of the mechanism; a robot has one, which no option names.
std::vector<std::string> LawsFor(const Dataset& dataset) {
  std::vector<std::string> laws;
  for (const Law law : LawsOf(MechanismOf(MakeProblem(dataset, {}).law)))
    laws.emplace_back(NameOf(law));
  return laws.empty() ? std::vector<std::string>{""} : laws;
}

struct Treated {
  fs::path record;
  std::string law, fit, diagnosis;
  double seconds = 0.0;
  bool refused = false, by_hop = false, whole = false;
};

void RunBoth(const Dataset& dataset, Treated& run) {
  DiagnosisOptions options;
  options.problem.law = run.law;
  const DatasetFit fit = FitDataset(dataset, options.problem, {});
  run.fit = !fit.result.ok                 ? "REFUSED: " + fit.result.message
            : !fit.result.stop.IsMinimum() ? "told: " + fit.result.stop.faults.front()
            : !fit.left_out.empty()        ? std::to_string(fit.left_out.size()) + " left out"
            : fit.by_hop                   ? "hop by hop"
                                           : "whole";
  run.by_hop = fit.by_hop;
  run.whole = fit.result.stop.IsMinimum() && fit.left_out.empty();
  const Diagnosis d = Diagnose(dataset, options);
  run.diagnosis = d.refusal.empty() ? std::string(NameOf(d.verdict)) : "REFUSED: " + d.refusal;
  run.refused = !fit.result.ok || !d.refusal.empty();
}

class ForeignRecords : public ::testing::TestWithParam<std::string> {};

TEST_P(ForeignRecords, AreFittedAndDiagnosedUnderEveryLaw) {
  std::vector<Treated> runs;
  for (const fs::path& record : RecordsOf(GetParam())) {
    for (const std::string& law : LawsFor(ReadDataset(record))) runs.push_back({record, law});
  }
  if (runs.empty()) GTEST_SKIP() << "no data in " << kData / GetParam();
  ParallelFor(static_cast<int>(runs.size()), Jobs(), [&](int i) {
    Treated& run = runs[static_cast<std::size_t>(i)];
    const auto begin = std::chrono::steady_clock::now();
    try {
      RunBoth(ReadDataset(run.record), run);
    } catch (const std::exception& error) {
      run.refused = true;
      run.diagnosis = std::string("REFUSED: ") + error.what();
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("%-20s %-17s fit: %-30s diagnose: %s (%.0f s)\n", run.record.filename().c_str(),
                run.law.c_str(), run.fit.c_str(), run.diagnosis.c_str(), run.seconds);
    std::fflush(stdout);
  });
  const auto count = [&](bool Treated::*what) {
    return std::count_if(runs.begin(), runs.end(), [&](const Treated& r) { return r.*what; });
  };
  const auto all = static_cast<std::ptrdiff_t>(runs.size());
  std::printf("%s: %td runs, %td refused, %td not whole, %td hop by hop\n", GetParam().c_str(), all,
              count(&Treated::refused), all - count(&Treated::whole), count(&Treated::by_hop));
  EXPECT_EQ(count(&Treated::refused), 0);
}

INSTANTIATE_TEST_SUITE_P(Folders, ForeignRecords, ::testing::ValuesIn(kFolders),
                         [](const auto& info) { return info.param; });

// ---- the practice sets' truths -----------------------------------------------------------------

struct Found {
  double error = 0.0;  // of E with the true causes given, relative
  bool named = false;  // the true causes are all in reported groups; adequate where there are none
  int differ = 0;      // sizes told to differ between trials
  std::string verdict;
};

Found Seek(const PracticeSet& set) {
  Found out;
  DiagnosisOptions options;
  options.problem.law = set.law;
  const Diagnosis d = Diagnose(set.dataset, options);
  out.differ = testing::SizesToldToDiffer(d);
  out.verdict = d.refusal.empty() ? std::string(NameOf(d.verdict)) : "refused";
  std::vector<std::string> names;
  for (std::size_t m = 0; m < d.naming.groups.size(); ++m) {
    out.verdict += m == 0 ? ": " : " + ";
    for (const std::string& name : testing::GroupNames(d.naming, m)) {
      names.push_back(name);
      out.verdict += name + " ";
    }
  }
  out.named = set.effects.empty()
                  ? d.verdict == Verdict::kAdequate
                  : std::all_of(set.effects.begin(), set.effects.end(), [&](const auto& effect) {
                      return std::find(names.begin(), names.end(), effect) != names.end();
                    });
  ProblemOptions told = options.problem;
  told.with_effects = set.effects;
  const DatasetFit fit = FitDataset(set.dataset, told, {});
  out.error = SharedValue(fit.problem, fit.result.shared, "E") / set.modulus - 1.0;
  return out;
}

TEST(ForeignData, ThePracticeSetsTruthsAreFound) {
  const std::vector<PracticeSet> sets = PracticeSets();
  if (sets.empty()) GTEST_SKIP() << "no data in " << kData;
  std::vector<Found> found(sets.size());
  ParallelFor(static_cast<int>(sets.size()), Jobs(), [&](int i) {
    found[static_cast<std::size_t>(i)] = Seek(sets[static_cast<std::size_t>(i)]);
  });
  int with_cause = 0, near = 0, named = 0, none = 0, adequate = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    std::string truth;
    for (const std::string& effect : sets[i].effects) truth += effect + " ";
    std::printf("%s: %s| %s| E %+.2f %% with the truth given\n", sets[i].name.c_str(),
                truth.c_str(), found[i].verdict.c_str(), 100.0 * found[i].error);
    EXPECT_EQ(found[i].differ, 0) << sets[i].name;  // in none of them does one
    if (sets[i].effects.empty()) {
      ++none;
      adequate += found[i].named;
      continue;
    }
    ++with_cause;
    near += std::abs(found[i].error) < 0.02;
    named += found[i].named;
  }
  std::printf("E within 2 %%: %d of %d; causes in the named groups: %d; adequate: %d of %d\n", near,
              with_cause, named, adequate, none);
  EXPECT_EQ(near, with_cause);
  EXPECT_GE(named, with_cause - 1);
  EXPECT_GE(adequate, none - 1);
}

// ---- the rigs -------------------------------------------------------------------------------

// What lies in a rig of the physics engine beside its elastica, and at what size; sizes that are
// not asked are NaN.
struct Rig {
  const char* name;
  std::vector<std::pair<const char*, double>> causes;
  double within;  // of the last cause's size
};

// Of the causes told as main, how many lie in the rig, and of those in the rig how many are told.
TEST(ForeignData, TheRigsCausesAreNamed) {
  const double nan = std::nan("");
  const std::vector<Rig> rigs = {
      {"rig-drops", {{"leg_material_damping", nan}, {"leg_mass", 0.010}}, 2e-3},
      {"rig-leg-1g", {{"leg_material_damping", 400e-6}}, 12e-6},
      {"rig-leg-80g", {{"leg_material_damping", nan}, {"leg_mass", 0.080}}, 8e-3},
      {"rig-grip-045",
       {{"leg_material_damping", nan}, {"leg_mass", 0.010}, {"foot_coulomb_friction", 1.0 / 0.45}},
       0.25},
      // Driven, on a floor of friction 1.
      {"rig-controlled",
       {{"leg_material_damping", nan}, {"leg_mass", nan}, {"foot_coulomb_friction", nan}},
       0.1}};
  if (!fs::exists(kData / "rig/rig-drops")) GTEST_SKIP() << "no data in " << kData;
  int main = 0, right = 0, wanted = 0;
  for (const Rig& rig : rigs) {
    DiagnosisOptions options;
    options.fit.jobs = Jobs();
    const Diagnosis d = Diagnose(ReadDataset(kData / "rig" / rig.name), options);
    ASSERT_TRUE(d.extension) << rig.name;
    std::string told;
    for (const CauseReport* c : d.extension->MainCauses()) {
      const std::string name(c->cause.effect->info.name);
      const bool is_there = std::any_of(rig.causes.begin(), rig.causes.end(),
                                        [&](const auto& cause) { return cause.first == name; });
      ++main;
      right += is_there;
      char text[96];
      std::snprintf(text, sizeof text, " %s %.4g (P %.2f)", name.c_str(),
                    d.naming.best.ValuesOf(static_cast<int>(d.naming.MemberOf(c->candidate)))[0],
                    c->probability);
      told += text;
      if (name == rig.causes.back().first && !std::isnan(rig.causes.back().second)) {
        EXPECT_NEAR(d.naming.best.ValuesOf(static_cast<int>(d.naming.MemberOf(c->candidate)))[0],
                    rig.causes.back().second, rig.within)
            << rig.name;
      }
    }
    wanted += static_cast<int>(rig.causes.size());
    constexpr double kModulus = 2.6910097272486766 / (0.03 * 0.003658 * 0.003658 * 0.003658 / 12);
    const double error = d.naming.best.shared[0] / kModulus - 1.0;
    std::printf("%s: %s;%s; E %+.2f %%\n", rig.name, std::string(NameOf(d.verdict)).c_str(),
                told.c_str(), 100.0 * error);
    EXPECT_LT(std::abs(error), 0.01) << rig.name;
    EXPECT_EQ(testing::SizesToldToDiffer(d), 0) << rig.name;
  }
  std::printf("main causes: %d, of them right %d of %d that are there\n", main, right, wanted);
  EXPECT_EQ(right, wanted);
  EXPECT_EQ(main, right);
}

// ---- far restarts
// --------------------------------------------------------------------------------

struct Landing {
  int reached = 0, told = 0, wrong = 0;
  std::string wrongs;
};

Landing FromFarRestarts(const PracticeSet& set, int restarts) {
  ProblemOptions options;
  options.law = set.law;
  FitOptions more;
  more.restarts = 8;
  const DatasetFit best = FitDataset(set.dataset, options, more);
  const double E = SharedValue(best.problem, best.result.shared, "E");
  const double d = SharedValue(best.problem, best.result.shared, "d");
  Landing out;
  RandomStream random(40, 1);
  for (int i = 0; i < restarts; ++i) {
    Dataset dataset = set.dataset;
    const double by_E = std::exp2(random.Uniform(-1.0, 1.0)), by_d = random.Uniform(0.0, 3.0);
    const auto shift = [&](MechanismSpec& m) {
      m.c_leg.E_Pa *= by_E;
      m.c_leg.damping_N_s_per_m *= by_d;
    };
    shift(dataset.mechanism);
    for (Trial& t : dataset.trials) shift(t.mechanism);
    const DatasetFit fit = FitDataset(dataset, options, {});
    const double E_found = SharedValue(fit.problem, fit.result.shared, "E");
    const double d_found = SharedValue(fit.problem, fit.result.shared, "d");
    // Two estimates of the discrepancy are not the same to the last digit.
    const bool same = fit.result.ok && std::abs(E_found / E - 1.0) < 2e-3 &&
                      std::abs(d_found - d) < 0.02 * std::max(std::abs(d), 1.0);
    const bool told = !fit.result.ok || !fit.result.stop.IsMinimum();
    ++(same ? out.reached : told ? out.told : out.wrong);
    if (same || told) continue;
    char text[160];
    std::snprintf(text, sizeof text, " [E x %.2f, d x %.2f: E %.2f GPa, d %.3f]", by_E, by_d,
                  1e-9 * E_found, d_found);
    out.wrongs += text;
  }
  return out;
}

TEST(ForeignData, FromFarRestartsThereIsOneOptimumOrItIsTold) {
  constexpr int kRestarts = 40;
  const std::vector<PracticeSet> sets = PracticeSets();
  if (sets.empty()) GTEST_SKIP() << "no data in " << kData;
  std::vector<Landing> landings(sets.size());
  ParallelFor(static_cast<int>(sets.size()), Jobs(), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    landings[k] = FromFarRestarts(sets[k], kRestarts);
    std::printf("%s: %d of %d at the optimum, %d told as no result, %d wrong%s\n",
                sets[k].name.c_str(), landings[k].reached, kRestarts, landings[k].told,
                landings[k].wrong, landings[k].wrongs.c_str());
    std::fflush(stdout);
  });
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_GE(landings[i].reached + landings[i].told, 0.95 * kRestarts) << sets[i].name;
    EXPECT_EQ(landings[i].wrong, 0) << sets[i].name << landings[i].wrongs;
  }
}

}  // namespace
}  // namespace hoplab
