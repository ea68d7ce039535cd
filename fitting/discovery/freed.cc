#include "fitting/discovery/freed.h"

#include <limits>

namespace hoplab {

FittedModel Freed(const FittedModel& best, std::size_t m, const Candidate& freed, double c,
                  const FitProblem& null_problem, const RefitSettings& settings) {
  const auto at = static_cast<std::ptrdiff_t>(m);
  const Eigen::Index place = best.problem.shared_count() - best.parameter_count() +
                             ParameterCount(std::span(best.members).first(m));
  const Eigen::Index after = best.shared.size() - place - best.members[m].parameter_count();
  FittedModel rest;
  rest.members = best.members;
  rest.members.erase(rest.members.begin() + at);
  rest.problem = Extend(null_problem, rest.members);
  rest.problem.noise = best.problem.noise;
  rest.shared.resize(place + after);
  rest.shared << best.shared.head(place), best.shared.tail(after);
  rest.initial_states = best.initial_states;
  // Nothing is known of the rest without the term, and nothing is compared with it.
  rest.cost = std::numeric_limits<double>::infinity();
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(freed.parameter_count());
  sizes[0] = c;
  return Refit(rest, std::span(&freed, 1), sizes, settings);
}

}  // namespace hoplab
