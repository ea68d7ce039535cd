// Google Benchmark over the simulator and the fit: absolute times and how they grow. The table
// against other tools is compare.cc's.
#include <benchmark/benchmark.h>

#include "bench/odeint_stance.h"
#include "bench/problems.h"
#include "bench/rig_fit.h"
#include "bench/robot_second.h"
#include "model/mechanisms/leg.h"

namespace hoplab::bench {
namespace {

void Run(benchmark::State& state, SimulationRequest request,
         IntegratorKind kind = IntegratorKind::kDop853, Outcome end = Outcome::kHopLimit) {
  request.integrator.kind = kind;
  Trajectory out;
  for (auto _ : state) {
    Simulate(request, out);
    benchmark::DoNotOptimize(out.end_time);
  }
  if (out.outcome != end) state.SkipWithError(SentenceOf(out.outcome).data());
  state.counters["steps"] = static_cast<double>(out.steps);
}

// The argument is the number of sensitivity directions.
void Stance(benchmark::State& state, Law law) {
  Run(state, StanceRequest(law, static_cast<int>(state.range(0))));
}
void Hop(benchmark::State& state, Law law) {
  Run(state, HopRequest(law, static_cast<int>(state.range(0))));
}
void TenHops(benchmark::State& state, Law law) {
  Run(state, TenHopRequest(law, static_cast<int>(state.range(0))));
}
void StanceBy(benchmark::State& state, IntegratorKind kind) {
  Run(state, StanceRequest(Law::kLargeDeflection, static_cast<int>(state.range(0))), kind);
}

void Robot(benchmark::State& state, double leg_mass_kg) {
  Run(state, RobotSecond(static_cast<int>(state.range(0)), leg_mass_kg), IntegratorKind::kDop853,
      Outcome::kCompleted);
}

void StanceByOdeint(benchmark::State& state, Law law) {
  const std::array<double, 4> body = TouchdownState(law);
  SystemStorage<double> mechanism;
  LegLawOf(law).body.Make<double>({law, LegParameters(law), {}, {}}, mechanism);
  PeerStance stance;
  for (auto _ : state) {
    stance = OdeintStance(*mechanism, body, IntegratorOptions{});
    benchmark::DoNotOptimize(stance.liftoff_time);
  }
  state.counters["rhs"] = static_cast<double>(stance.rhs_calls);
}

void ArcStanceByOdeint(benchmark::State& state) { StanceByOdeint(state, Law::kLargeDeflection); }
void StraightStanceByOdeint(benchmark::State& state) { StanceByOdeint(state, Law::kStraightLeg); }

void WholeFit(benchmark::State& state) {
  for (auto _ : state) {
    const FitResult fit = FitRigDrops();
    if (!fit.ok) state.SkipWithError(fit.message.c_str());
  }
}

constexpr auto kMicro = benchmark::kMicrosecond;
#define HOPLAB_OVER_DIRECTIONS Arg(0)->Arg(4)->Arg(16)->Unit(kMicro)
BENCHMARK_CAPTURE(Stance, large_deflection, Law::kLargeDeflection)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(Stance, consistent, Law::kConsistent)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(Stance, straight_leg, Law::kStraightLeg)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(Hop, large_deflection, Law::kLargeDeflection)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(Hop, consistent, Law::kConsistent)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(TenHops, large_deflection, Law::kLargeDeflection)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(TenHops, consistent, Law::kConsistent)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(StanceBy, erkstep, IntegratorKind::kErkStep)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(StanceBy, cvodes, IntegratorKind::kCvodes)->HOPLAB_OVER_DIRECTIONS;
BENCHMARK_CAPTURE(Robot, light_legs, 0.0)->Arg(0)->Arg(20)->Unit(kMicro);
BENCHMARK_CAPTURE(Robot, legs_of_10_g, 0.010)->Arg(0)->Arg(20)->Unit(kMicro);
BENCHMARK(ArcStanceByOdeint)->Unit(kMicro);
BENCHMARK(StraightStanceByOdeint)->Unit(kMicro);
BENCHMARK(WholeFit)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace hoplab::bench

BENCHMARK_MAIN();
