#include "experiments/identification/identification.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/parallel.h"
#include "fitting/least_squares.h"
#include "optimize/box_search.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr StudyTables kEnergyAlone{true, false, false};
constexpr StudyTables kSmooth{true, true, false};
constexpr StudyTables kAll{true, true, true};

// The misfit of one reading on some tables, as a function of the logarithms of the free constants.
class ReadingProblem {
 public:
  ReadingProblem(const IdentificationRequest& request, const StudyReading& reading,
                 const StudyTables& tables)
      : request_(request), tables_(tables), hopper_{reading, request.fixed, request.integrator} {
    for (StudyConstant c : request.free) {
      if (c == StudyConstant::kGain && !tables.stiffness) continue;  // no torque in table 6.5
      free_.push_back(c);
    }
  }

  StudyFit Globally() { return Search({}); }
  StudyFit From(const StudyConstants& constants) { return Search(constants); }

  // By least squares where that does better; the tables' smooth part alone.
  StudyFit Polished(StudyFit fit) {
    if (Stopped()) return fit;
    LeastSquaresRequest q;
    q.residual_count = ResidualCount(request_.data, tables_);
    q.start = q.lower = q.upper = Eigen::VectorXd(static_cast<Eigen::Index>(free_.size()));
    for (std::size_t i = 0; i < free_.size(); ++i) {
      q.lower[Index(i)] = std::log(InfoOf(free_[i]).low);
      q.upper[Index(i)] = std::log(InfoOf(free_[i]).high);
      q.start[Index(i)] =
          std::clamp(std::log(At(fit.constants, free_[i])), q.lower[Index(i)], q.upper[Index(i)]);
    }
    q.max_iterations = 20;
    q.stop = request_.stop;
    q.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
      ++evaluations_;
      return ResidualsOf(At(x.data()), request_.data, tables_, free_, r, jacobian);
    };
    const LeastSquaresResult solved = SolveLeastSquares(q);
    if (!solved.usable()) return fit;
    const StudyHopper polished = At(solved.x.data());
    const double misfit = MisfitOf(polished, request_.data, tables_);
    if (misfit < fit.misfit) fit = {hopper_.reading, polished.constants, misfit};
    return fit;
  }

  std::vector<StudyDirection> Directions(const StudyConstants& constants) {
    hopper_.constants = constants;
    const Eigen::Index n = static_cast<Eigen::Index>(request_.free.size());
    Eigen::VectorXd residuals(ResidualCount(request_.data, tables_));
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(residuals.size(), n);
    std::vector<StudyDirection> directions;
    if (!ResidualsOf(hopper_, request_.data, tables_, request_.free, residuals, &slopes))
      return directions;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(slopes, Eigen::ComputeFullV);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::VectorXd v = svd.matrixV().col(i);
      const double strength = i < svd.singularValues().size() ? svd.singularValues()[i] : 0.0;
      directions.push_back({strength, {v.begin(), v.end()}});
    }
    return directions;
  }

  long evaluations() const { return evaluations_; }

 private:
  static Eigen::Index Index(std::size_t i) { return static_cast<Eigen::Index>(i); }
  static double At(const StudyConstants& constants, StudyConstant c) {
    return hoplab::At(constants, c);
  }
  StudyHopper At(const double* logarithms) const {
    StudyHopper hopper = hopper_;
    for (std::size_t i = 0; i < free_.size(); ++i)
      hoplab::At(hopper.constants, free_[i]) = std::exp(logarithms[i]);
    return hopper;
  }
  bool Stopped() const { return request_.stop && *request_.stop; }

  StudyFit Search(const std::optional<StudyConstants>& from) {
    BoxSearchRequest q;
    for (StudyConstant c : free_) {
      q.low.push_back(std::log(InfoOf(c).low));
      q.high.push_back(std::log(InfoOf(c).high));
      if (from) q.start.push_back(std::clamp(std::log(At(*from, c)), q.low.back(), q.high.back()));
    }
    q.cost = [&](std::span<const double> x) {
      return MisfitOf(At(x.data()), request_.data, tables_);
    };
    q.budget = request_.budget;
    q.seed = request_.seed;
    q.stop = request_.stop;
    const BoxSearchResult found = SearchBox(q);
    evaluations_ += found.evaluations;
    if (found.x.empty()) return {hopper_.reading, from.value_or(hopper_.constants), kNaN};
    return {hopper_.reading, At(found.x.data()).constants, found.cost};
  }

  const IdentificationRequest& request_;
  StudyTables tables_;
  StudyHopper hopper_;
  std::vector<StudyConstant> free_;
  long evaluations_ = 0;
};

