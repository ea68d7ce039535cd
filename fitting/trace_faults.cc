#include "fitting/trace_faults.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>

#include "base/nan.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/smoothness.h"
#include "datasets/suspect_things.h"
#include "fitting/falls.h"
#include "fitting/smoothed_ends.h"
#include "fitting/stray_samples.h"

namespace hoplab {
namespace {

constexpr double kRounding = 1e-6;  // of a column's range: less is of no interest
constexpr double kStated = 5.0;     // stated standard deviations, likewise
constexpr double kLeastNoise_m = 1e-5;
constexpr double kMoved_m = 0.003;     // below it a hand has held still
constexpr std::size_t kLeftOver = 10;  // samples: fewer before a catch are no hop

// A ball may be thrown from the ground.
bool IsSaidToFly(const Trial& trial, double lands_m) {
  return trial.mechanism.type == MechanismKind::kBall ||
         (trial.initial && trial.initial->y_m >= lands_m);
}

// Bodies are slow. A hopper's leg is swung ahead at once, and a motor turns as quickly as noise.
bool IsOfBody(Channel c) {
  return c == Channel::kBodyX || c == Channel::kBodyY || c == Channel::kBodyPitch;
}

// A leg at most turns the fastest motion about. A ball may come down faster than it is ever seen.
double BlowOf(const Trial& trial) {
  return trial.mechanism.type == MechanismKind::kBall ? 4.5 : 2.0;
}

Samples SamplesOf(const Trial& trial, const std::vector<double>& values) {
  Samples s;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isnan(values[row])) continue;
    s.t.push_back(trial.trace.time_s[row]);
    s.y.push_back(values[row]);
    s.row.push_back(row);
  }
  s.step = UsualStep(s.t);  // it may be sampled more coarsely than the trace has rows
  return s;
}

// The end that no simulation follows: a hand that catches the body, or its fall. `flown`: the
// heights from the first flight on.
void FindEnd(const Trial& trial, std::size_t place, const Samples& flown, double sigma,
             std::vector<TraceFault>& faults) {
  constexpr double kFallen = 0.25;  // of a leg's height, where simulations end, too
  constexpr double kDoubt = 6.0;
  // A leg carries it at most where it stands upright.
  const double upright_m = TouchdownHeight(trial.mechanism, 0.0);
  if (!(upright_m > 0.0)) return;
  TraceFault end{TraceFault::Kind::kAfterCatch, place, Channel::kBodyY, {}, 0.0};
  std::optional<std::size_t> first = FindCatch(flown, sigma, FreeFall(trial.mechanism), upright_m);
  const bool has_one_leg = trial.mechanism.type == MechanismKind::kCLeg ||
                           trial.mechanism.type == MechanismKind::kStraightLeg;
  if (!first && has_one_leg) {
    end.kind = TraceFault::Kind::kFall;
    const double lands_m = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
    const double lowest_m = trial.mechanism.fall_height_m.value_or(kFallen * upright_m);
    first = FindTopBeforeFall(flown, lands_m, lowest_m, kDoubt * sigma);
    if (first) ++*first;  // the top itself is compared
  }
  if (!first || *first < kLeftOver || *first >= flown.size()) return;
  for (std::size_t row = flown.row[*first]; row < trial.trace.time_s.size(); ++row)
    end.rows.push_back(row);
  faults.push_back(end);
}

