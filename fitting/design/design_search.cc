#include "fitting/design/design_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/check.h"
#include "base/nan.h"
#include "base/parallel.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/score.h"
#include "optimize/box_search.h"

namespace hoplab {
namespace {

// What the search sees of a design that cannot be simulated: worse than any that can, whose
// logarithm is that of an entropy (at most that of the rivals' number) or of a share.
constexpr double kWorthless = 10.0;
constexpr int kMostAsked = 100;           // designs that are tried with settings off
constexpr double kLeastLogarithm = -1e4;  // of a logarithm, where nothing is left

using Fill = std::function<void(const TrialProblem& trial, DesignTried& tried)>;

double RankOf(const DesignTried& tried) {
  return !tried.failure ? std::max(tried.log_left, kLeastLogarithm) : kWorthless;
}

double Apart(const DesignTried& a, const DesignTried& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.point.size(); ++i)
    most = std::max(most, std::abs(a.point[i] - b.point[i]));
  return most;
}

// Designs with one setting off by its error, either way.
std::vector<std::vector<double>> Neighbours(const std::vector<double>& point) {
  std::vector<std::vector<double>> all;
  for (std::size_t k = 0; k < point.size(); ++k) {
    for (const double by : {-kSettingError, kSettingError}) {
      all.push_back(point);
      all.back()[k] = std::clamp(point[k] + by, 0.0, 1.0);
    }
  }
  return all;
}

class Search {
 public:
  Search(const DesignSearchRequest& request, Fill linearly)
      : request_(request), linearly_(std::move(linearly)) {}

  DesignTried Try(const std::vector<double>& point, const Fill& fill) const {
    DesignTried tried;
    tried.point = point;
    tried.design = request_.space.At(point);
    tried.worth = tried.half_width = tried.least_nats = tried.pair_nats = kNaN;
    fill(TrialOf(tried.design, request_.space.like), tried);
    if (tried.failure) tried.worth = kNaN;
    return tried;
  }

  void Look(DesignSearchResult& out) const {
    const std::size_t n = request_.space.Searched().size();
    if (n == 0) {
      out.tried.push_back(Try({}, linearly_));
      return;
    }
    BoxSearchRequest box;
    box.low.assign(n, 0.0);
    box.high.assign(n, 1.0);
    box.budget = request_.budget;
    box.seed = request_.seed;
    box.stop = request_.stop;
    box.cost = [&](std::span<const double> x) {
      out.tried.push_back(Try({x.begin(), x.end()}, linearly_));
      if (request_.progress) request_.progress(static_cast<int>(out.tried.size()), box.budget);
      return RankOf(out.tried.back());
    };
    SearchBox(box);
    out.interrupted = request_.stop && *request_.stop;
  }

  TrialProblem TrialAt(const std::vector<double>& point) const {
    return TrialOf(request_.space.At(point), request_.space.like);
  }

  // The best of those tried, no two alike. `sturdy`, if given, is asked of the most promising;
  // where none of those is, the best are told as fragile.
  std::vector<DesignTried> Distinct(
      const std::vector<DesignTried>& tried, int count,
      const std::function<bool(const DesignTried&)>& sturdy = nullptr) const {
    std::vector<std::size_t> order(tried.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return RankOf(tried[a]) < RankOf(tried[b]);
    });
    std::vector<DesignTried> distinct, fragile;
    int asked = 0;
    for (const std::size_t i : order) {
      if (static_cast<int>(distinct.size()) == count || tried[i].failure) break;
      const auto differs = [&](const DesignTried& d) { return Apart(d, tried[i]) >= kAlikePlans; };
      if (!std::all_of(distinct.begin(), distinct.end(), differs)) continue;
      if (!sturdy) {
        distinct.push_back(tried[i]);
      } else if (asked < kMostAsked) {
        ++asked;
        if (sturdy(tried[i])) {
          distinct.push_back(tried[i]);
        } else if (std::all_of(fragile.begin(), fragile.end(), differs)) {
          fragile.push_back(tried[i]);
          fragile.back().fragile = true;
        }
      }
    }
    if (!distinct.empty()) return distinct;
    fragile.resize(std::min(fragile.size(), static_cast<std::size_t>(count)));
    return fragile;
  }

