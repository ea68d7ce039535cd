#include "fitting/diagnosis/energy_ledger.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "fitting/apex_segments.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// The first flight is read up to this share of the time to its touch-down: models and data differ
// about the rest.
constexpr double kFlightShare = 0.8;
constexpr int kFewestRows = 6;

using State = std::array<double, 4>;

// Energy in flight by the mass and the gravity of a model in one trial.
class Scale {
 public:
  Scale(const Extension& model, const TrialProblem& trial) {
    request_.law = model.problem.law;
    request_.liftoff = trial.liftoff;
    request_.parameters = trial.parameters;
    ApplyShared(model.problem, trial, model.shared, request_.parameters, effects_);
    request_.effects = effects_;
  }
  Scale(const Scale&) = delete;
  Scale& operator=(const Scale&) = delete;

  double EnergyOf(const State& s) const {
    const std::array<double, 5> state = {s[0], s[1], s[2], s[3], 0.0};
    return Energy(request_, Mode::kFlight, state);
  }
  double gravity() const { return request_.parameters.g; }

 private:
  SimulationRequest request_;
  std::vector<EffectSetting> effects_;
};

// State at the first row as a parabola through the first flight shows it; NaN where it does not.
State StartShown(const FitProblem& problem, const TrialProblem& trial, double until, double g) {
  State state = {0.0, kNaN, kNaN, kNaN};
  const std::size_t width = problem.channels.size();
  for (std::size_t c = 0; c < width; ++c) {
    const Channel channel = problem.channels[c].channel;
    if (channel != Channel::kBodyX && channel != Channel::kBodyY) continue;
    const bool vertical = channel == Channel::kBodyY;
    Eigen::MatrixX2d A(trial.row_times.size(), 2);
    Eigen::VectorXd b(trial.row_times.size());
    Eigen::Index rows = 0;
    for (std::size_t row = 0; row < trial.row_times.size(); ++row) {
      const double t = trial.row_times[row], v = trial.data[row * width + c];
      if (t > until || std::isnan(v)) continue;
      A.row(rows) << 1.0, t;
      b[rows++] = vertical ? v + 0.5 * g * t * t : v;
    }
    if (rows < kFewestRows) continue;
    const Eigen::Vector2d line = A.topRows(rows).colPivHouseholderQr().solve(b.head(rows));
    state[vertical ? 1 : 0] = line[0];
    state[vertical ? 3 : 2] = line[1];
  }
  return state;
}

// States at the apexes after a stance, in order.
std::vector<State> ApexesOf(const Trajectory& trajectory) {
  std::vector<State> apexes;
  bool stance = false;
  for (const Event& e : trajectory.events) {
    if (e.kind == EventKind::kApex && stance) apexes.push_back({e.x, e.y, e.vx, e.vy});
    stance = e.kind != EventKind::kApex;
  }
  return apexes;
}

std::vector<HopBalance> BalancesOf(const State& start, const std::vector<State>& apexes,
                                   const Scale& scale) {
  std::vector<HopBalance> hops;
  double begin = scale.EnergyOf(start);
  for (const State& apex : apexes) {
    const double end = scale.EnergyOf(apex);
    hops.push_back({begin, end});
    begin = end;
  }
  return hops;
}

// Apexes of whole traces.
EnergyLedger LedgerOfTrial(const Extension& model, std::size_t i, const HeldOutErrors& before,
                           const HeldOutErrors* after) {
  const TrialProblem& trial = model.problem.trials[i];
  EnergyLedger ledger{trial.recording, {}};
  const std::vector<TrialProblem> pieces = CutAtApexes(model.problem, trial);
  if (pieces.size() < 2) return ledger;
  const Scale scale(model, trial);
  std::vector<State> shown;
  for (std::size_t k = 1; k < pieces.size(); ++k) shown.push_back(pieces[k].start);
  const Trajectory& simulated = before.trials[i].trajectory;
  double touchdown = 0.0;
  for (const Segment& s : simulated.segments) {
    if (s.mode != Mode::kFlight) break;
    touchdown = s.end;
  }
  const State start = StartShown(model.problem, trial, kFlightShare * touchdown, scale.gravity());
  const std::vector<HopBalance> measured = BalancesOf(start, shown, scale);
  const std::vector<HopBalance> old =
      BalancesOf(before.trials[i].start, ApexesOf(simulated), scale);
  const std::vector<HopBalance> now =
      after ? BalancesOf(after->trials[i].start, ApexesOf(after->trials[i].trajectory), scale)
            : std::vector<HopBalance>();
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const auto at = [k](const std::vector<HopBalance>& hops) {
      return k < hops.size() ? hops[k] : HopBalance{kNaN, kNaN};
    };
    HopEnergy hop{measured[k], at(old), std::nullopt};
    if (after) hop.after = at(now);
    ledger.hops.push_back(hop);
  }
  return ledger;
}

double EnergyAtEnd(const Trajectory& trajectory, const Scale& scale) {
  const std::vector<double>& s = trajectory.final_state;
  if (trajectory.final_mode != Mode::kFlight || s.size() < 4) return kNaN;
  return scale.EnergyOf({s[0], s[1], s[2], s[3]});
}

// Trials that are single hops: each begins at its own start and ends near the next apex.
EnergyLedger LedgerOfHops(const Extension& model, const std::vector<std::size_t>& trials,
                          const HeldOutErrors& before, const HeldOutErrors* after) {
  EnergyLedger ledger{model.problem.trials[trials.front()].recording, {}};
  for (std::size_t k = 0; k + 1 < trials.size(); ++k) {
    if (trials[k + 1] != trials[k] + 1) continue;  // a hop between them was not simulated
    const TrialProblem &trial = model.problem.trials[trials[k]],
                       &next = model.problem.trials[trials[k + 1]];
    const Scale scale(model, trial);
    // The first start is the nominal one, not read off the trace.
    const double begin = k > 0 ? scale.EnergyOf(trial.start) : kNaN;
    const auto simulated = [&](const TrialErrors& e) {
      return HopBalance{scale.EnergyOf(e.start), EnergyAtEnd(e.trajectory, scale)};
    };
    HopEnergy hop{{begin, scale.EnergyOf(next.start)}, simulated(before.trials[trials[k]]), {}};
    if (after) hop.after = simulated(after->trials[trials[k]]);
    ledger.hops.push_back(hop);
  }
  return ledger;
}

}  // namespace

EnergyLedger LedgerOf(const Extension& model, const HeldOutErrors& before,
                      const HeldOutErrors* after) {
  EnergyLedger best;
  bool best_is_held_out = false;
  const std::vector<TrialProblem>& trials = model.problem.trials;
  std::map<std::string, std::vector<std::size_t>> recordings;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const bool complete = before.trials[i].complete && (!after || after->trials[i].complete);
    if (complete) recordings[trials[i].recording].push_back(i);
  }
  for (const auto& [recording, places] : recordings) {
    const bool held_out = trials[places.front()].role == TrialRole::kTest;
    if (best_is_held_out && !held_out) continue;
    const bool single_hops = trials[places.front()].file != recording;
    EnergyLedger ledger = single_hops ? LedgerOfHops(model, places, before, after)
                                      : LedgerOfTrial(model, places.front(), before, after);
    if (ledger.hops.empty()) continue;
    if (ledger.hops.size() > best.hops.size() || (held_out && !best_is_held_out)) {
      best = std::move(ledger);
      best_is_held_out = held_out;
    }
  }
  return best;
}

}  // namespace hoplab
