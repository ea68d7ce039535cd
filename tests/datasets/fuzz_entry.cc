#include "tests/datasets/fuzz_entry.h"

#include <algorithm>
#include <map>
#include <string>

#include "base/check.h"
#include "base/input_error.h"
#include "datasets/read_dataset.h"
#include "datasets/read_scenario.h"
#include "datasets/suspect_things.h"
#include "datasets/write_dataset.h"

namespace hoplab::testing {
namespace {

bool HasDegreesOfItsOwn(const Dataset& a, const Dataset& b) {
  return std::equal(a.trials.begin(), a.trials.end(), b.trials.begin(), b.trials.end(),
                    [](const Trial& x, const Trial& y) {
                      return x.touchdown_angle_rad == y.touchdown_angle_rad;
                    });
}

}  // namespace

void ReadHostileBytes(std::string_view bytes) {
  constexpr std::string_view kSeparator = "%%%\n";
  const std::size_t end = std::min(bytes.find(kSeparator), bytes.size());
  const std::string yaml(bytes.substr(0, end));
  const std::string csv(bytes.substr(std::min(bytes.size(), end + kSeparator.size())));
  try {
    ScenarioDocument::FromText(yaml, "s.yaml").Read();
  } catch (const InputError&) {
  }
  Dataset dataset;
  try {
    dataset = ReadDatasetText(yaml, {{"a.csv", csv}}, "d");
  } catch (const InputError&) {
    return;
  }
  SuspectThings(dataset);
  std::map<std::string, std::string> files = FormatDataset(dataset);
  const Dataset again = ReadDatasetText(files["dataset.yaml"], files, "d");
  HOPLAB_CHECK(HasDegreesOfItsOwn(again, dataset));
  HOPLAB_CHECK(again == dataset);
}

}  // namespace hoplab::testing
