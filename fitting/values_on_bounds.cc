#include "fitting/values_on_bounds.h"

#include <algorithm>

namespace hoplab {

bool Contains(const Places& places, int k) {
  return std::find(places.begin(), places.end(), k) != places.end();
}

Places PushedOut(const SolveRequest& request, const TrialEvaluations& evaluations) {
  Places out;
  const Eigen::VectorXd values = evaluations.SharedValues();
  for (int k = 0; k < request.problem->shared_count(); ++k) {
    const SharedParameter& s = request.problem->shared[static_cast<std::size_t>(k)];
    const bool lower = IsOnLower(s, values[k]), upper = IsOnUpper(s, values[k]);
    if (s.held && !Contains(request.held, k)) out.push_back(k);
    if (s.held || (!lower && !upper) || Contains(request.held, k)) continue;
    const double gradient = evaluations.Gradient(k);
    if (lower ? gradient >= 0.0 : gradient <= 0.0) out.push_back(k);
  }
  return out;
}

}  // namespace hoplab
