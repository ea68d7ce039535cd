#include "model/integrators/dop853.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/check.h"

namespace hoplab {
namespace {

constexpr int kMaxAttempts = 60;
// Steps shorter than this, over 1 s and the time so far, lead nowhere: a singularity of the
// equations, such as a leg angle whose rate has no bound, holds the state, and each step ends on
// the other side of it.
constexpr double kShortestStep = 1e-11;

// Components are worked on in packs that the compiler keeps in registers. Those past the size of
// the system are zero and stay so.
constexpr int kPack = 4;
typedef double Pack __attribute__((vector_size(kPack * sizeof(double))));

// One component, or a pack of them.
template <class Number>
Number& Part(double* y, int i) {
  return *reinterpret_cast<Number*>(y + i);
}
template <class Number>
const Number& Part(const double* y, int i) {
  return *reinterpret_cast<const Number*>(y + i);
}

// sum_j a_row,j k_j over the stages with a nonzero weight, unrolled.
template <int kRow, class Number, class Stages, std::size_t... kJ>
Number Weighted(const Stages& k, int i, std::index_sequence<kJ...>) {
  Number sum = {};
  ((dop853::kA[kRow][kJ] != 0.0 ? void(sum += dop853::kA[kRow][kJ] * Part<Number>(k[kJ], i))
                                : void()),
   ...);
  return sum;
}

}  // namespace

Dop853::Dop853(const IntegratorOptions& options, const FlatSystem& system)
    : options_(options), system_(system), padded_((system.size + kPack - 1) / kPack * kPack) {
  HOPLAB_CHECK(system.size <= kMaxFlatSize);
  std::fill_n(y0_, padded_, 0.0);
  std::fill_n(y1_, padded_, 0.0);
  for (Vector& k : k_) std::fill_n(k, padded_, 0.0);
}

void Dop853::Start(double t, const double* y, double first_step) {
  t1_ = t;
  std::copy_n(y, system_.size, y1_);
  Evaluate(t, y1_, k_[kNext]);
  next_step_ = first_step;
  last_error_ = 1e-4;
  rejected_ = false;
}

StepStatus Dop853::Step(double t_limit) {
  t0_ = t1_;
  std::copy_n(y1_, padded_, y0_);
  std::copy_n(k_[kNext], padded_, k_[0]);
  const double to_limit = t_limit - t0_;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    double h = next_step_;
    // A step that would leave a sliver takes the sliver along.
    const bool last = std::abs(h) * 1.01 >= std::abs(to_limit);
    if (last) h = to_limit;
    if (std::abs(h) < kShortestStep * (1.0 + std::abs(t0_)) && !last) return StepStatus::kFailed;
    Stages(h);
    const double error = Error(h);
    if (!(error <= 1.0)) {  // also NaN
      const double shrink =
          std::isfinite(error) ? std::max(0.1, 0.9 * std::pow(error, -1.0 / 8.0)) : 0.1;
      next_step_ = h * shrink;
      rejected_ = true;
      continue;
    }
    Evaluate(t0_ + h, y1_, k_[kNext]);
    t1_ = last ? t_limit : t0_ + h;
    h_ = h;
    dense_ready_ = 0;
    // PI controller of Hairer and Wanner (beta = 0.02), and no growth right after a rejection.
    const double bounded = std::max(error, 1e-10);
    double grow = 0.9 * std::pow(bounded, -(1.0 / 8.0 - 0.02 * 0.2)) *
                  std::pow(std::max(last_error_, 1e-10), 0.02);
    grow = std::clamp(grow, 0.2, rejected_ ? 1.0 : 6.0);
    last_error_ = std::max(error, 1e-4);
    rejected_ = false;
    // A step cut short by the limit says little about the step to take next.
    const double proposal = h * grow;
    next_step_ =
        last ? std::copysign(std::max(std::abs(proposal), std::abs(next_step_)), h) : proposal;
    return StepStatus::kOk;
  }
  return StepStatus::kFailed;
}

StepStatus Dop853::EndAt(double t) {
  h_ = t - t0_;
  t1_ = t;
  Stages(h_);
  dense_ready_ = 0;
  Evaluate(t1_, y1_, k_[kNext]);
  return std::isfinite(y1_[0]) ? StepStatus::kOk : StepStatus::kFailed;
}

