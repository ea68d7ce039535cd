#include "fitting/diagnosis/remainder.h"

#include <algorithm>
#include <cmath>

#include "fitting/diagnosis/linearise_at.h"

namespace hoplab {

Remainder LeftBeside(const Naming& naming, const FittedModel& model, const CandidateSet& set,
                     const std::vector<TrialProblem>& train, int jobs) {
  Remainder left;
  std::vector<Candidate> tested;
  for (int i = 0; i < static_cast<int>(naming.candidates.size()); ++i) {
    const CandidateResult& c = naming.candidates[static_cast<std::size_t>(i)];
    if (!c.separable || std::find(set.begin(), set.end(), i) != set.end()) continue;
    left.places[i] = tested.size();
    tested.push_back(c.candidate);
  }
  left.at = LineariseAt(model, tested, train, jobs);
  left.hypotheses = HypothesesOf(tested);
  return left;
}

void Bound(const Remainder& left, int candidate, CandidateResult& c) {
  const Linearisation& at = left.at;
  const Hypothesis& hypothesis = left.hypotheses[left.places.at(candidate)];
  const Score score = ScoreOf(at, hypothesis);
  for (int k = 0; k < hypothesis.count; ++k) {
    // Of several parameters each is bounded with the others free.
    const int column = hypothesis.first + k;
    Eigen::VectorXd s = at.columns.col(column);
    for (int other = hypothesis.first; other < hypothesis.first + hypothesis.count; ++other) {
      const auto o = at.columns.col(other);
      if (other != column && Information(at, other) > 0.0) s -= o * (o.dot(s) / o.squaredNorm());
    }
    const double V = s.squaredNorm();
    if (Information(at, column) > 0.0 && V > kInseparable * at.length[column] * at.length[column])
      c.bound95[k] = std::abs(score.size[k]) + 1.96 / std::sqrt(V);
  }
}

}  // namespace hoplab
