#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "fitting/diagnosis/candidate.h"
#include "fitting/diagnosis/linearisation.h"

namespace hoplab {

/// Score test of one hypothesis: some of the tested columns of a linearisation act. For one column
/// score = (s'r)^2/V with V = s'Ms, the gain in chi-square a linear model would make.
struct Score {
  /// Expected size of each value, V^-1 (-s'r), own units; NaN where it cannot be told from the
  /// fitted values. Values that cannot be told from each other share one size, scaled alike.
  Eigen::VectorXd size;
  double score = 0.0;           // 0 where the best size lies on the wrong side of a bound
  double p_value = 1.0;         // of this score alone, under noise
  double predicted_gain = 0.0;  // nats: score/2
  int rank = 0;                 // dimensions that can be told from the fitted values
};

/// One hypothesis among several: which columns, and on which side of null they may lie.
struct Hypothesis {
  int first = 0, count = 1;      // columns of the linearisation
  Eigen::VectorXd lower, upper;  // room on each side of null, own units (lower <= 0 <= upper)
};

/// A hypothesis a candidate.
std::vector<Hypothesis> HypothesesOf(std::span<const Candidate> candidates);

/// Scores of hypotheses with the distribution of the smallest p-value among them under white noise.
struct ScoreTests {
  std::vector<Score> scores;  // one a hypothesis
  double smallest_p = 1.0;
  /// Chance that noise alone gives a smallest p-value as small; by drawing noise through the same
  /// projection, the Bonferroni bound where no draw was as extreme.
  double global_p = 1.0;
};

Score ScoreOf(const Linearisation& at, const Hypothesis& hypothesis);

ScoreTests TestScores(const Linearisation& at, std::span<const Hypothesis> hypotheses,
                      std::uint64_t seed);

/// Smallest size of a column the data show with 80 % power at a threshold of chi-square
/// `threshold`, (sqrt(threshold) + 0.84)/sqrt(V); infinite if the column cannot be told from the
/// fitted values.
double DetectableSize(const Linearisation& at, int column, double threshold);

/// V = s'Ms of a column, own units^-2; 0 if it cannot be told from the fitted values.
double Information(const Linearisation& at, int column);

}  // namespace hoplab
