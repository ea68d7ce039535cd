#pragma once

#include <map>
#include <vector>

#include "fitting/diagnosis/linearisation.h"
#include "fitting/diagnosis/name.h"
#include "fitting/diagnosis/score.h"

namespace hoplab {

/// The accepted model linearised, with the columns of the candidates that are not in it.
struct Remainder {
  Linearisation at;
  std::vector<Hypothesis> hypotheses;
  std::map<int, std::size_t> places;  // of candidates among them
};

/// Beside `model`, the members `set` of `naming.candidates`.
Remainder LeftBeside(const Naming& naming, const FittedModel& model, const CandidateSet& set,
                     const std::vector<TrialProblem>& train, int jobs);

/// Sets `c.bound95`: how large a candidate can be, 95 %, once the accepted ones are in.
void Bound(const Remainder& left, int candidate, CandidateResult& c);

}  // namespace hoplab
