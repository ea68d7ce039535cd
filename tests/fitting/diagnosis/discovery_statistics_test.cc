// A formula is sought for an effect as if no catalogue held it, and where nothing is missing.
// ctest -L statistics

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <thread>

#include "base/parallel.h"
#include "fitting/discovery/discover.h"
#include "tests/fitting/diagnosis/study.h"
#include "tests/support/diagnosis_cases.h"
#include "tests/support/formulas.h"

namespace hoplab::testing {
namespace {

DiagnosisOptions OptionsFor(Law law) {
  DiagnosisOptions options;
  options.problem.law = std::string(NameOf(law));
  options.fit.jobs = 1;
  return options;
}

const WrittenEffect* WrittenAs(const std::string& name) {
  static const std::vector<WrittenEffect> all = WrittenEffects(1.0);
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const WrittenEffect& w) { return w.catalogue == name; });
  return found == all.end() ? nullptr : &*found;
}

// Words of a formula that are variables of its place.
std::set<std::string> VariablesOf(const std::string& acts_as, const std::string& formula) {
  std::set<std::string> names;
  std::string word;
  for (const char c : formula + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
      word += c;
      continue;
    }
    for (const VariableInfo& v : FindPlace(acts_as)->variables)
      if (v.name == word) names.insert(word);
    word.clear();
  }
  return names;
}

// Along the axes or along the way: one place, forces on the body.
std::string Room(const std::string& acts_as) {
  return acts_as.starts_with("body_force") ? "body_force" : acts_as;
}
bool IsRight(const FormulaSource& found, const FormulaSource& truth) {
  if (Room(found.acts_as) != Room(truth.acts_as)) return false;
  const std::set<std::string> is = VariablesOf(found.acts_as, found.formula),
                              should = VariablesOf(truth.acts_as, truth.formula);
  if (is.empty() || should.empty()) return is.empty() == should.empty();
  const bool moves = Room(truth.acts_as) == "body_force";  // speed, vx and vy are one
  const auto has = [&](const std::set<std::string>& set, const std::string& v) {
    return set.contains(v) || (moves && (v == "speed" || v == "vx" || v == "vy") &&
                               (set.contains("speed") || set.contains("vx") || set.contains("vy")));
  };
  return std::all_of(should.begin(), should.end(),
                     [&](const std::string& v) { return has(is, v); });
}

struct Found {
  Truth truth;
  std::string refusal, formula;
  DiscoveryVerdict verdict = DiscoveryVerdict::kNotNeeded;
  bool right = false;    // a formula that was told, or one the data cannot tell from it
  bool offered = false;  // the same, or one told to do as well
  double test = 0.0, test_of_truth = 0.0;  // rms over channels, in sigmas
};

// Mean square of the test errors over sigma, over the channels.
double InSigmas(const FittedModel& model, const HeldOutErrors& errors) {
  double sum = 0.0;
  for (std::size_t c = 0; c < model.problem.channels.size(); ++c) {
    const double ratio = errors.test.rmse[c] / model.problem.channels[c].sigma;
    sum += ratio * ratio;
  }
  return std::sqrt(sum / static_cast<double>(model.problem.channels.size()));
}

Found Seek(const Truth& truth) {
  Found out;
  out.truth = truth;
  const Dataset dataset = MakeDataset(truth);
  const DiagnosisOptions options = OptionsFor(truth.law);
  const Discovery d = Discover(dataset, options);
  out.refusal = d.base.refusal;
  if (!out.refusal.empty()) return out;
  out.verdict = d.verdict;
  if (truth.effects.empty()) return out;
  const FormulaSource& written = WrittenAs(truth.effects.front().name)->formula;
  for (const FoundTerm& f : d.found) {
    out.formula += (out.formula.empty() ? "" : " + ") + f.source.acts_as + ": " + f.source.formula;
    out.right = out.right || IsRight(f.source, written);
    for (const Effect* e : f.equal) out.right = out.right || IsRight(*SourceOf(*e), written);
    for (const Effect* e : f.as_good) out.offered = out.offered || IsRight(*SourceOf(*e), written);
  }
  out.offered = out.offered || out.right;
  out.test = InSigmas(d.base.null, d.found.empty() ? d.base.before : d.after);
  DiagnosisOptions told = options;
  told.problem.with_effects = {truth.effects.front().name};
  const Discovery known = Discover(dataset, told);
  out.test_of_truth = InSigmas(known.base.plain, MeasureHeldOut(known.base.plain, 1));
  return out;
}

