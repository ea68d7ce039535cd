#include "bench/robot_comparison.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/robot_second.h"
#ifdef HOPLAB_BENCH_BEAMS
#include "bench/beam_robot.h"
#endif

namespace hoplab::bench {
namespace {

constexpr double kBeamLegs = 0.010;  // kg
#ifdef HOPLAB_BENCH_BEAMS
// A chain of 24 hinges gives a little more than a strip: a tenth of what the legs give, 5 mm.
constexpr double kAgreementMetres = 5e-4, kAgreementRadians = 4e-3;
#endif

}  // namespace

RobotComparison::RobotComparison(RoundRobin& timer) : timer_(timer) {
  for (const double leg_mass : {0.0, kBeamLegs})
    for (const int directions : {0, 20}) {
      Run run{directions, leg_mass, 0, std::make_shared<Trajectory>()};
      run.timing = timer_.Add("robot", [request = RobotSecond(directions, leg_mass),
                                        out = run.out] { Simulate(request, *out); });
      runs_.push_back(std::move(run));
    }
}

void RobotComparison::Lap() {
#ifdef HOPLAB_BENCH_BEAMS
  const BeamSecond theirs = RunBeamSecond();
  beams_.seconds.push_back(theirs.seconds);
  step_ = theirs.step;
  SimulationRequest request = RobotSecond();
  request.horizon = kEarly;
  const std::vector<double> ours = Simulate(request).final_state;
  apart_m_ = std::max(std::abs(ours[0] - theirs.early[0]), std::abs(ours[1] - theirs.early[1]));
  apart_rad_ = std::abs(ours[4] - theirs.early[2]);
#endif
}

bool RobotComparison::Collect(Report& report) const {
  bool ran = true;
  for (const Run& run : runs_) {
    const Timing& timing = timer_.timing(run.timing);
    const char* what =
        run.leg_mass > 0.0 ? "one second, two legs of 10 g" : "one second, two legs without mass";
    report.simulations.push_back({"robot", "dop853", what, run.directions, timing});
    report.bounds.push_back({fmt::format("{}, {} sensitivities", what, run.directions),
                             1e3 * timing.Min(), run.directions > 0 ? 6.0 : 1.0, true, "ms"});
    if (run.out->outcome == Outcome::kCompleted) continue;
    ran = false;
    report.notes.push_back(
        fmt::format("FAILED: A robot did not run: {}", SentenceOf(run.out->outcome)));
  }
#ifdef HOPLAB_BENCH_BEAMS
  report.notes.push_back(fmt::format(
      "One second of a robot, MuJoCo with two legs of 24 arcs at its step of {:g} s: {:.3g} s, "
      "{:.0f} x ours ({} steps). The two are {:.2g} mm and {:.2g} mrad apart in the first stance.",
      step_, beams_.Min(), beams_.Min() / timer_.timing(OfBeams().timing).Min(),
      OfBeams().out->steps, 1e3 * apart_m_, 1e3 * apart_rad_));
  if (!(apart_m_ < kAgreementMetres && apart_rad_ < kAgreementRadians)) {
    ran = false;
    report.notes.push_back("FAILED: The robot in MuJoCo does something else.");
  }
#else
  report.notes.push_back("Left out, not installed: MuJoCo (libmujoco-dev).");
#endif
  return ran;
}

}  // namespace hoplab::bench
