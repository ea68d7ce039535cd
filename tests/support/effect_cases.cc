#include "tests/support/effect_cases.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "fitting/diagnosis/score.h"
#include "fitting/fit.h"

namespace hoplab::testing {
namespace {

std::string Text(const char* format, double a, double b, double c) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

// Directions in units of the parameters' typical sizes: both signs of one parameter, eight points
// of the compass for two.
std::vector<Eigen::VectorXd> Compass(const Effect& effect) {
  const auto n = static_cast<Eigen::Index>(effect.info.parameters.size());
  std::vector<Eigen::VectorXd> directions;
  if (n == 1) {
    for (double sign : {1.0, -1.0})
      directions.push_back(Eigen::VectorXd::Constant(1, sign * effect.info.parameters[0].typical));
    return directions;
  }
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4.0;
    Eigen::Vector2d u(std::cos(angle), std::sin(angle));
    for (Eigen::Index k = 0; k < n; ++k)
      u[k] = std::abs(u[k]) < 1e-12 ? 0.0 : u[k] * effect.info.parameters[k].typical;
    directions.emplace_back(u);
  }
  return directions;
}

// Empty if every trial runs to its end with these values.
std::string WhyNot(Law law, const Effect& effect, const std::vector<double>& values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const EffectParameter& p = effect.info.parameters[k];
    if (values[k] < p.lower || values[k] > p.upper)
      return std::string(p.name) + Text(" = %.3g is outside [%g, %g]", values[k], p.lower, p.upper);
  }
  Truth truth{.law = law, .effects = {{std::string(effect.info.name), values}}};
  std::vector<std::string> notes;
  try {
    MakeDataset(truth, &notes);
  } catch (const std::exception& e) {
    return e.what();
  }
  return notes.empty() ? "" : notes.front();
}

void SetLimit(Law law, const Effect& effect, EffectDirection& direction) {
  // What runs at a size runs at the smaller ones.
  for (auto size = kSizes.rbegin(); size != kSizes.rend(); ++size) {
    const std::string why = WhyNot(law, effect, direction.Values(effect, *size));
    if (why.empty()) {
      direction.largest = *size;
      return;
    }
    direction.limit = Text("%g delta80: ", *size, 0, 0) + why;
  }
}

Linearisation AtTheTruth(const FitProblem& problem, const std::vector<Candidate>& candidates,
                         const std::vector<TrialProblem>& train) {
  const FitProblem extended = Extend(problem, candidates);
  Eigen::VectorXd shared(extended.shared_count());
  for (int k = 0; k < shared.size(); ++k)
    shared[k] = extended.shared[static_cast<std::size_t>(k)].initial;
  std::vector<OwnValues> initial_states;
  for (const TrialProblem& t : train) initial_states.push_back(t.start);
  return Linearise(extended, problem.shared_count(), train, shared, initial_states, 1);
}

}  // namespace

std::vector<double> EffectDirection::Values(const Effect& effect, double size) const {
  std::vector<double> values;
  for (Eigen::Index k = 0; k < step.size(); ++k)
    values.push_back(effect.info.parameters[k].null + size * step[k]);
  return values;
}

std::vector<const EffectDirection*> EffectCase::At(double size) const {
  std::vector<const EffectDirection*> out;
  for (const EffectDirection& d : directions) {
    if (d.largest >= size) out.push_back(&d);
  }
  return out;
}

std::vector<EffectCase> EffectCasesOf(Law law) {
  ProblemOptions options;
  options.law = std::string(NameOf(law));
  const FitProblem problem = MakeProblem(MakeExactDataset(law), options);
  const std::vector<Candidate> candidates = CandidatesOf(problem, {});
  std::vector<TrialProblem> train = TrialsOf(problem, TrialRole::kTrain);
  const Linearisation at = AtTheTruth(problem, candidates, train);
  for (TrialProblem& t : train) {
    for (OwnParameter& o : t.own) o.prior_sigma = std::numeric_limits<double>::infinity();
  }
  const Linearisation free = AtTheTruth(problem, candidates, train);

  std::vector<EffectCase> cases;
  int first = 0;
  for (const Candidate& c : candidates) {
    EffectCase e{law, c.effect, {}, ""};
    const int n = c.parameter_count();
    const Eigen::MatrixXd columns = at.columns.middleCols(first, n);
    bool seen = true;
    for (int k = 0; k < n; ++k) {
      seen = seen && Information(at, first + k) > 0.0;
      e.through_initial_states = e.through_initial_states ||
                                 Information(free, first + k) < 0.05 * Information(at, first + k);
    }
    first += n;
    if (!seen) {
      e.excluded = "cannot be told from the fitted values and starts";
    } else {
      for (const Eigen::VectorXd& u : Compass(*c.effect)) {
        const double V = (columns * u).squaredNorm();
        EffectDirection d{(std::sqrt(kDelta80Threshold) + 0.8416212) / std::sqrt(V) * u};
        SetLimit(law, *c.effect, d);
        e.directions.push_back(std::move(d));
      }
      if (e.At(kSizes.front()).empty()) e.excluded = e.directions.front().limit;
    }
    cases.push_back(std::move(e));
  }
  return cases;
}

const std::vector<EffectCase>& AllEffectCases() {
  static const std::vector<EffectCase> cases = [] {
    std::vector<EffectCase> all;
    for (Law law : kAllLaws) {
      for (EffectCase& e : EffectCasesOf(law)) all.push_back(std::move(e));
    }
    return all;
  }();
  return cases;
}

}  // namespace hoplab::testing
