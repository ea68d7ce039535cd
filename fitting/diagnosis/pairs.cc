#include "fitting/diagnosis/pairs.h"

#include <Eigen/Dense>
#include <algorithm>

namespace hoplab {
namespace {

constexpr std::size_t kMostPairs = 6;

struct Pair {
  double gain;
  CandidateSet set;
};

bool Allowed(const CandidateResult& c, double size) {
  const EffectParameter& p = c.candidate.Parameter(0);
  return size > 0.0 ? p.upper > p.null : p.lower < p.null;
}
bool MayPair(const CandidateResult& c) { return c.separable && c.candidate.in_all(); }

// Where each candidate's columns begin.
std::vector<int> FirstColumns(std::span<const CandidateResult> candidates) {
  std::vector<int> first;
  int columns = 0;
  for (const CandidateResult& c : candidates) {
    first.push_back(columns);
    if (c.candidate.in_all()) columns += c.candidate.parameter_count();
  }
  return first;
}

}  // namespace

std::vector<CandidateSet> PairsFromNull(std::span<const CandidateResult> candidates,
                                        const Linearisation& null_at, double least) {
  const Eigen::MatrixXd gram = null_at.columns.transpose() * null_at.columns;
  const Eigen::VectorXd b = -(null_at.columns.transpose() * null_at.r);
  const std::vector<int> first = FirstColumns(candidates);
  std::vector<Pair> pairs;
  const int count = static_cast<int>(candidates.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const CandidateResult &ci = candidates[i], &cj = candidates[j];
      if (!MayPair(ci) || !MayPair(cj)) continue;
      if (ci.candidate.parameter_count() + cj.candidate.parameter_count() > 2) continue;
      const double a = gram(first[i], first[i]), d = gram(first[j], first[j]);
      const double off = gram(first[i], first[j]), det = a * d - off * off;
      if (!(det > 1e-6 * a * d)) continue;
      const double x = (d * b[first[i]] - off * b[first[j]]) / det;
      const double y = (a * b[first[j]] - off * b[first[i]]) / det;
      if (!Allowed(ci, x) || !Allowed(cj, y)) continue;
      pairs.push_back({0.5 * (x * b[first[i]] + y * b[first[j]]), {i, j}});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& p, const Pair& q) { return p.gain > q.gain; });
  std::vector<CandidateSet> sets;
  for (const Pair& p : pairs) {
    if (sets.size() >= kMostPairs || p.gain < least) break;
    sets.push_back(p.set);
  }
  return sets;
}

}  // namespace hoplab
