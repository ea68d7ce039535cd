#include <iostream>

#include "tests/support/diagnosed_hops.h"

// Makes traces with the effect `steady_push`, diagnoses them and prints verdict and group.

int main() {
  using namespace hoplab;
  const Dataset data = testing::DatasetOf({.effects = {testing::EffectOfSize("steady_push", 0.5)}});
  const Diagnosis d =
      Diagnose(data, testing::OptionsWith({"steady_push", "touchdown_loss", "sensor_delay"}));
  std::cout << NameOf(d.verdict);
  for (const std::string& name : testing::GroupNames(d.naming)) std::cout << ' ' << name;
  std::cout << '\n';
}
