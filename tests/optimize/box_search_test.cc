#include "optimize/box_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hoplab {
namespace {

double Valley(std::span<const double> x) {  // Rosenbrock's
  return std::pow(1.0 - x[0], 2) + 100.0 * std::pow(x[1] - x[0] * x[0], 2);
}

BoxSearchRequest Request() {
  BoxSearchRequest request;
  request.cost = Valley;
  request.low = {-2.0, -2.0};
  request.high = {2.0, 2.0};
  return request;
}

TEST(BoxSearch, FindsTheBottomOfAValley) {
  BoxSearchRequest request = Request();
  request.budget = 3000;
  const BoxSearchResult found = SearchBox(request);
  EXPECT_LT(found.cost, 1e-8);
  EXPECT_NEAR(found.x[0], 1.0, 1e-3);
}

// CRS2 alone looks at its limit only between whole steps and would go one or two beyond it.
TEST(BoxSearch, NeverEvaluatesMoreThanItsBudget) {
  for (int budget = 20; budget < 140; ++budget) {
    BoxSearchRequest request = Request();
    int calls = 0;
    request.cost = [&](std::span<const double> x) {
      ++calls;
      return Valley(x);
    };
    request.budget = budget;
    request.polish_share = 0.0;
    const BoxSearchResult found = SearchBox(request);
    EXPECT_LE(calls, budget);
    EXPECT_EQ(found.evaluations, calls);
  }
}

TEST(BoxSearch, FindsTheDeepestOfManyDips) {
  BoxSearchRequest request;
  request.low = {-5.12, -5.12};
  request.high = {5.12, 5.12};
  request.budget = 4000;
  request.cost = [](std::span<const double> x) {  // Rastrigin's function, least at 0.4, -1.3
    double sum = 20.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double d = x[i] - (i == 0 ? 0.4 : -1.3);
      sum += d * d - 10.0 * std::cos(2.0 * M_PI * d);
    }
    return sum;
  };
  const BoxSearchResult found = SearchBox(request);
  ASSERT_EQ(found.x.size(), 2U);
  EXPECT_NEAR(found.x[0], 0.4, 1e-4);
  EXPECT_NEAR(found.x[1], -1.3, 1e-4);
  EXPECT_LE(found.evaluations, 4000);
  EXPECT_EQ(SearchBox(request).x, found.x);
}

}  // namespace
}  // namespace hoplab