// NaN last, so that what a stop cut short does not lead.
bool IsBetter(double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; }

// Runs `fit_one(i)` for each of `count` readings on `jobs` threads, with progress.
std::vector<StudyFit> FitEach(const IdentificationRequest& request, const std::string& stage,
                              std::size_t count, std::atomic<long>& evaluations,
                              const std::function<StudyFit(std::size_t, long&)>& fit_one) {
  std::vector<StudyFit> fits(count);
  std::mutex mutex;
  int done = 0;
  ParallelFor(static_cast<int>(count), request.jobs, [&](int i) {
    long spent = 0;
    fits[static_cast<std::size_t>(i)] = fit_one(static_cast<std::size_t>(i), spent);
    evaluations += spent;
    if (!request.progress) return;
    const std::lock_guard lock(mutex);
    request.progress(stage, ++done, static_cast<int>(count));
  });
  std::stable_sort(fits.begin(), fits.end(), [](const StudyFit& a, const StudyFit& b) {
    return IsBetter(a.misfit, b.misfit);
  });
  return fits;
}

std::vector<StudyFit> FitEnergy(const IdentificationRequest& request,
                                std::atomic<long>& evaluations) {
  return FitEach(request, "table 6.5", request.readings.size(), evaluations,
                 [&](std::size_t i, long& spent) {
                   ReadingProblem problem(request, request.readings[i], kEnergyAlone);
                   const StudyFit fit = problem.Polished(problem.Globally());
                   spent = problem.evaluations();
                   return fit;
                 });
}

// What rolls and bends, without what damps and when it leaves the ground.
StudyReading FamilyOf(StudyReading reading) {
  reading.variant.damping_rate = {};
  reading.liftoff = {};
  return reading;
}

std::vector<StudyFit> FitStiffness(const IdentificationRequest& request,
                                   const std::vector<StudyFit>& by_energy,
                                   std::atomic<long>& evaluations) {
  std::vector<StudyReading> readings, families;
  for (const StudyFit& fit : by_energy) {
    const StudyReading family = FamilyOf(fit.reading);
    const bool is_known = std::find(families.begin(), families.end(), family) != families.end();
    if (is_known || std::ssize(families) >= request.keep) continue;
    families.push_back(family);
    for (const auto sign :
         {ThesisVariant::TorqueSign::kNormal, ThesisVariant::TorqueSign::kPrinted}) {
      readings.push_back(fit.reading);
      readings.back().variant.torque_sign = sign;
    }
  }
  return FitEach(request, "stiffness", readings.size(), evaluations,
                 [&](std::size_t i, long& spent) {
                   ReadingProblem problem(request, readings[i], kSmooth);
                   StudyFit fit = problem.Polished(problem.Globally());
                   spent = problem.evaluations();
                   return fit;
                 });
}

// The other readings of each fit's family that are asked for, from its constants; the fits first.
std::vector<StudyFit> WithRelatives(std::vector<StudyFit> fits,
                                    const std::vector<StudyReading>& readings) {
  const std::size_t count = fits.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (StudyReading reading : readings) {
      reading.variant.torque_sign = fits[i].reading.variant.torque_sign;
      if (FamilyOf(reading) != FamilyOf(fits[i].reading) || reading == fits[i].reading) continue;
      fits.push_back({reading, fits[i].constants, kNaN});
    }
  }
  return fits;
}

void FitAll(const IdentificationRequest& request, const std::vector<StudyFit>& smooth,
            std::atomic<long>& evaluations, IdentificationResult& result) {
  const auto to_the_end = static_cast<std::size_t>(std::max(request.keep_to_the_end, 1));
  std::vector<StudyFit> fits =
      FitEach(request, "all tables", smooth.size(), evaluations, [&](std::size_t i, long& spent) {
        StudyFit fit = smooth[i];
        const StudyHopper hopper{fit.reading, fit.constants, request.integrator};
        fit.misfit = std::isnan(fit.misfit) ? kNaN : MisfitOf(hopper, request.data, kAll);
        spent = 1;
        return fit;
      });
  const std::vector<StudyFit> kept = WithRelatives(
      {fits.begin(), fits.begin() + static_cast<long>(std::min(to_the_end, fits.size()))},
      request.readings);
  std::vector<StudyFit> polished =
      FitEach(request, "polishing", kept.size(), evaluations, [&](std::size_t i, long& spent) {
        ReadingProblem problem(request, kept[i].reading, kAll);
        const StudyFit fit = problem.From(kept[i].constants);
        spent = problem.evaluations();
        return fit;
      });
  polished.insert(polished.end(), fits.begin(), fits.end());
  std::stable_sort(polished.begin(), polished.end(), [](const StudyFit& a, const StudyFit& b) {
    return IsBetter(a.misfit, b.misfit);
  });
  result.by_all.resize(polished.size());
  ParallelFor(static_cast<int>(polished.size()), request.jobs, [&](int i) {
    const StudyFit& fit = polished[static_cast<std::size_t>(i)];
    result.by_all[static_cast<std::size_t>(i)] = {
        fit, ScoresOf({fit.reading, fit.constants, request.integrator}, request.data)};
  });
}

