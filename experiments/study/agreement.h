#pragma once

#include <span>

namespace hoplab {

// How well two columns of numbers go together. Pairs with a NaN in them are left out.

/// Differences of `ours` from `published`; NaN where there is no pair.
struct Agreement {
  int pairs = 0;
  double rms, max_abs, mean;
};
Agreement AgreementOf(std::span<const double> published, std::span<const double> ours);

/// Spearman's rank correlation, ties at their mean rank; NaN for fewer than three pairs or a
/// constant column.
double RankCorrelation(std::span<const double> a, std::span<const double> b);

/// Whether b goes up or down with a: Kendall's tau-b, and the two-sided p-value of the Mann-Kendall
/// test, normal approximation with ties and continuity correction. NaN for fewer than three pairs
/// or where all of a are equal. A constant b has tau 0 and p 1.
struct Trend {
  double tau, p_value;
};
Trend TrendOf(std::span<const double> a, std::span<const double> b);

}  // namespace hoplab
