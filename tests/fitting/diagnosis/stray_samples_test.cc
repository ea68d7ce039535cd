// Data of another engine, one sample in a hundred of which lies elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "base/random.h"
#include "datasets/read_dataset.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {
namespace {

Dataset RigWithStraySamples() {
  Dataset rig = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/rig-drops");
  RandomStream random(11, 1);
  for (Trial& trial : rig.trials)
    for (TraceColumn& column : trial.trace.columns) {
      if (column.name != "body_x_m" && column.name != "body_y_m") continue;
      for (double& value : column.values)
        if (random.Uniform(0.0, 1.0) < 0.01) value += 0.02 * random.Normal();
    }
  return rig;
}

std::set<std::string> MainCausesOf(const Dataset& dataset, bool keep_stray) {
  DiagnosisOptions options;
  options.fit.jobs = 2;
  options.problem.keep_stray = keep_stray;
  options.candidates.only = {"leg_material_damping",   "leg_mass",  "leg_hysteresis",
                             "guide_coulomb_friction", "foot_slip", "sensor_scale_y"};
  const Diagnosis d = Diagnose(dataset, options);
  std::set<std::string> names;
  if (d.verdict == Verdict::kNamed && d.extension)
    for (const CauseReport* cause : d.extension->MainCauses()) names.insert(cause->cause.Name());
  return names;
}

TEST(StraySamples, HideNoCauseAndMakeNone) {
  const std::set<std::string> there = {"leg_material_damping", "leg_mass"};
  const Dataset rig = RigWithStraySamples();
  EXPECT_EQ(MainCausesOf(rig, false), there);
  EXPECT_NE(MainCausesOf(rig, true), there);
}

}  // namespace
}  // namespace hoplab