void FindSpread(IdentificationResult& result) {
  constexpr double kAsGood = 2.0;
  result.low = result.high = result.by_all.front().fit.constants;
  for (const ScoredFit& scored : result.by_all) {
    if (!(scored.fit.misfit <= kAsGood * result.by_all.front().fit.misfit)) continue;
    ++result.as_good;
    for (std::size_t c = 0; c < result.low.size(); ++c) {
      result.low[c] = std::min(result.low[c], scored.fit.constants[c]);
      result.high[c] = std::max(result.high[c], scored.fit.constants[c]);
    }
  }
}

// What each set of tables says about each open point.
std::vector<PointDecision> Decide(const IdentificationResult& result) {
  std::vector<PointDecision> decisions;
  const auto least = [](double a, double b) { return IsBetter(b, a) ? b : a; };
  const auto add = [&](std::string point, std::span<const std::string_view> words, auto word_of) {
    PointDecision decision{std::move(point), {}};
    for (const std::string_view word : words)
      decision.words.push_back({std::string(word), kNaN, kNaN});
    const bool is_in_energy = decision.point != "torque_sign";  // no torque in table 6.5
    for (const StudyFit& fit : result.by_energy) {
      if (!is_in_energy) break;
      double& best = decision.words[static_cast<std::size_t>(word_of(fit.reading))].energy_misfit;
      best = least(best, fit.misfit);
    }
    for (const ScoredFit& scored : result.by_all) {
      double& best =
          decision.words[static_cast<std::size_t>(word_of(scored.fit.reading))].all_misfit;
      best = least(best, scored.fit.misfit);
    }
    decisions.push_back(std::move(decision));
  };
  for (const VariantKey& key : VariantKeys())
    add(std::string(key.key), key.words, [&](const StudyReading& r) { return key.get(r.variant); });
  static constexpr std::array<std::string_view, 2> kLiftoff = {"zero_force", "rest_length"};
  add("liftoff", kLiftoff, [](const StudyReading& r) { return static_cast<int>(r.liftoff); });
  return decisions;
}

}  // namespace

std::vector<StudyReading> AllReadings() {
  std::vector<StudyReading> readings = {StudyReading()};
  for (const VariantKey& key : VariantKeys()) {
    if (key.key == "torque_sign") continue;
    std::vector<StudyReading> longer;
    for (const StudyReading& reading : readings) {
      for (int word = 0; word < static_cast<int>(key.words.size()); ++word) {
        longer.push_back(reading);
        key.set(longer.back().variant, word);
      }
    }
    readings = std::move(longer);
  }
  const std::size_t half = readings.size();
  for (std::size_t i = 0; i < half; ++i) {
    readings.push_back(readings[i]);
    readings.back().liftoff = LiftoffRule::kRestLength;
  }
  return readings;
}

IdentificationResult Identify(const IdentificationRequest& request) {
  std::atomic<long> evaluations{0};
  IdentificationResult result;
  result.by_energy = FitEnergy(request, evaluations);
  const StudyFit& first = result.by_energy.front();
  result.best_by_energy = {
      first, ScoresOf({first.reading, first.constants, request.integrator}, request.data)};
  FitAll(request, FitStiffness(request, result.by_energy, evaluations), evaluations, result);
  FindSpread(result);
  const StudyFit& best = result.by_all.front().fit;
  result.energy_directions =
      ReadingProblem(request, best.reading, kEnergyAlone).Directions(best.constants);
  result.smooth_directions =
      ReadingProblem(request, best.reading, kSmooth).Directions(best.constants);
  result.decisions = Decide(result);
  result.evaluations = evaluations;
  result.interrupted = request.stop && *request.stop;
  return result;
}

}  // namespace hoplab
