#pragma once

#include <string>
#include <vector>

#include "fitting/diagnosis/linearisation.h"

namespace hoplab {

/// One cell of the misfit map: a mode, its early, middle or late part, one channel.
struct MisfitCell {
  Mode mode = Mode::kFlight;
  std::string phase;  // "early", "middle", "late"
  int channel = -1;   // place in FitProblem::channels; -1: contact times
  long rows = 0;
  double chi2 = 0.0;      // of its residuals
  double expected = 0.0;  // of noise alone, what the fit takes out counted
  double p_value = 1.0;   // of chi2, taken as chi-square with `expected` degrees of freedom
  double share = 0.0;     // of the whole excess over noise, 0..1
};

/// The same sum by hop number or by trial.
struct MisfitPart {
  int index = 0;  // hop number from 0, or place of the trial
  long rows = 0;
  double chi2 = 0.0, expected = 0.0, p_value = 1.0, share = 0.0;
};

struct Localisation {
  std::vector<MisfitCell> cells;  // the largest share first
  std::vector<MisfitPart> hops, trials;
  double chi2 = 0.0, expected = 0.0;  // of all samples
};

/// `noise_squares`: of each channel, what noise alone leaves of a sample's square (NoiseSquares);
/// empty: 1.
Localisation Localise(const Linearisation& at, const std::vector<double>& noise_squares = {});

/// Evidence for one column gathered along the trials: contribution of each row to the score
/// (s'r)^2/V, in the order of `at.labels`. Their sum is the score.
Eigen::VectorXd RunningEvidence(const Linearisation& at, int column);

}  // namespace hoplab