// What is before a record's first flight and after its last one: hands that hold the body and catch
// it, a stance, a fall. A clock's motors do not wait for a hand.
void FindEnds(const Trial& trial, std::size_t place, const ChannelSpec& channel,
              std::vector<TraceFault>& faults) {
  const std::vector<double>* values = trial.trace.Find(Channel::kBodyY);
  const bool waits = !trial.controller || !trial.controller->motors ||
                     trial.controller->motors->kind == MotorControl::kHeld;
  if (!values || !waits) return;
  const Samples s = SamplesOf(trial, *values);
  if (s.size() < 2) return;
  const double noise = HighFrequencyNoise(s.t, s.y);
  if (std::isnan(noise)) return;
  const double sigma = std::max({noise, channel.sigma.value_or(0.0), kLeastNoise_m});
  const double g = FreeFall(trial.mechanism);
  const bool in_flight = !trial.initial || trial.initial->mode == StartMode::kFlight;
  const double lands = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
  std::size_t begins = 0;
  if (const auto release = in_flight ? FindRelease(s, sigma, g) : std::nullopt) {
    begins = release->first;
    if (begins + kLeftOver > s.size()) return;
    TraceFault held{TraceFault::Kind::kBeforeRelease, place, Channel::kBodyY, {}, 0.0, *release};
    for (std::size_t row = 0; row < s.row[begins]; ++row) held.rows.push_back(row);
    faults.push_back(held);
  }
  if (const auto top =
          begins == 0 && in_flight && trial.mechanism.type != MechanismKind::kRobot
              ? FindTopAfterStance(s, IsSaidToFly(trial, lands), lands, 3.0 * sigma, kLeftOver)
              : std::nullopt) {
    begins = *top;
    TraceFault stance{TraceFault::Kind::kBeforeFlight, place, Channel::kBodyY, {}, 0.0};
    for (std::size_t row = 0; row < s.row[begins]; ++row) stance.rows.push_back(row);
    faults.push_back(stance);
  }
  FindEnd(trial, place, s.From(begins), sigma, faults);
}

// The rows in which some channel of the body repeats the one before.
std::vector<bool> HeldRows(const Trial& trial, const std::vector<ChannelSpec>& channels) {
  std::vector<bool> rows(trial.trace.time_s.size(), false);
  for (const ChannelSpec& channel : channels) {
    const std::vector<double>* values = trial.trace.Find(channel.id);
    if (!IsOfBody(channel.id) || !values) continue;
    const Samples s = SamplesOf(trial, *values);
    if (s.size() < 2) continue;
    const std::vector<bool> again = RepeatedSamples(s);
    for (std::size_t i = 0; i < s.size(); ++i)
      if (again[i]) rows[s.row[i]] = true;
  }
  return rows;
}

void FindIn(const Trial& trial, std::size_t place, const ChannelSpec& channel,
            const std::vector<bool>& held_rows, std::vector<TraceFault>& faults) {
  const std::vector<double>* values = trial.trace.Find(channel.id);
  if (!values) return;
  const Samples s = SamplesOf(trial, *values);
  if (s.size() < 2) return;
  const std::vector<bool> again = RepeatedSamples(s, held_rows);
  TraceFault held{TraceFault::Kind::kHeld, place, channel.id, {}, 0.0};
  double from = s.y[0];
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (again[i]) held.rows.push_back(s.row[i]);
    if (again[i - 1] && !again[i]) held.largest = std::max(held.largest, std::abs(s.y[i] - from));
    from = s.y[i];
  }
  if (!held.rows.empty()) faults.push_back(held);

  Samples rest = s.Without(again);
  const double sigma = HighFrequencyNoise(rest.t, rest.y);
  if (!(sigma > 0.0)) return;
  rest.step = UsualStep(rest.t);
  const auto [low, high] = std::minmax_element(rest.y.begin(), rest.y.end());
  const double least = std::max(kRounding * (*high - *low), kStated * channel.sigma.value_or(0.0));
  const OffMotion off = FindOffMotion(rest, sigma, least, BlowOf(trial));
  if (!off.stray.empty())
    faults.push_back({TraceFault::Kind::kStray, place, channel.id, off.stray, off.largest_stray});
  if (!off.jumps.empty())
    faults.push_back({TraceFault::Kind::kJump, place, channel.id, off.jumps, off.largest_jump});
}

}  // namespace

std::string_view NameOf(TraceFault::Kind kind) {
  switch (kind) {
    case TraceFault::Kind::kStray:
      return "stray";
    case TraceFault::Kind::kHeld:
      return "held";
    case TraceFault::Kind::kJump:
      return "jump";
    case TraceFault::Kind::kBeforeRelease:
      return "before_release";
    case TraceFault::Kind::kAfterCatch:
      return "after_catch";
    case TraceFault::Kind::kBeforeFlight:
      return "before_flight";
    case TraceFault::Kind::kFall:
      return "fall";
    case TraceFault::Kind::kSmoothedEnd:
      return "smoothed_end";
  }
  return "";
}

