#include "fitting/train_contrast.h"

#include <algorithm>
#include <cstdio>

#include "base/text.h"

namespace hoplab {
namespace {

constexpr double kFarWorse = 4.0;  // chi-square a sample, of that of the trials held out
constexpr int kFewestToCompare = 2;
constexpr double kFoundElsewhere = 0.5;  // of a trial's cost, where its start was not found
constexpr double kOddShare = 0.5;        // of the misfit, in the trials that are odd
constexpr std::size_t kMostNamed = 3;

struct RoleMisfit {
  double chi2 = 0.0;
  long samples = 0;
  int count = 0;
  double PerSample() const { return samples > 0 ? chi2 / static_cast<double>(samples) : 0.0; }
};

double PerSample(const TrialErrors& t) { return t.chi2 / static_cast<double>(t.samples); }

double CostOf(const TrialErrors& t) { return 0.5 * t.chi2 + t.prior_nll; }

RoleMisfit MisfitOf(const std::vector<TrialErrors>& trials, TrialRole role) {
  RoleMisfit out;
  for (const TrialErrors& t : trials) {
    if (t.role != role || !t.complete || t.samples == 0) continue;
    out.chi2 += t.chi2;
    out.samples += t.samples;
    ++out.count;
  }
  return out;
}

bool FarWorse(double train, double test) { return train > kFarWorse * std::max(test, 1.0); }

// The train trials that their start alone takes near the data, the shared values held.
std::vector<std::string> BetterElsewhere(const FitProblem& problem, const FitResult& fit,
                                         const std::vector<TrialErrors>& trials,
                                         const FitOptions& options) {
  FitProblem held = problem;
  held.noise = {};  // under which the values were sought
  for (TrialProblem& t : held.trials)
    t.role = t.role == TrialRole::kTrain ? TrialRole::kTest : TrialRole::kTrain;
  FitResult others = fit;
  others.cost = 0.0;  // what is poor does not follow from the fit that is asked about
  others.initial_states.clear();
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (trials[i].role == TrialRole::kTest) others.initial_states.push_back(trials[i].start);
  const std::vector<TrialErrors> refitted = AssessTrials(held, others, options, /*test_only=*/true);
  std::vector<std::string> better;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].role == TrialRole::kTrain && trials[i].complete && refitted[i].complete &&
        CostOf(refitted[i]) < kFoundElsewhere * CostOf(trials[i]))
      better.push_back(trials[i].file);
  }
  return better;
}

std::string Named(const std::vector<std::string>& files) {
  const std::size_t told = std::min(files.size(), kMostNamed);
  std::string text = Join({files.begin(), files.begin() + static_cast<std::ptrdiff_t>(told)});
  if (files.size() > told) text += " and " + std::to_string(files.size() - told) + " more";
  return text;
}

std::string FarText(const TrainContrast& c) {
  char text[160];
  std::snprintf(text, sizeof text,
                "the fitted trials are missed by far more than those held out (chi2 %.3g a sample "
                "against %.3g)",
                c.train, c.test);
  return text;
}

}  // namespace

bool TrainContrast::IsFar() const { return FarWorse(train, test); }

std::string TrainContrast::Fault() const {
  if (better_elsewhere.empty()) return "";
  return FarText(*this) + ", and another start follows far better in " + Named(better_elsewhere);
}

std::string TrainContrast::Warning() const {
  if (!IsFar()) return "";
  const bool one = odd.size() == 1;
  char share[40];
  std::snprintf(share, sizeof share, " (%.0f %% of the misfit)", 100.0 * odd_share);
  // Where many share the misfit it is no single trial that is odd.
  if (odd_share < kOddShare || 2 * static_cast<int>(odd.size()) > train_trials)
    return FarText(*this) + ": worst in " + Named(odd) + share +
           "; what goes wrong there is little in those held out";
  return FarText(*this) + ": " + Named(odd) + share + (one ? " does" : " do") +
         " not go with the others; look at what is stated of " +
         (one ? "it, or leave it out" : "them, or leave them out");
}

TrainContrast CompareRoles(const FitProblem& problem, const FitResult& fit,
                           const std::vector<TrialErrors>& trials, const FitOptions& options) {
  RoleMisfit train = MisfitOf(trials, TrialRole::kTrain);
  const RoleMisfit test = MisfitOf(trials, TrialRole::kTest);
  TrainContrast out;
  if (train.count < kFewestToCompare || test.count < kFewestToCompare) return out;
  out.train = train.PerSample();
  out.test = test.PerSample();
  out.train_trials = train.count;
  if (!out.IsFar()) return out;
  out.better_elsewhere = BetterElsewhere(problem, fit, trials, options);
  std::vector<const TrialErrors*> worst;
  for (const TrialErrors& t : trials)
    if (t.role == TrialRole::kTrain && t.complete && t.samples > 0) worst.push_back(&t);
  std::stable_sort(worst.begin(), worst.end(), [](const TrialErrors* a, const TrialErrors* b) {
    return PerSample(*a) > PerSample(*b);
  });
  const double all = train.chi2;
  for (const TrialErrors* t : worst) {
    if (!FarWorse(train.PerSample(), out.test)) break;
    out.odd.push_back(t->file);
    out.odd_share += t->chi2 / all;
    train.chi2 -= t->chi2;
    train.samples -= t->samples;
  }
  return out;
}

}  // namespace hoplab
