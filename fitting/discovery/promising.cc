#include "fitting/discovery/promising.h"

#include <algorithm>
#include <cmath>

#include "fitting/discovery/stability.h"

namespace hoplab {
namespace {

// Terms that are refitted one by one: the most promising by the linear model.
constexpr int kRefitted = 16;
// Of them picked beside each other, under each of the two noises.
constexpr int kPicked = 4;
// Of the refitted those of one family of shapes.
constexpr int kOfOneFamily = 4;

}  // namespace

std::vector<int> Promising(const std::vector<Term>& library, const std::vector<int>& leaders,
                           const Linearisation& white, const Linearisation& colored) {
  std::vector<int> promising;
  const auto add = [&](int column) {
    const Term& term = library[static_cast<std::size_t>(column)];
    const auto alike = std::count_if(promising.begin(), promising.end(), [&](int other) {
      const Term& t = library[static_cast<std::size_t>(other)];
      return term.shape && t.shape && t.shape->family == term.shape->family;
    });
    if (static_cast<int>(promising.size()) < kRefitted && alike < kOfOneFamily &&
        std::find(promising.begin(), promising.end(), column) == promising.end())
      promising.push_back(column);
  };
  for (const Linearisation* at : {&white, &colored})
    for (const LinearPick& pick : PickForward(*at, leaders, kPicked, 0.0)) add(pick.column);
  std::vector<std::pair<double, int>> alone;
  for (const int j : leaders) {
    double best = 0.0;
    for (const Linearisation* at : {&white, &colored}) {
      const double square = at->columns.col(j).squaredNorm();
      const double along = at->columns.col(j).dot(at->r);
      // Under each noise in its own nats.
      if (square > 0.0) best = std::max(best, 0.5 * along * along / square / at->chi2());
    }
    alone.emplace_back(-best, j);
  }
  std::stable_sort(alone.begin(), alone.end());
  for (const auto& [gain, j] : alone) add(j);
  std::sort(promising.begin(), promising.end());
  return promising;
}

double PriceOf(const Term& term, const std::vector<Term>& library) {
  if (!term.shape) return 0.0;
  const auto members = std::count_if(library.begin(), library.end(), [&](const Term& t) {
    return t.shape && t.shape->family == term.shape->family;
  });
  return std::log(static_cast<double>(members));
}

double ColumnSize(const Linearisation& at, int column) {
  const double square = at.columns.col(column).squaredNorm();
  return square > 0.0 ? -at.columns.col(column).dot(at.r) / square : 0.0;
}

}  // namespace hoplab
