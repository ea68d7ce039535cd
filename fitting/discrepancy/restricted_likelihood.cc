#include "fitting/discrepancy/restricted_likelihood.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "fitting/shared_bounds.h"
#include "fitting/trial_noise.h"

namespace hoplab {
namespace {

// A diagonal of R below this share of its column's length: a direction nothing sees.
constexpr double kColumnTolerance = 1e-10;

// Sum of the logarithms of the diagonal of R over its first `count` columns, what nothing sees left
// out.
double LogDiagonal(const Eigen::MatrixXd& R, Eigen::Index count, const Eigen::VectorXd& length) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double d = std::abs(R(k, k));
    if (d > kColumnTolerance * length[k]) sum += std::log(d);
  }
  return sum;
}

Eigen::MatrixXd UpperOf(const RowMajorMatrix& block) {
  const Eigen::MatrixXd whole = block;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(whole);
  const Eigen::Index rows = std::min(whole.rows(), whole.cols());
  return qr.matrixQR().topRows(rows).template triangularView<Eigen::Upper>();
}

std::size_t StepFor(std::size_t samples, std::size_t most_samples) {
  return std::max<std::size_t>(1, samples / std::max<std::size_t>(most_samples, 1));
}

}  // namespace

LikelihoodDetail LikelihoodDetail::Coarse() {
  LikelihoodDetail detail;
  detail.rows_a_channel = 150;
  detail.most_samples = 20'000;
  return detail;
}

RestrictedLikelihood::RestrictedLikelihood(const FitProblem& problem,
                                           const std::vector<TrialProblem>& trials,
                                           const Eigen::VectorXd& shared,
                                           const std::vector<OwnValues>& initial_states, int jobs,
                                           const LikelihoodDetail& detail)
    : channels_(static_cast<Eigen::Index>(problem.channels.size())), jobs_(jobs) {
  for (int k = 0; k < problem.shared_count(); ++k) {
    const bool bound = IsHeldOrOnBound(problem.shared[static_cast<std::size_t>(k)], shared[k]);
    (bound ? bound_ : free_).push_back(k);
  }
  SetPriorWidths(detail.prior_widths);
  for (const TrialProblem& t : trials) samples_ += static_cast<std::size_t>(t.sample_count);
  const std::size_t step = StepFor(samples_, detail.most_samples);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < trials.size(); i += step) places.push_back(i);
  std::vector<std::optional<Part>> made(places.size());
  ParallelFor(static_cast<int>(places.size()), jobs, [&](int i) {
    const std::size_t place = places[static_cast<std::size_t>(i)];
    std::optional<Part>& part = made[static_cast<std::size_t>(i)];
    part = Make(problem, trials[place], shared, initial_states[place]);
    if (!part) return;
    part->place = place;
    if (detail.rows_a_channel > 0) Average(*part, detail.rows_a_channel);
  });
  for (std::optional<Part>& part : made) {
    complete_ = complete_ && part;
    if (part) parts_.push_back(std::move(*part));
  }
  Summarise();
}

RestrictedLikelihood RestrictedLikelihood::With(const LikelihoodDetail& detail) const {
  RestrictedLikelihood other = *this;
  other.SetPriorWidths(detail.prior_widths);
  const std::size_t step = StepFor(samples_, detail.most_samples);
  std::erase_if(other.parts_, [step](const Part& part) { return part.place % step != 0; });
  if (detail.rows_a_channel > 0) {
    ParallelFor(static_cast<int>(other.parts_.size()), jobs_, [&](int i) {
      Average(other.parts_[static_cast<std::size_t>(i)], detail.rows_a_channel);
    });
  }
  other.Summarise();
  return other;
}

