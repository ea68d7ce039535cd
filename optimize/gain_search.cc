#include "optimize/gain_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <mutex>
#include <nlopt.hpp>

#include "base/parallel.h"
#include "base/random.h"

namespace hoplab {
namespace {

struct AlgorithmName {
  SearchAlgorithm algorithm;
  std::string_view name;
  nlopt::algorithm nlopt;
};
constexpr std::array<AlgorithmName, 6> kAlgorithms = {{
    {SearchAlgorithm::kDirectL, "direct_l", nlopt::GN_DIRECT_L},
    {SearchAlgorithm::kDirectLRandom, "direct_l_random", nlopt::GN_DIRECT_L_RAND},
    {SearchAlgorithm::kCrs2, "crs2", nlopt::GN_CRS2_LM},
    {SearchAlgorithm::kIsres, "isres", nlopt::GN_ISRES},
    {SearchAlgorithm::kEsch, "esch", nlopt::GN_ESCH},
    {SearchAlgorithm::kRandom, "random", nlopt::NUM_ALGORITHMS},  // not NLopt's
}};

// One seed's search: counts, scores and remembers every point. Variables run from 0 to 1.
class SeedSeeker {
 public:
  SeedSeeker(const SearchProblem& problem, const GainSearchOptions& options, std::size_t index,
             std::mutex& mutex)
      : problem_(problem), options_(options), index_(index), mutex_(mutex) {
    result_.seed = options.seed + index;
  }

  SeedResult Search() {
    const int polish = static_cast<int>(options_.polish_share * options_.budget);
    Globally(options_.budget - polish);
    result_.global_evaluations = result_.evaluations;
    if (result_.evaluations > 0) {
      Locally(nlopt::LN_SBPLX, Goal::kScore, result_.evaluations + polish / 2);
      // BOBYQA wants two variables at least.
      const auto descent = problem_.variables.size() > 1 ? nlopt::LN_BOBYQA : nlopt::LN_SBPLX;
      if (result_.best.verdict <= PointVerdict::kWideBand &&
          problem_.objective != SearchObjective::kSpectralRadius)
        Locally(descent, Goal::kSpectralRadius, result_.evaluations + polish / 4);
      Locally(nlopt::LN_SBPLX, Goal::kScore, options_.budget);
    }
    return result_;
  }

 private:
  enum class Goal { kScore, kSpectralRadius };

  std::size_t size() const { return problem_.variables.size(); }

  std::vector<double> Unscaled(const double* unit) const {
    std::vector<double> x(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const SearchVariable& v = problem_.variables[i];
      x[i] = v.low + std::clamp(unit[i], 0.0, 1.0) * (v.high - v.low);
    }
    return x;
  }
  std::vector<double> Scaled(const std::vector<double>& x) const {
    std::vector<double> unit(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const SearchVariable& v = problem_.variables[i];
      unit[i] = std::clamp((x[i] - v.low) / (v.high - v.low), 0.0, 1.0);
    }
    return unit;
  }

  bool Stopped() const { return options_.stop && *options_.stop; }

  double Score(const double* unit) {
    const std::vector<double> x = Unscaled(unit);
    SearchPoint point = EvaluatePoint(problem_, x);
    const double score = point.score;
    last_steady_ = point.verdict <= PointVerdict::kConstraint;
    ++result_.evaluations;
    if (result_.evaluations == 1 || point.score < result_.best.score) {
      result_.best = std::move(point);
      result_.history.push_back({result_.evaluations, score, result_.best.objective});
    }
    if (options_.progress) {
      const std::lock_guard lock(mutex_);
      options_.progress(static_cast<int>(index_), result_.evaluations, result_.best);
    }
    return score;
  }

  // The spectral radius, where there is a steady hop; beyond all of them elsewhere. The point is
  // scored, too.
  double RadiusOf(const double* unit) {
    constexpr double kBeyond = 10.0;
    const double score = Score(unit);
    if (!last_steady_) return kBeyond + score;
    const FixedPoint steady = SteadyHop(problem_.hopper_at(Unscaled(unit)));
    return steady.found() ? std::min(steady.spectral_radius, kBeyond) : kBeyond;
  }

  void Globally(int evaluations) {
    RandomStream random(result_.seed, 1);
    if (options_.algorithm == SearchAlgorithm::kRandom) {
      std::vector<double> unit(size());
      while (result_.evaluations < evaluations && !Stopped()) {
        for (double& u : unit) u = random.Uniform(0.0, 1.0);
        Score(unit.data());
      }
      return;
    }
    const auto entry =
        std::find_if(kAlgorithms.begin(), kAlgorithms.end(),
                     [&](const AlgorithmName& a) { return a.algorithm == options_.algorithm; });
    // DIRECT is deterministic: each seed cuts a little off the box (the polishing sees all of it),
    // so that its searches look at other points.
    const bool cut = options_.algorithm == SearchAlgorithm::kDirectL ||
                     options_.algorithm == SearchAlgorithm::kDirectLRandom;
    std::vector<double> low(size(), 0.0), high(size(), 1.0), start(size());
    for (std::size_t i = 0; i < size(); ++i) {
      if (cut && index_ > 0) {
        low[i] = random.Uniform(0.0, 0.05);
        high[i] = 1.0 - random.Uniform(0.0, 0.05);
      }
      start[i] = random.Uniform(low[i], high[i]);
    }
    Minimize(entry->nlopt, Goal::kScore, low, high, start, evaluations, 0.0);
  }

  void Locally(nlopt::algorithm algorithm, Goal goal, int until) {
    constexpr double kFirstStep = 0.02;  // of the box
    if (until <= result_.evaluations || Stopped()) return;
    Minimize(algorithm, goal, std::vector<double>(size(), 0.0), std::vector<double>(size(), 1.0),
             Scaled(result_.best.x), until - result_.evaluations, kFirstStep);
  }