template <int kRow>
void Dop853::Combine(double h, double* y) const {
  using Stages = std::make_index_sequence<std::min(kRow, dop853::kStagesExtended)>;
  // What the last stage has just written, number by number, is read as it was written: a pack would
  // have to wait for its parts.
  const auto few = [&]<int kSize>(std::integral_constant<int, kSize>) {
    for (int i = 0; i < kSize; ++i) y[i] = y0_[i] + h * Weighted<kRow, double>(k_, i, Stages{});
  };
  switch (system_.size) {
    case 4:
      return few(std::integral_constant<int, 4>{});
    case 5:
      return few(std::integral_constant<int, 5>{});
    case 6:
      return few(std::integral_constant<int, 6>{});
    case 8:
      return few(std::integral_constant<int, 8>{});
    default:
      for (int i = 0; i < padded_; i += kPack)
        Part<Pack>(y, i) = Part<Pack>(y0_, i) + h * Weighted<kRow, Pack>(k_, i, Stages{});
  }
}
template <int kStage>
void Dop853::Stage(double h) {
  alignas(32) Vector y;
  Combine<kStage>(h, y);
  Evaluate(t0_ + dop853::kC[kStage] * h, y, k_[kStage]);
}
void Dop853::Stages(double h) {
  [&]<std::size_t... kI>(std::index_sequence<kI...>) { (Stage<static_cast<int>(kI) + 1>(h), ...); }
  (std::make_index_sequence<dop853::kStages - 1>{});
  Combine<dop853::kStages>(h, y1_);
}

double Dop853::Error(double h) const {
  const double error = ErrorOf(h, 0, system_.controlled, 1, [this](int i) {
    return options_.absolute_tolerance * system_.units[i] +
           options_.relative_tolerance * std::max(std::abs(y0_[i]), std::abs(y1_[i]));
  });
  if (system_.size > system_.controlled && options_.steering != 0)
    return std::fmax(error, SensitivityError(h));
  return error;
}

// The same of the steering directions' sensitivities, each relative to the largest of its
// direction. Infinite where they have left what numbers hold.
double Dop853::SensitivityError(double h) const {
  const int states = system_.controlled, size = system_.size, width = size / states - 1;
  const double tolerance = options_.absolute_tolerance + options_.relative_tolerance;
  double worst = 0.0;
  for (int k = 0; k < width; ++k) {
    if ((options_.steering >> k & 1u) == 0) continue;
    double scale = 1e-30;
    for (int i = states + k; i < size; i += width)
      scale = std::max({scale, std::abs(y0_[i]), std::abs(y1_[i])});
    const double error =
        ErrorOf(h, states + k, size, width, [&](int) { return tolerance * scale; });
    if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, error);
  }
  return worst;
}

// Hairer's combination of the embedded errors of order 5 and 3 of every `stride`-th component, in
// units of `scale_of(i)`.
template <class Scale>
double Dop853::ErrorOf(double h, int begin, int end, int stride, const Scale& scale_of) const {
  double error5 = 0.0, error3 = 0.0;
  int count = 0;
  for (int i = begin; i < end; i += stride, ++count) {
    double e5 = 0.0, e3 = 0.0;
    for (int s = 0; s < dop853::kStages; ++s) {
      e5 += dop853::kE5[s] * k_[s][i];
      e3 += dop853::kE3[s] * k_[s][i];
    }
    const double scale = scale_of(i);
    error5 += e5 / scale * (e5 / scale);
    error3 += e3 / scale * (e3 / scale);
  }
  if (error5 == 0.0 && error3 == 0.0) return 0.0;
  const double norm = error5 + 0.01 * error3;
  return std::abs(h) * error5 / std::sqrt(norm * count);
}

// Of the first `count` components.
void Dop853::PrepareDense(int count) {
  if (count <= dense_ready_) return;
  if (dense_ready_ == 0) {
    Stage<13>(h_);
    Stage<14>(h_);
    Stage<15>(h_);
  }
  for (int i = dense_ready_; i < count; ++i) {
    const double delta = y1_[i] - y0_[i];
    dense_[0][i] = delta;
    dense_[1][i] = h_ * k_[0][i] - delta;
    dense_[2][i] = 2.0 * delta - h_ * (k_[kNext][i] + k_[0][i]);
    for (int d = 0; d < 4; ++d) {
      double sum = 0.0;
      for (int s = 0; s < dop853::kStagesExtended; ++s) sum += dop853::kD[d][s] * k_[s][i];
      dense_[3 + d][i] = h_ * sum;
    }
  }
  dense_ready_ = count;
}

void Dop853::Read(double t, int count, double* y) {
  PrepareDense(count);
  const double x = (t - t0_) / h_;
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int j = dop853::kDensePower - 1; j >= 0; --j)
      sum = (sum + dense_[j][i]) * ((dop853::kDensePower - 1 - j) % 2 == 0 ? x : 1.0 - x);
    y[i] = y0_[i] + sum;
  }
}

}  // namespace hoplab