std::vector<Found> SeekAll(const std::vector<Truth>& truths) {
  std::vector<Found> found(truths.size());
  ParallelFor(static_cast<int>(truths.size()),
              static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
                const auto at = static_cast<std::size_t>(i);
                found[at] = Seek(truths[at]);
              });
  return found;
}

struct Counts {
  int cases = 0, found = 0, right = 0, offered = 0, wrong = 0, near = 0;
  std::map<std::string, int> formulas;

  void Add(const Found& f) {
    ++cases;
    found += f.verdict == DiscoveryVerdict::kFound;
    right += f.right;
    offered += f.offered;
    wrong += f.verdict == DiscoveryVerdict::kFound && !f.offered;
    near += f.test <= 1.1 * f.test_of_truth;
    ++formulas[f.formula];
  }
  std::vector<std::string> Row(const std::string& name) const {
    const auto share = [&](int part) { return Cell("%.0f", PerCent(part, cases)); };
    std::string most;
    int times = 0;
    for (const auto& [formula, count] : formulas) {
      if (count <= times) continue;
      times = count;
      most = formula;
    }
    return {name,           Cell("%d", cases), share(found), share(right),
            share(offered), share(wrong),      share(near),  name == "all" ? "" : "`" + most + "`"};
  }
};

TEST(DiscoveryStatistics, AnEffectOutsideTheCatalogueIsFoundAsAFormula) {
  std::vector<Truth> truths;
  for (Truth& t : PlantEach(Table::kLeftOut, 4.0, SeedCount(10)))
    if (WrittenAs(t.effects.front().name) != nullptr) truths.push_back(std::move(t));
  Report report("8-discover", "A formula for an effect that no list holds");
  report.Say(
      "Each effect that can be written as a formula at 4 delta80, not in the catalogue. Shares in "
      "per cent. `Right`: place and variables of a told term are the true ones, or those of a term "
      "whose column is the same. `Offered`: right, or a term told to do as well is. `Certain and "
      "wrong`: told as found, and the truth is not offered. `Near`: the held-out error "
      "is within 10 %% of that of a fit with the true effect.");
  report.Head(
      {"planted", "cases", "found", "right", "offered", "certain and wrong", "near", "most often"});
  std::map<std::string, Counts> counts;
  Counts all;
  for (const Found& f : SeekAll(truths)) {
    if (!f.refusal.empty()) continue;
    counts[f.truth.effects.front().name].Add(f);
    all.Add(f);
  }
  for (const auto& [name, c] : counts) report.Row(c.Row(name));
  report.Row(all.Row("all"));
  EXPECT_TRUE(IsAtLeast(all.right, all.cases, 0.60)) << all.right << " of " << all.cases;
  EXPECT_TRUE(IsAtMost(all.wrong, all.cases, 0.05)) << all.wrong << " of " << all.cases;
  EXPECT_TRUE(IsAtLeast(all.near, all.cases, 0.80)) << all.near << " of " << all.cases;
}

TEST(DiscoveryStatistics, NothingIsFoundWhereNothingIsMissing) {
  std::vector<Truth> truths;
  const int seeds = SeedCount(17);
  for (const Law law : kAllLaws)
    for (int i = 0; i < seeds; ++i)
      truths.push_back({.law = law, .seed = NoiseSeed(Table::kFalseAlarms, 5000 + i)});
  int cases = 0, found = 0;
  for (const Found& f : SeekAll(truths)) {
    cases += f.refusal.empty();
    found += f.refusal.empty() && f.verdict == DiscoveryVerdict::kFound;
  }
  Report report("9-discover-nothing", "A formula where nothing is missing");
  report.Say("%d of %d data sets of the right model, over all laws, were given a formula.", found,
             cases);
  EXPECT_TRUE(IsAtMost(found, cases, 0.05)) << found << " of " << cases;
}

}  // namespace
}  // namespace hoplab::testing