  // Worth over each two of the first three settings, the others at their best.
  void Map(DesignSearchResult& out) const {
    const std::vector<DesignRange> searched = request_.space.Searched();
    if (out.best.empty() || request_.map_size < 2 || searched.size() < 2) return;
    std::vector<std::vector<double>> points;
    const std::size_t most = std::min<std::size_t>(searched.size(), 3);
    for (std::size_t a = 0; a < most; ++a) {
      for (std::size_t b = a + 1; b < most; ++b) {
        for (int i = 0; i < request_.map_size * request_.map_size; ++i) {
          std::vector<double> point = out.best.front().point;
          point[a] = static_cast<double>(i % request_.map_size) / (request_.map_size - 1);
          const int row = i / request_.map_size;
          point[b] = static_cast<double>(row) / (request_.map_size - 1);
          points.push_back(std::move(point));
          out.map.push_back({searched[a].setting, searched[b].setting, {}});
        }
      }
    }
    ParallelFor(static_cast<int>(points.size()), request_.jobs, [&](int i) {
      if (request_.stop && *request_.stop) return;
      out.map[i].tried = Try(points[i], linearly_);
    });
    if (request_.stop && *request_.stop) out.map.clear();
  }

 private:
  const DesignSearchRequest& request_;
  Fill linearly_;
};

// What a forecast promises.
void Promise(SeparationForecast forecast, std::span<const FittedModel> rivals,
             std::span<const double> weights, double before, DesignTried& tried) {
  tried.failure = std::move(forecast.failure);
  if (tried.failure) return;
  tried.log_left = LogExpectedEntropy(weights, forecast.nats);
  tried.worth = std::max(before - std::exp(tried.log_left), 0.0);
  tried.least_nats = std::numeric_limits<double>::infinity();
  for (std::size_t r = 1; r < rivals.size(); ++r) {
    const double nats = forecast.nats(0, static_cast<Eigen::Index>(r));
    if (nats >= tried.least_nats) continue;
    tried.least_nats = nats;
    tried.closest_rival = RivalName(rivals[r]);
  }
  tried.pair_nats = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    for (std::size_t j = 0; j < rivals.size(); ++j) {
      const double nats = forecast.nats(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (i == j || nats >= tried.pair_nats) continue;
      tried.pair_nats = nats;
      tried.pair_truth = RivalName(rivals[i]);
      tried.pair_other = RivalName(rivals[j]);
    }
  }
}

}  // namespace

DesignSearchResult SearchSeparating(std::span<const FittedModel> rivals,
                                    std::span<const double> weights,
                                    const std::vector<TrialProblem>& train,
                                    const DesignSearchRequest& request) {
  HOPLAB_CHECK(rivals.size() >= 2 && weights.size() == rivals.size());
  std::vector<RecordedInformation> information(rivals.size());
  ParallelFor(static_cast<int>(rivals.size()), request.jobs,
              [&](int i) { information[i] = InformationOf(rivals[i], train); });
  DesignSearchResult out;
  out.before = EntropyOf(weights);
  // The search is one design after the other: there the pairs of rivals share the threads. Where
  // several designs are tried at once, each has one.
  const auto linearly = [&](int jobs) {
    return Fill([&, jobs](const TrialProblem& trial, DesignTried& tried) {
      Promise(ForecastLinearly(rivals, information, trial, jobs), rivals, weights, out.before,
              tried);
    });
  };
  const Search search(request, linearly(request.jobs));
  search.Look(out);
  const auto sturdy = [&](const DesignTried& tried) {
    const std::vector<std::vector<double>> near = Neighbours(tried.point);
    std::vector<char> through(near.size(), 0);
    ParallelFor(static_cast<int>(near.size()), request.jobs,
                [&](int i) { through[i] = AllGetThrough(rivals, search.TrialAt(near[i])); });
    return std::count(through.begin(), through.end(), 0) == 0;
  };
  const std::vector<DesignTried> promising =
      search.Distinct(out.tried, std::max(request.settled, request.distinct), sturdy);
  std::vector<DesignTried> settled = promising;
  ParallelFor(static_cast<int>(promising.size()), request.jobs, [&](int i) {
    if (request.stop && *request.stop) return;
    settled[i] = search.Try(promising[i].point, [&](const TrialProblem& trial, DesignTried& tried) {
      Promise(ForecastByRefits(rivals, train, trial, request.jobs), rivals, weights, out.before,
              tried);
      tried.refitted = true;
    });
  });
  out.best = search.Distinct(settled, request.distinct);
  Search(request, linearly(1)).Map(out);
  return out;
}

