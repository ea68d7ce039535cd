// steady_hop SCENARIO: the steady hop of a driven leg, and whether its neighbours come back to it.
// The hop is a fixed point of the map from one apex to the next.
#include <cmath>
#include <cstdio>

#include "base/input_error.h"
#include "datasets/read_scenario.h"
#include "experiments/scenario_hopper.h"
#include "optimize/apex_map.h"
#include "optimize/fixed_point.h"

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  try {
    const hoplab::Scenario scenario = hoplab::ReadScenario(argv[1]);
    const hoplab::Hopper hopper = hoplab::LeggedHopperOfScenario(scenario, {});
    hoplab::ApexMap map(hopper);
    const hoplab::FixedPoint steady = hoplab::SearchFixedPoint(map, hoplab::StartApex(hopper));
    if (!steady.found()) {
      std::printf("no steady hop: %s\n", NameOf(steady.status).data());
      return 1;
    }
    std::printf("apex: %.4f m/s forward, %.4f m high\n", steady.state[0], steady.state[1]);
    std::printf("a hop takes %.4f s and goes %.4f m\n", steady.hop.period, steady.hop.advance);
    // A deviation is multiplied by one of these with each hop.
    for (const auto& m : steady.multipliers)
      std::printf("multiplier of modulus %.4f\n", std::abs(m));
    std::printf("%s\n", steady.stable() ? "stable" : "not stable");
    // The same hop once more, without the search: it must end where it began.
    const hoplab::Hop again = map.Apply(steady.state);
    const bool closed = (again.next - steady.state).norm() < 1e-9;
    std::printf("%s\n", closed ? "the hop ends as it began" : "the hop ends elsewhere");
  } catch (const hoplab::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 65;
  }
}
