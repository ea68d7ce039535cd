// robot_drop SCENARIO: drops a robot with pitch and two legs, and prints the events of each leg and
// how far the body pitches.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/input_error.h"
#include "datasets/read_scenario.h"
#include "fitting/generate.h"
#include "model/simulate.h"

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  try {
    const hoplab::Scenario scenario = hoplab::ReadScenario(argv[1]);
    hoplab::SimulationRequest request = hoplab::RequestOfScenario(scenario, {});
    // What to sample, and when: every 5 ms.
    const hoplab::Channel channels[] = {hoplab::Channel::kBodyY, hoplab::Channel::kBodyPitch};
    std::vector<double> times;
    for (int i = 0; i <= std::lround(request.horizon / 0.005); ++i) times.push_back(0.005 * i);
    request.channels = channels;
    request.row_times = times;
    const hoplab::Trajectory run = hoplab::Simulate(request);

    for (const hoplab::Event& e : run.events) {
      if (e.kind == hoplab::EventKind::kTouchdown || e.kind == hoplab::EventKind::kLiftoff)
        std::printf("%.4f s  leg %d  %s\n", e.time, e.leg + 1, NameOf(e.kind).data());
    }
    // Samples lie row by row, each row with a number for each channel.
    double lowest = 1.0, pitch = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      lowest = std::min(lowest, run.samples[2 * i]);
      pitch = std::max(pitch, std::abs(run.samples[2 * i + 1]));
    }
    std::printf("lowest %.4f m, pitched by up to %.3f rad\n", lowest, pitch);
    std::printf("ended: %s\n", NameOf(run.outcome).data());
  } catch (const hoplab::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 65;
  }
}