  void Minimize(nlopt::algorithm algorithm, Goal goal, const std::vector<double>& low,
                const std::vector<double>& high, std::vector<double> unit, int evaluations,
                double first_step) {
    nlopt::srand(static_cast<unsigned long>(result_.seed));  // of this thread only
    nlopt::opt search(algorithm, static_cast<unsigned>(size()));
    search.set_lower_bounds(low);
    search.set_upper_bounds(high);
    search.set_maxeval(evaluations);  // some of NLopt's searches look only now and then
    until_ = result_.evaluations + evaluations;
    search.set_xtol_rel(1e-7);
    if (first_step > 0.0) search.set_initial_step(first_step);
    goal_ = goal;
    search_ = &search;
    search.set_min_objective(&SeedSeeker::Call, this);
    double value = 0.0;
    try {
      search.optimize(unit, value);
    } catch (const nlopt::forced_stop&) {
      if (failure_) std::rethrow_exception(failure_);
    } catch (const nlopt::roundoff_limited&) {
      // As good as it gets: the best point is kept.
    }
  }

  static double Call(unsigned, const double* unit, double*, void* self_pointer) {
    SeedSeeker& self = *static_cast<SeedSeeker*>(self_pointer);
    if (self.Stopped() || self.result_.evaluations >= self.until_) {
      self.search_->force_stop();
      return self.result_.best.score;
    }
    try {
      return self.goal_ == Goal::kScore ? self.Score(unit) : self.RadiusOf(unit);
    } catch (...) {  // NLopt would turn it into another exception
      self.failure_ = std::current_exception();
      self.search_->force_stop();
      return 0.0;
    }
  }

  const SearchProblem& problem_;
  const GainSearchOptions& options_;
  std::size_t index_;
  std::mutex& mutex_;
  SeedResult result_;
  Goal goal_ = Goal::kScore;
  nlopt::opt* search_ = nullptr;
  int until_ = 0;  // evaluations that end `search_`
  std::exception_ptr failure_;
  bool last_steady_ = false;
};

bool Agrees(const SearchPoint& point, const SearchPoint& best) {
  constexpr double kSame = 0.01;
  return point.verdict == best.verdict && std::isfinite(point.objective) &&
         std::abs(point.objective - best.objective) <= kSame * std::abs(best.objective);
}

}  // namespace

std::string_view NameOf(SearchAlgorithm algorithm) {
  for (const AlgorithmName& a : kAlgorithms) {
    if (a.algorithm == algorithm) return a.name;
  }
  return "";
}

std::optional<SearchAlgorithm> FindSearchAlgorithm(std::string_view name) {
  for (const AlgorithmName& a : kAlgorithms) {
    if (a.name == name) return a.algorithm;
  }
  return std::nullopt;
}

std::vector<std::string> SearchAlgorithmNames() {
  std::vector<std::string> names;
  for (const AlgorithmName& a : kAlgorithms) names.emplace_back(a.name);
  return names;
}

GainSearchResult SearchGains(const SearchProblem& problem, const GainSearchOptions& options) {
  GainSearchResult result;
  result.seeds.resize(static_cast<std::size_t>(std::max(options.seeds, 1)));
  std::mutex mutex;
  ParallelFor(static_cast<int>(result.seeds.size()), options.jobs, [&](int i) {
    result.seeds[i] = SeedSeeker(problem, options, static_cast<std::size_t>(i), mutex).Search();
  });
  for (std::size_t i = 0; i < result.seeds.size(); ++i) {
    const SeedResult& seed = result.seeds[i];
    result.evaluations += seed.evaluations;
    if (seed.evaluations > 0 && (result.best.x.empty() || seed.best.score < result.best.score)) {
      result.best = seed.best;
      result.best_seed = i;
    }
  }
  for (const SeedResult& seed : result.seeds) result.agreeing += Agrees(seed.best, result.best);
  if (!result.best.x.empty() && std::isnan(result.best.spectral_radius))
    result.best.spectral_radius = SteadyHop(problem.hopper_at(result.best.x)).spectral_radius;
  result.interrupted = options.stop && *options.stop;
  return result;
}

std::vector<MapCell> MapObjective(const SearchProblem& problem, std::span<const double> at,
                                  int size, int jobs, const std::atomic<bool>* stop,
                                  const std::function<void(int done, int of)>& progress) {
  const int columns = problem.variables.size() > 1 ? size : 1;
  std::vector<MapCell> cells(static_cast<std::size_t>(size) * columns);
  const auto value = [&](std::size_t variable, int i) {
    const SearchVariable& v = problem.variables[variable];
    return size > 1 ? v.low + (v.high - v.low) * i / (size - 1) : 0.5 * (v.low + v.high);
  };
  std::mutex mutex;
  int done = 0;
  ParallelFor(static_cast<int>(cells.size()), jobs, [&](int i) {
    if (stop && *stop) return;
    std::vector<double> x(at.begin(), at.end());
    x[0] = value(0, i / columns);
    if (columns > 1) x[1] = value(1, i % columns);
    cells[i] = {x[0], columns > 1 ? x[1] : std::numeric_limits<double>::quiet_NaN(),
                EvaluatePoint(problem, x)};
    if (!progress) return;
    const std::lock_guard lock(mutex);
    progress(++done, static_cast<int>(cells.size()));
  });
  const auto missing = [](const MapCell& cell) { return cell.point.x.empty(); };
  cells.erase(std::find_if(cells.begin(), cells.end(), missing), cells.end());
  return cells;
}

}  // namespace hoplab
