#include "fitting/diagnosis/energy_ledger.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/nan.h"
#include "fitting/apex_segments.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

// The first flight is read up to this share of the time to its touch-down: models and data differ
// about the rest.
constexpr double kFlightShare = 0.8;
constexpr int kFewestRows = 6;

using State = Eigen::Vector4d;

// Energy in flight by the mass and the gravity of a model in one trial.
class Scale {
 public:
  Scale(const FittedModel& model, const TrialProblem& trial) {
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

// The time at which a flight is read, and the rows it is read from.
struct Window {
  double from, to, at;  // s
};

// State that a parabola through a flight shows; NaN where it does not. The place along x is not
// needed.
State StateShown(const FitProblem& problem, const TrialProblem& trial, const Window& window,
                 double g) {
  State state(0.0, kNaN, kNaN, kNaN);
  const std::size_t width = problem.channels.size();
  for (std::size_t c = 0; c < width; ++c) {
    const Channel channel = problem.channels[c].channel;
    if (channel != Channel::kBodyX && channel != Channel::kBodyY) continue;
    const bool vertical = channel == Channel::kBodyY;
    Eigen::MatrixX2d A(trial.row_times.size(), 2);
    Eigen::VectorXd b(trial.row_times.size());
    Eigen::Index rows = 0;
    for (std::size_t row = 0; row < trial.row_times.size(); ++row) {
      const double time = trial.row_times[row], v = trial.data[row * width + c];
      if (time < window.from || time > window.to || std::isnan(v)) continue;
      const double t = time - window.at;
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

// The trial with what a simulation reports in the place of what was measured.
TrialProblem WithData(const TrialProblem& trial, const Trajectory& simulated) {
  TrialProblem out = trial;
  out.data = simulated.samples;
  return out;
}

// Whether the data tell the speed along the ground: a track does, and a ball that is dropped has
// none.
bool ShowsSpeed(const FitProblem& problem, const TrialProblem& trial) {
  if (problem.law == Law::kBall && trial.start[2] == 0.0) return true;
  return std::any_of(problem.channels.begin(), problem.channels.end(),
                     [](const ChannelProblem& c) { return c.channel == Channel::kBodyX; });
}

// Times of the first and the last event that is no apex; NaN without one.
std::pair<double, double> Contacts(const Trajectory& t) {
  std::pair<double, double> times = {kNaN, kNaN};
  for (const Event& e : t.events) {
    if (e.kind == EventKind::kApex) continue;
    if (std::isnan(times.first)) times.first = e.time;
    times.second = e.time;
  }
  return times;
}

Window FirstFlight(const Trajectory& t) { return {0.0, kFlightShare * Contacts(t).first, 0.0}; }
Window LastFlight(const Trajectory& t, double end) {
  return {end - kFlightShare * (end - Contacts(t).second), end, end};
}
bool BeginsAndEndsInFlight(const Trajectory& t) {
  return !std::isnan(Contacts(t).first) && t.final_mode == Mode::kFlight;
}

// Hops of a whole trace, from its start to its first apex after a stance and on from apex to apex.
std::vector<HopBalance> BalancesOf(const FitProblem& problem, const TrialProblem& trial,
                                   const Window& first_flight, const Scale& scale) {
  std::vector<HopBalance> hops;
  const std::vector<TrialProblem> pieces = CutAtApexes(problem, trial);
  double begin = scale.EnergyOf(StateShown(problem, trial, first_flight, scale.gravity()));
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const double end = scale.EnergyOf(pieces[k].start.head<4>());
    hops.push_back({begin, end});
    begin = end;
  }
  return hops;
}

EnergyLedger LedgerOfTrial(const FittedModel& model, std::size_t i, const HeldOutErrors& before,
                           const HeldOutErrors* after) {
  const TrialProblem& trial = model.problem.trials[i];
  EnergyLedger ledger{trial.recording, {}};
  const Trajectory& simulated = before.trials[i].trajectory;
  if (std::isnan(Contacts(simulated).first)) return ledger;
  const Scale scale(model, trial);
  const Window first = FirstFlight(simulated);
  const auto balances = [&](const TrialProblem& shown) {
    return BalancesOf(model.problem, shown, first, scale);
  };
  const std::vector<HopBalance> measured = balances(trial);
  const std::vector<HopBalance> old = balances(WithData(trial, simulated));
  const std::vector<HopBalance> now =
      after ? balances(WithData(trial, after->trials[i].trajectory)) : std::vector<HopBalance>();
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

// Trials that are single hops: each is simulated from a start of its own.
EnergyLedger LedgerOfHops(const FittedModel& model, const std::vector<std::size_t>& trials,
                          const HeldOutErrors& before, const HeldOutErrors* after) {
  EnergyLedger ledger{model.problem.trials[trials.front()].recording, {}};
  for (std::size_t k = 0; k + 1 < trials.size(); ++k) {
    if (trials[k + 1] != trials[k] + 1) continue;  // a hop between them was not simulated
    const TrialProblem &trial = model.problem.trials[trials[k]],
                       &next = model.problem.trials[trials[k + 1]];
    const Scale scale(model, trial);
    const auto shown = [&](const TrialProblem& data, const Window& window) {
      return scale.EnergyOf(StateShown(model.problem, data, window, scale.gravity()));
    };
    const auto simulated = [&](const TrialErrors& e) {
      if (!BeginsAndEndsInFlight(e.trajectory)) return HopBalance{kNaN, kNaN};
      const TrialProblem data = WithData(trial, e.trajectory);
      return HopBalance{shown(data, FirstFlight(e.trajectory)),
                        shown(data, LastFlight(e.trajectory, trial.row_times.back()))};
    };
    const Trajectory& old = before.trials[trials[k]].trajectory;
    const double begin = k > 0
                             ? scale.EnergyOf(trial.start.head<4>())
                             : (BeginsAndEndsInFlight(old) ? shown(trial, FirstFlight(old)) : kNaN);
    HopEnergy hop{
        {begin, scale.EnergyOf(next.start.head<4>())}, simulated(before.trials[trials[k]]), {}};
    if (after) hop.after = simulated(after->trials[trials[k]]);
    ledger.hops.push_back(hop);
  }
  return ledger;
}

}  // namespace

EnergyLedger LedgerOf(const FittedModel& model, const HeldOutErrors& before,
                      const HeldOutErrors* after) {
  EnergyLedger best;
  bool best_is_held_out = false;
  const std::vector<TrialProblem>& trials = model.problem.trials;
  std::map<std::string, std::vector<std::size_t>> recordings;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const bool complete = before.trials[i].complete && (!after || after->trials[i].complete);
    if (complete && ShowsSpeed(model.problem, trials[i]))
      recordings[trials[i].recording].push_back(i);
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
