#include "optimize/box_search.h"

#include <exception>
#include <nlopt.hpp>

#include "base/check.h"
#include "base/random.h"

namespace hoplab {
namespace {

class BoxSeeker {
 public:
  explicit BoxSeeker(const BoxSearchRequest& request) : request_(request) {}

  BoxSearchResult Search() {
    const std::size_t n = request_.low.size();
    std::vector<double> from = request_.start;
    if (from.empty()) {
      RandomStream random(request_.seed, 1);
      for (std::size_t i = 0; i < n; ++i)
        from.push_back(random.Uniform(request_.low[i], request_.high[i]));
      const int polish = static_cast<int>(request_.polish_share * request_.budget);
      Minimize(nlopt::GN_CRS2_LM, from, request_.budget - polish, {});
      if (result_.x.empty()) return result_;
      from = result_.x;
    }
    std::vector<double> step(n);
    for (std::size_t i = 0; i < n; ++i) step[i] = kFirstStep * (request_.high[i] - request_.low[i]);
    Minimize(nlopt::LN_SBPLX, from, request_.budget - result_.evaluations, step);
    return result_;
  }

 private:
  static constexpr double kFirstStep = 0.02;  // of the box

  void Minimize(nlopt::algorithm algorithm, std::vector<double> x, int evaluations,
                const std::vector<double>& first_step) {
    if (evaluations <= 0 || Stopped()) return;
    nlopt::srand(static_cast<unsigned long>(request_.seed));  // of this thread only
    nlopt::opt search(algorithm, static_cast<unsigned>(x.size()));
    search.set_lower_bounds(request_.low);
    search.set_upper_bounds(request_.high);
    search.set_maxeval(evaluations);  // some of NLopt's searches look only now and then
    until_ = result_.evaluations + evaluations;
    search.set_xtol_rel(1e-9);
    if (!first_step.empty()) search.set_initial_step(first_step);
    search.set_min_objective(&BoxSeeker::Call, this);
    search_ = &search;
    double value = 0.0;
    try {
      search.optimize(x, value);
    } catch (const nlopt::forced_stop&) {
      if (failure_) std::rethrow_exception(failure_);
    } catch (const nlopt::roundoff_limited&) {
      // As good as it gets: the best point is kept.
    }
  }

  bool Stopped() const { return request_.stop && *request_.stop; }

  static double Call(unsigned n, const double* x, double*, void* self_pointer) {
    BoxSeeker& self = *static_cast<BoxSeeker*>(self_pointer);
    if (self.Stopped() || self.result_.evaluations >= self.until_) {
      self.search_->force_stop();
      return 0.0;
    }
    try {
      const double cost = self.request_.cost({x, n});
      ++self.result_.evaluations;
      if (self.result_.x.empty() || cost < self.result_.cost) {
        self.result_.x.assign(x, x + n);
        self.result_.cost = cost;
      }
      return cost;
    } catch (...) {  // NLopt would turn it into another exception
      self.failure_ = std::current_exception();
      self.search_->force_stop();
      return 0.0;
    }
  }

  const BoxSearchRequest& request_;
  BoxSearchResult result_;
  nlopt::opt* search_ = nullptr;
  int until_ = 0;  // evaluations that end `search_`
  std::exception_ptr failure_;
};

}  // namespace

BoxSearchResult SearchBox(const BoxSearchRequest& request) {
  HOPLAB_CHECK(!request.low.empty() && request.low.size() == request.high.size());
  return BoxSeeker(request).Search();
}

}  // namespace hoplab
