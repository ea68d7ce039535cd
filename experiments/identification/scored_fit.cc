#include <cmath>

#include "experiments/identification/identification.h"

namespace hoplab {

ScoredFit Scored(const StudyFit& fit, const UnitContext& context) {
  ScoredFit scored{fit, {}, {}};
  scored.scores.modulus_trend = scored.scores.convergence_rms = std::nan("");
  if (std::isnan(fit.misfit)) return scored;
  if (!context.convergence.empty())
    scored.convergence = context.convergence[static_cast<std::size_t>(fit.parts.reading)];
  const StudyRuns runs = RunTables({fit.reading, fit.constants, context.integrator}, context.data,
                                   WantsOf({scored.convergence}));
  scored.scores = ScoresOf(runs, context.data, scored.convergence);
  return scored;
}

}  // namespace hoplab
