#include "fitting/diagnosis/own_sizes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/text.h"
#include "fitting/diagnosis/gate.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/score.h"
#include "fitting/diagnosis/verdict.h"

namespace hoplab {
namespace {

constexpr std::size_t kMostOwnTrials = 40;
constexpr std::size_t kShown = 8;
// Of the most that a combination of sizes moves: what moves less is not told by the data, and is
// taken as none. What is fitted may stand for what the sizes have in common.
constexpr double kUndetermined = 1e-3;
// Causes whose shares differ by less do as well; the one of the more usual sizes is told.
constexpr double kAlike = 0.01;
// Sizes that differ explain this share of the misfit more than one size of the cause does. Where
// rows are many, sizes that are all but equal differ for certain, too.
constexpr double kLeastDifferent = 0.1;

// Sizes that the cause can have, but for a tenth of the largest: no drag pushes.
bool InRoom(const Hypothesis& h, const Eigen::VectorXd& sizes) {
  const double doubt = 0.1 * sizes.cwiseAbs().maxCoeff();
  return sizes.minCoeff() >= h.lower[0] - doubt && sizes.maxCoeff() <= h.upper[0] + doubt;
}

// In typical sizes.
double HowUnusual(const OwnSizes& own) {
  double squares = 0.0;
  for (const double size : own.sizes) squares += size * size;
  return std::sqrt(squares) / std::abs(own.cause.Parameter(0).typical);
}

// Place among the members of what explains most of those that act in all trials.
std::optional<std::size_t> LargestInAllTrials(const Naming& naming) {
  std::optional<std::size_t> largest;
  for (std::size_t i = 0; i < naming.best.members.size(); ++i)
    if (naming.best.members[i].in_all() &&
        !(largest && naming.without[*largest].cost >= naming.without[i].cost))
      largest = i;
  return largest;
}

}  // namespace

std::vector<OwnSizes> BestOwnSizes(const Linearisation& at, std::span<const Candidate> candidates,
                                   const std::vector<TrialProblem>& train) {
  const double misfit = at.chi2() - at.degrees_of_freedom();
  const std::size_t n = train.size();
  if (!(misfit > 0.0) || n < 2 || n > kMostOwnTrials || at.trials_left_out > 0) return {};
  // Squares that further sizes must gain, over what any cause gains with one.
  const double price = std::log(static_cast<double>(at.samples)) * static_cast<double>(n - 1);
  std::vector<int> each(n);
  std::iota(each.begin(), each.end(), 0);
  std::vector<OwnSizes> found;
  double with_one = 0.0;
  const std::vector<Hypothesis> hypotheses = HypothesesOf(candidates);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    const int first = hypotheses[i].first;
    const double alike = ScoreOf(at, hypotheses[i]).score;
    with_one = std::max(with_one, alike);
    if (c.parameter_count() != 1 || c.effect->info.has_threshold) continue;
    const Eigen::MatrixXd cut = CutToTrials(at, first, each, static_cast<int>(n));
    const double least = std::sqrt(kInseparable) * at.length[first];
    if (!(cut.colwise().norm().minCoeff() > least) || !cut.allFinite()) continue;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr;
    qr.setThreshold(kUndetermined);
    qr.compute(cut);
    const Eigen::VectorXd sizes = -qr.solve(at.r);
    if (!InRoom(hypotheses[i], sizes)) continue;
    const double gained = at.chi2() - (at.r + cut * sizes).squaredNorm();
    if (gained - alike < kLeastDifferent * misfit) continue;
    const double explained = std::min(gained / misfit, 1.0);
    if (explained >= kLeastOwn) found.push_back({c, {sizes.begin(), sizes.end()}, explained, ""});
  }
  std::erase_if(found,
                [&](const OwnSizes& own) { return own.explained * misfit < with_one + price; });
  std::stable_sort(found.begin(), found.end(),
                   [](const OwnSizes& a, const OwnSizes& b) { return a.explained > b.explained; });
  const auto alike = std::find_if(found.begin(), found.end(), [&](const OwnSizes& own) {
    return found.front().explained - own.explained >= kAlike;
  });
  std::stable_sort(found.begin(), alike, [](const OwnSizes& a, const OwnSizes& b) {
    return HowUnusual(a) < HowUnusual(b);
  });
  return found;
}

std::vector<OwnSizes> PromisingOwnSizes(const Diagnosis& diagnosis,
                                        std::span<const Candidate> candidates,
                                        const std::vector<TrialProblem>& train, int jobs) {
  const auto best_beside = [&](const FittedModel& model, std::span<const Candidate> tested,
                               double& left) {
    Linearisation at = LineariseAt(model, tested, train, jobs);
    at.alike_rows = AlikeRows(train, diagnosis.noise_squares);
    left = LeftShare(diagnosis.detection, at.chi2(), model.parameter_count());
    return BestOwnSizes(at, tested, train);
  };
  double left = 1.0;
  std::vector<OwnSizes> all = best_beside(diagnosis.plain, candidates, left);
  if (const std::optional<std::size_t> largest = LargestInAllTrials(diagnosis.naming)) {
    const Naming& naming = diagnosis.naming;
    FittedModel alone =
        naming.candidates[static_cast<std::size_t>(naming.best_set[*largest])].alone;
    alone.problem.noise = diagnosis.plain.problem.noise;
    if (alone.ok()) {
      for (OwnSizes& own : best_beside(alone, CandidatesBeside(alone, candidates), left)) {
        own.explained = 1.0 - left * (1.0 - own.explained);
        own.beside = naming.best.members[*largest].Name();
        all.push_back(std::move(own));
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const OwnSizes& a, const OwnSizes& b) { return a.explained > b.explained; });
  std::vector<OwnSizes> once;
  for (OwnSizes& own : all)
    if (std::none_of(once.begin(), once.end(),
                     [&](const OwnSizes& o) { return o.cause == own.cause; }))
      once.push_back(std::move(own));
  return once;
}

std::string TextOf(const OwnSizes& own, const std::vector<TrialProblem>& train) {
  const std::string name(own.cause.effect->info.name);
  const std::string with = own.beside.empty() ? "" : own.beside + " in all trials and ";
  std::string text = with + name + " of another size in each trial would explain " +
                     std::to_string(static_cast<int>(100.0 * own.explained)) +
                     " % of the misfit, to first order (";
  for (std::size_t i = 0; i < std::min(own.sizes.size(), kShown); ++i)
    text += (i ? ", " : "") + train[i].file + " " + Rounded(own.sizes[i]);
  text += own.sizes.size() > kShown ? ", ..." : "";
  const std::string_view unit = own.cause.Parameter(0).unit;
  if (unit != "-") text += " " + std::string(unit);
  text += ")";
  if (name == "touchdown_angle_bias")
    text +=
        "; where angles are set by hand, touchdown_angle_sigma_deg lets each trial have its own";
  return text;
}

}  // namespace hoplab