std::vector<TraceFault> FindTraceFaults(const Dataset& dataset) {
  std::vector<TraceFault> faults;
  std::vector<std::vector<bool>> held_rows;
  for (const Trial& trial : dataset.trials) held_rows.push_back(HeldRows(trial, dataset.channels));
  for (const ChannelSpec& channel : dataset.channels) {
    if (!IsOfBody(channel.id)) continue;
    for (std::size_t k = 0; k < dataset.trials.size(); ++k)
      FindIn(dataset.trials[k], k, channel, held_rows[k], faults);
    for (std::size_t k = 0; channel.id == Channel::kBodyY && k < dataset.trials.size(); ++k)
      FindEnds(dataset.trials[k], k, channel, faults);
  }
  for (TraceFault& end : FindSmoothedEnds(dataset)) faults.push_back(std::move(end));
  return faults;
}

namespace {

void Erase(std::size_t first, std::size_t last, Trace& trace) {
  const auto erase = [&](std::vector<double>& values) {
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(first),
                 values.begin() + static_cast<std::ptrdiff_t>(last));
  };
  erase(trace.time_s);
  for (TraceColumn& column : trace.columns) erase(column.values);
}

// How far a hand has moved the body along the ground, beyond its noise.
double MovedBefore(const Release& release, const Trial& trial) {
  const std::vector<double>* x = trial.trace.Find(Channel::kBodyX);
  if (!x) return 0.0;
  std::vector<double> held;
  for (std::size_t i = 0; i < x->size() && trial.trace.time_s[i] < release.time_s; ++i)
    if (std::isfinite((*x)[i])) held.push_back((*x)[i]);
  constexpr std::ptrdiff_t kMean = 5;
  if (std::ssize(held) < 2 * kMean) return 0.0;
  const double moved = (std::accumulate(held.end() - kMean, held.end(), 0.0) -
                        std::accumulate(held.begin(), held.begin() + kMean, 0.0)) /
                       static_cast<double>(kMean);
  return std::abs(moved) > kMoved_m ? moved : 0.0;
}

// What is stated is how the body was held at first: it is where the hand has brought it, and has
// fallen since.
void MoveStart(const Release& release, double since, double moved_m, Trial& trial) {
  if (!trial.initial) return;
  const double g = FreeFall(trial.mechanism);
  StateSpec& start = *trial.initial;
  start.x_m += moved_m + start.vx_m_per_s * since;
  start.y_m += release.rise_m + start.vy_m_per_s * since - 0.5 * g * since * since;
  start.vy_m_per_s -= g * since;
  if (start.pitch_rad) *start.pitch_rad += start.pitch_rate_rad_per_s.value_or(0.0) * since;
  if (trial.initial_sigma)
    trial.initial_sigma->vy_m_per_s =
        std::hypot(trial.initial_sigma->vy_m_per_s, g * release.doubt_s);
}

}  // namespace

Dataset WithoutFaults(Dataset dataset, const std::vector<TraceFault>& faults) {
  for (const TraceFault& fault : faults) {
    if (fault.IsAnEnd()) continue;
    for (TraceColumn& column : dataset.trials[fault.trial].trace.columns) {
      if (column.name != ChannelName(fault.channel)) continue;
      if (fault.kind == TraceFault::Kind::kJump)
        std::fill(column.values.begin() + static_cast<std::ptrdiff_t>(fault.rows[0]),
                  column.values.end(), kNaN);
      for (const std::size_t row : fault.rows) column.values[row] = kNaN;
    }
  }
  // Rows are counted as they were recorded: the end goes first.
  for (auto fault = faults.rbegin(); fault != faults.rend(); ++fault) {
    Trial& trial = dataset.trials[fault->trial];
    if (fault->kind == TraceFault::Kind::kAfterCatch || fault->kind == TraceFault::Kind::kFall)
      Erase(fault->rows.front(), trial.trace.time_s.size(), trial.trace);
    if (fault->kind == TraceFault::Kind::kBeforeFlight) {
      Erase(0, fault->rows.back() + 1, trial.trace);
      trial.initial.reset();
      trial.initial_sigma.reset();
    }
    if (fault->kind != TraceFault::Kind::kBeforeRelease) continue;
    const double moved_m = MovedBefore(fault->release, trial);
    Erase(0, fault->rows.back() + 1, trial.trace);
    MoveStart(fault->release, trial.trace.time_s.front() - fault->release.time_s, moved_m, trial);
  }
  return dataset;
}

}  // namespace hoplab