DesignSearchResult SearchSharpening(const FittedModel& model, int parameter,
                                    const std::vector<TrialProblem>& train,
                                    const DesignSearchRequest& request) {
  const RecordedInformation information = InformationOf(model, train);
  DesignSearchResult out;
  out.before = ForecastInterval(model, information, parameter, nullptr).half_width;
  // Against the recorded interval, or, where there is none, the value's scale.
  const double whole = std::isfinite(out.before)
                           ? out.before
                           : model.problem.shared[static_cast<std::size_t>(parameter)].scale;
  const auto tell = [&](const SharpeningForecast& forecast, DesignTried& tried) {
    tried.failure = forecast.failure;
    if (tried.failure) return;
    tried.half_width = forecast.half_width;
    tried.log_left = std::min(std::log(forecast.half_width / whole), 0.5 * kWorthless);
    if (std::isfinite(out.before))
      tried.worth = std::clamp(1.0 - forecast.half_width / out.before, 0.0, 1.0);
    else
      tried.worth = std::isfinite(forecast.half_width) ? 1.0 : 0.0;
  };
  const auto forecast_of = [&](const std::vector<double>& point) {
    const TrialProblem trial = TrialOf(request.space.At(point), request.space.like);
    return ForecastInterval(model, information, parameter, &trial);
  };
  // What is promised also where a setting is off.
  const Fill with_errors = [&](const TrialProblem&, DesignTried& tried) {
    std::vector<std::vector<double>> points = Neighbours(tried.point);
    points.push_back(tried.point);
    std::vector<SharpeningForecast> all(points.size());
    ParallelFor(static_cast<int>(points.size()), request.jobs,
                [&](int i) { all[i] = forecast_of(points[i]); });
    SharpeningForecast worst = all.back();
    for (const SharpeningForecast& f : all) {
      if (!worst.failure && (f.failure || f.half_width > worst.half_width)) worst = f;
    }
    tell(worst, tried);
  };
  const Fill alone = [&](const TrialProblem& trial, DesignTried& tried) {
    tell(ForecastInterval(model, information, parameter, &trial), tried);
  };
  const Search search(request, with_errors);
  search.Look(out);
  out.best = search.Distinct(out.tried, request.distinct);
  const Search single(request, alone);
  if (out.best.empty()) {  // nothing that stands an error of its settings
    single.Look(out);
    out.best = single.Distinct(out.tried, request.distinct);
    for (DesignTried& tried : out.best) tried.fragile = true;
  }
  single.Map(out);
  return out;
}

std::vector<double> WeightsOf(std::span<const FittedModel> rivals) {
  const std::size_t k = rivals.size();
  std::vector<double> weights(k, 1.0 / static_cast<double>(k));
  double most = -std::numeric_limits<double>::infinity();
  for (const FittedModel& r : rivals) {
    if (!r.settled || !std::isfinite(r.evidence.log_z())) return weights;
    most = std::max(most, r.evidence.log_z());
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < k; ++i)
    sum += weights[i] = std::exp(rivals[i].evidence.log_z() - most);
  for (double& w : weights) w /= sum;
  return weights;
}

FittedModel FitWith(const FittedModel& base, const Candidate& candidate, const NoiseModel& near,
                    const RefitSettings& settings) {
  const std::vector<Candidate> added = {candidate};
  const Linearisation at = LineariseAt(base, added, *settings.train, settings.jobs);
  const Score score = ScoreOf(at, HypothesesOf(added).front());
  RefitSettings refit = settings;
  refit.forecast = score.predicted_gain;
  FittedModel best = Refit(base, added, score.size, refit);
  RefitBeyondThresholds(best, base, refit);
  if (!best.ok()) return best;
  best.problem.noise = near;
  best.settled = false;
  Settle(best, settings);
  return best;
}

}  // namespace hoplab