void RestrictedLikelihood::SetPriorWidths(const Eigen::VectorXd& widths) {
  prior_widths_.resize(0);
  if (widths.size() == 0) return;
  const std::vector<int> columns = Columns();
  prior_widths_.resize(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    prior_widths_[static_cast<Eigen::Index>(k)] = widths[columns[k]];
}

// What all trials tell together.
void RestrictedLikelihood::Summarise() {
  root_mean_square_.clear();
  longest_ = 0.0;
  Eigen::ArrayXd square = Eigen::ArrayXd::Zero(channels_), count = square;
  double rows = 0.0, seconds = 0.0;
  for (const Part& part : parts_) {
    square += part.squares;
    count += part.counts;
    longest_ = std::max(longest_, 0.5 * part.seconds);
    rows += part.rows;
    seconds += part.seconds;
  }
  shortest_ = rows > 0.0 ? 3.0 * seconds / rows : 0.0;
  for (Eigen::Index c = 0; c < channels_; ++c)
    root_mean_square_.push_back(count[c] > 0.0 ? std::sqrt(square[c] / count[c]) : 0.0);
}

std::vector<int> RestrictedLikelihood::Columns() const {
  std::vector<int> columns = free_;
  columns.insert(columns.end(), bound_.begin(), bound_.end());
  return columns;
}

std::optional<RestrictedLikelihood::Part> RestrictedLikelihood::Make(const FitProblem& problem,
                                                                     const TrialProblem& trial,
                                                                     const Eigen::VectorXd& shared,
                                                                     const OwnValues& own) const {
  const TrialEvaluator evaluator(problem, trial);
  TrialEvaluation e;
  EvaluationRequest request{shared, own, true};
  request.whiten = false;
  evaluator.Evaluate(request, e);
  if (!e.complete) return std::nullopt;
  Part part;
  part.channels = evaluator.channel_rows();
  part.averaged.assign(part.channels.size(), 1.0);
  for (std::size_t c = 0; c < part.channels.size(); ++c)
    part.factors.push_back(NoiseFactorIn(trial, c));

  const std::vector<int> columns = Columns();
  const auto width = static_cast<Eigen::Index>(columns.size());
  const int n = problem.shared_count();
  part.block.resize(e.residuals.size(), trial.own_count() + width + 1);
  for (int k = 0; k < trial.own_count(); ++k) {
    const OwnParameter& o = trial.own[static_cast<std::size_t>(k)];
    if (o.free && e.jacobian.col(n + k).squaredNorm() > 0.0)
      part.block.col(part.own++) = e.jacobian.col(n + k) * o.scale;
  }
  for (Eigen::Index k = 0; k < width; ++k) {
    const auto place = static_cast<std::size_t>(columns[static_cast<std::size_t>(k)]);
    // Of what is held the likelihood says nothing.
    const double scale = problem.shared[place].held ? 0.0 : problem.shared[place].scale;
    part.block.col(part.own + k) = e.jacobian.col(static_cast<Eigen::Index>(place)) * scale;
  }
  part.block.col(part.own + width) = e.residuals;
  part.block.conservativeResize(Eigen::NoChange, part.own + width + 1);

  const auto channels = static_cast<Eigen::Index>(problem.channels.size());
  part.squares = part.counts = Eigen::ArrayXd::Zero(channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    const double factor = part.factors[static_cast<std::size_t>(c)];
    for (const int row : part.channels[static_cast<std::size_t>(c)].rows) {
      part.squares[c] += std::pow(factor * e.residuals[row], 2);
      part.counts[c] += 1.0;
    }
  }
  part.rows = static_cast<double>(trial.row_times.size());
  part.seconds = trial.row_times.back();
  return part;
}

// Means of some rows following each other, times the root of their number: white noise of size one
// stays of size one, and what is slower than a mean grows by the root.
void RestrictedLikelihood::Average(Part& part, std::size_t most) {
  Eigen::Index samples = 0, rows = 0;
  for (std::size_t c = 0; c < part.channels.size(); ++c) {
    const std::size_t count = part.channels[c].rows.size();
    const std::size_t together = std::max<std::size_t>(1, (count + most - 1) / most);
    part.averaged[c] = static_cast<double>(together);
    samples += static_cast<Eigen::Index>(count);
    rows += static_cast<Eigen::Index>((count + together - 1) / together);
  }
  // Contact times and priors follow the samples.
  const Eigen::Index others = part.block.rows() - samples;
  RowMajorMatrix out(rows + others, part.block.cols());
  int next = 0;
  for (std::size_t c = 0; c < part.channels.size(); ++c) {
    const ChannelRows all = std::move(part.channels[c]);
    ChannelRows mean;
    const auto together = static_cast<std::size_t>(part.averaged[c]);
    for (std::size_t first = 0; first < all.rows.size(); first += together) {
      const std::size_t end = std::min(first + together, all.rows.size());
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(part.block.cols());
      double time = 0.0;
      for (std::size_t k = first; k < end; ++k) {
        sum += part.block.row(all.rows[k]);
        time += all.times[k];
      }
      const auto count = static_cast<double>(end - first);
      out.row(next) = sum / std::sqrt(count);
      mean.rows.push_back(next++);
      mean.times.push_back(time / count);
    }
    part.channels[c] = std::move(mean);
  }
  out.bottomRows(others) = part.block.bottomRows(others);
  part.block = std::move(out);
}

RowMajorMatrix RestrictedLikelihood::Whitened(const NoiseModel& noise, double& log_sum) const {
  const auto width = static_cast<Eigen::Index>(free_.size() + bound_.size());
  std::vector<double> logs(parts_.size(), 0.0);
  std::vector<Eigen::MatrixXd> rest(parts_.size());
  ParallelFor(static_cast<int>(parts_.size()), jobs_, [&](int i) {
    const Part& part = parts_[static_cast<std::size_t>(i)];
    RowMajorMatrix block = part.block;
    double log_of_part = 0.0;
    for (std::size_t c = 0; c < part.channels.size(); ++c) {
      const double ratio = noise.AmplitudeOf(c) / part.factors[c] * std::sqrt(part.averaged[c]);
      if (!(ratio > 0.0)) continue;
      const ChannelRows& at = part.channels[c];
      log_of_part += WhitenMatern(at.times, at.rows, ratio, noise.time_scale, block);
    }
    const Eigen::VectorXd length = block.colwise().norm();
    const Eigen::MatrixXd R = UpperOf(block);
    const Eigen::Index own = std::min<Eigen::Index>(part.own, R.rows());
    logs[static_cast<std::size_t>(i)] = log_of_part + LogDiagonal(R, own, length);
    rest[static_cast<std::size_t>(i)] = R.bottomRightCorner(R.rows() - own, width + 1);
  });
  log_sum = 0.0;
  Eigen::Index rows = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    log_sum += logs[i];
    rows += rest[i].rows();
  }
  RowMajorMatrix all(rows, width + 1);
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& r : rest) {
    all.middleRows(at, r.rows()) = r;
    at += r.rows();
  }
  return all;
}

