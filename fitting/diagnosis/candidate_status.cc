#include "fitting/diagnosis/candidate_status.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>

#include "base/nan.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/pool.h"
#include "fitting/diagnosis/score.h"

namespace hoplab {

namespace {

// The accepted model linearised, with the columns of the candidates that are not in it.
struct Remainder {
  Linearisation at;
  std::vector<Hypothesis> hypotheses;
  std::map<int, std::size_t> places;  // of candidates among them
};

Remainder LeftBeside(const Naming& naming, const FittedModel& model, const std::set<int>& members,
                     const std::vector<TrialProblem>& train, int jobs) {
  Remainder left;
  std::vector<Candidate> tested;
  for (int i = 0; i < static_cast<int>(naming.candidates.size()); ++i) {
    const CandidateResult& c = naming.candidates[static_cast<std::size_t>(i)];
    if (!c.separable || members.count(i)) continue;
    left.places[i] = tested.size();
    tested.push_back(c.candidate);
  }
  left.at = LineariseAt(model, tested, train, jobs);
  left.hypotheses = HypothesesOf(tested);
  return left;
}

// A column of a hypothesis less what its other columns, all at once, can do of it.
Eigen::VectorXd BesideTheOthers(const Linearisation& at, const Hypothesis& hypothesis, int column) {
  std::vector<int> others;
  for (int k = hypothesis.first; k < hypothesis.first + hypothesis.count; ++k)
    if (k != column && Information(at, k) > 0.0) others.push_back(k);
  const Eigen::VectorXd s = at.columns.col(column);
  if (others.empty()) return s;
  Eigen::MatrixXd A(s.size(), static_cast<Eigen::Index>(others.size()));
  for (std::size_t k = 0; k < others.size(); ++k)
    A.col(static_cast<Eigen::Index>(k)) = at.columns.col(others[k]).normalized();
  return s - A * A.colPivHouseholderQr().solve(s);
}

void Bound(const Remainder& left, int candidate, CandidateResult& c) {
  const Linearisation& at = left.at;
  const Hypothesis& hypothesis = left.hypotheses[left.places.at(candidate)];
  const Score score = ScoreOf(at, hypothesis);
  for (int k = 0; k < hypothesis.count; ++k) {
    // Of several parameters each is bounded with the others free.
    const int column = hypothesis.first + k;
    const double V = BesideTheOthers(at, hypothesis, column).squaredNorm();
    if (Information(at, column) > 0.0 && V > kInseparable * at.length[column] * at.length[column])
      c.bound95[k] = std::abs(score.size[k]) + 1.96 / std::sqrt(V);
  }
}

}  // namespace

void SetStatuses(const FittedModel& model, const CandidateSet& set, const std::set<int>& looked_at,
                 const std::vector<TrialProblem>& train, int jobs, Naming& naming) {
  const std::set<int> members(set.begin(), set.end());
  const Remainder left = LeftBeside(naming, model, members, train, jobs);
  std::set<int> doubtful;
  for (const std::vector<int>& group : naming.groups) {
    if (group.size() > 1) doubtful.insert(group.begin(), group.end());
  }
  for (int i = 0; i < static_cast<int>(naming.candidates.size()); ++i) {
    CandidateResult& c = naming.candidates[static_cast<std::size_t>(i)];
    c.bound95 = Eigen::VectorXd::Constant(c.candidate.parameter_count(), kNaN);
    // What the members can do in its place shows alone, and beside them there is no need of it.
    bool shows = c.separable && c.power >= kTestable;
    if (c.separable && !members.empty() && !members.count(i) && !doubtful.count(i)) {
      const double alone = c.power;
      c.power = PowerOf(left.at, c.candidate, left.hypotheses[left.places.at(i)]);
      shows = (c.power > 0.0 ? c.power : alone) >= kTestable;
    }
    if (doubtful.count(i)) {
      c.status = CandidateStatus::kIndistinguishable;
    } else if (members.count(i)) {
      c.status = CandidateStatus::kSupported;
    } else if (shows) {
      c.status = CandidateStatus::kExcluded;
    } else if (c.has_threshold && (c.alone.ok() || looked_at.count(i))) {
      c.status = CandidateStatus::kNotNeeded;
    }
    if (!members.count(i) && c.separable) Bound(left, i, c);
  }
}

}  // namespace hoplab
