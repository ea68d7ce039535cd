#include "experiments/identification/findings.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/nan.h"
#include "experiments/identification/study_residuals.h"

namespace hoplab {
namespace {

void FindSpread(IdentificationResult& result) {
  constexpr double kAsGood = 2.0;
  result.low = result.high = result.by_all.front().fit.constants;
  for (const ScoredFit& scored : result.by_all) {
    if (!(scored.fit.misfit <= kAsGood * result.by_all.front().fit.misfit)) continue;
    ++result.as_good;
    for (std::size_t c = 0; c < result.low.size(); ++c) {
      result.low[c] = std::min(result.low[c], scored.fit.constants[c]);
      result.high[c] = std::max(result.high[c], scored.fit.constants[c]);
    }
  }
}

std::vector<StudyDirection> DirectionsOf(const StudyHopper& hopper, const StudyData& data,
                                         bool stiffness, const std::vector<StudyConstant>& free) {
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::VectorXd residuals(ResidualCount(data, stiffness));
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(residuals.size(), n);
  std::vector<StudyDirection> directions;
  if (residuals.size() == 0 || !ResidualsOf(hopper, data, stiffness, free, residuals, &slopes))
    return directions;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(slopes, Eigen::ComputeFullV);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd v = svd.matrixV().col(i);
    const double strength = i < svd.singularValues().size() ? svd.singularValues()[i] : 0.0;
    directions.push_back({strength, {v.begin(), v.end()}});
  }
  return directions;
}

// The least misfit with each word of a point, over three sets of fits.
class Decider {
 public:
  explicit Decider(const IdentificationResult& result) : result_(result) {}

  template <class WordOf>
  void Add(std::string point, std::span<const std::string_view> words, const WordOf& word_of) {
    PointDecision decision{std::move(point), {}};
    for (const std::string_view word : words)
      decision.words.push_back({std::string(word), kNaN, kNaN, kNaN});
    const auto note = [&](const StudyFit& fit, double PointDecision::Word::*least) {
      double& best = decision.words[static_cast<std::size_t>(word_of(fit))].*least;
      if (std::isnan(best) || fit.misfit < best) best = fit.misfit;
    };
    // There is no torque in table 6.5.
    if (decision.point != "torque_sign") {
      for (const StudyFit& fit : result_.by_energy) note(fit, &PointDecision::Word::energy_misfit);
    }
    for (const StudyFit& fit : result_.by_steady) note(fit, &PointDecision::Word::steady_misfit);
    for (const ScoredFit& scored : result_.by_all)
      note(scored.fit, &PointDecision::Word::all_misfit);
    decisions_.push_back(std::move(decision));
  }
  std::vector<PointDecision> Take() { return std::move(decisions_); }

 private:
  const IdentificationResult& result_;
  std::vector<PointDecision> decisions_;
};

std::vector<PointDecision> Decide(const IdentificationResult& result) {
  Decider decider(result);
  for (const ReadingKey& key : ReadingKeys())
    decider.Add(std::string(key.key), key.words,
                [&](const StudyFit& fit) { return key.get(fit.reading.law); });
  static constexpr std::array<std::string_view, 2> kLiftoff = {"zero_force", "rest_length"};
  decider.Add("liftoff", kLiftoff,
              [](const StudyFit& fit) { return static_cast<int>(fit.reading.liftoff); });
  static constexpr std::array<std::string_view, 2> kToe = {"none", "free"};
  decider.Add("toe_mass", kToe, [](const StudyFit& fit) {
    return At(fit.constants, StudyConstant::kToeMass) > 0.0 ? 1 : 0;
  });
  return decider.Take();
}

std::vector<ReadingOfTimes> TimesByReading(const StudyRuns& runs, const StudyData& data) {
  std::vector<ReadingOfTimes> times;
  for (const ConvergenceReading& reading : AllConvergenceReadings()) {
    const StudyMisfit misfit = MisfitOf(runs, data, {reading});
    const StudyScores scores = ScoresOf(runs, data, reading);
    times.push_back({reading, misfit.parts[static_cast<std::size_t>(StudyPart::kDampedTimes)],
                     misfit.parts[static_cast<std::size_t>(StudyPart::kUndampedTimes)],
                     scores.times[static_cast<std::size_t>(StudyTableId::k62)]});
  }
  return times;
}

}  // namespace

void AddFindings(const IdentificationRequest& request, IdentificationResult& result) {
  result.decisions = Decide(result);
  if (result.by_all.empty()) return;
  FindSpread(result);
  const ScoredFit& best = result.by_all.front();
  if (std::isnan(best.fit.misfit)) return;
  const StudyData& data = request.context.data;
  const StudyHopper hopper{best.fit.reading, best.fit.constants, request.context.integrator};
  result.energy_directions = DirectionsOf(hopper, data, false, request.free);
  result.smooth_directions = DirectionsOf(hopper, data, true, request.free);
  const StudyRuns runs = RunTables(hopper, data, WantsOf(AllConvergenceReadings()));
  result.times = TimesByReading(runs, data);
  result.cells = PullingCells(runs, data, best.convergence);
}

}  // namespace hoplab