double RestrictedLikelihood::At(const NoiseModel& noise) const {
  double log_sum = 0.0;
  const RowMajorMatrix whitened = Whitened(noise, log_sum);
  const auto free = static_cast<Eigen::Index>(free_.size());
  const Eigen::Index width = whitened.cols() - 1, rows = whitened.rows();
  const Eigen::Index priors = prior_widths_.size();
  RowMajorMatrix all = RowMajorMatrix::Zero(std::max(rows + priors, width + 1), width + 1);
  all.topRows(rows) = whitened;
  for (Eigen::Index k = 0; k < priors; ++k) all(rows + k, k) = 1.0 / prior_widths_[k];
  const Eigen::VectorXd length = all.colwise().norm();
  const Eigen::MatrixXd R = UpperOf(all);
  // Values on bounds stay there: what they could still explain counts as left over.
  const double left = R.col(width).tail(width + 1 - free).squaredNorm();
  return -0.5 * left - log_sum - LogDiagonal(R, free, length);
}

ValueLikelihood RestrictedLikelihood::ValuesAt(const NoiseModel& noise) const {
  ValueLikelihood out;
  double log_sum = 0.0;
  const RowMajorMatrix whitened = Whitened(noise, log_sum);
  const Eigen::Index width = whitened.cols() - 1;
  RowMajorMatrix all = RowMajorMatrix::Zero(std::max(whitened.rows(), width + 1), width + 1);
  all.topRows(whitened.rows()) = whitened;
  const Eigen::MatrixXd R = UpperOf(all);
  const std::vector<int> columns = Columns();
  out.root.resize(width, width);
  for (Eigen::Index k = 0; k < width; ++k)
    out.root.col(columns[static_cast<std::size_t>(k)]) = R.col(k).head(width);
  out.rest = R.col(width).head(width);
  out.log_constant = -0.5 * R(width, width) * R(width, width) - log_sum;
  return out;
}

}  // namespace hoplab
