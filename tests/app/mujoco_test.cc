// An exported MJCF model, run by MuJoCo from the recorded initial states, beside hoplab's own
// trajectory.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/hoplab_process.h"
#include "tests/support/beam_rig.h"
#include "tests/support/csv_rows.h"
#include "tests/support/mujoco_model.h"

namespace hoplab::testing {
namespace {

using Json = nlohmann::json;

// Body's places of one trial at their times, from the tables beside a run.
struct Motion {
  std::vector<double> t, x, y;
  double liftoff = 0.0, apex = 0.0;  // of the first hop
};

std::map<std::string, Motion> MotionsOf(const std::filesystem::path& run) {
  std::map<std::string, Motion> motions;
  for (const auto& row :
       CsvRows(run / "trajectories.csv", {"trial", "time_s", "body_x_m", "body_y_m"})) {
    Motion& m = motions[row[0]];
    m.t.push_back(std::stod(row[1]));
    m.x.push_back(std::stod(row[2]));
    m.y.push_back(std::stod(row[3]));
  }
  for (const auto& row : CsvRows(run / "events.csv", {"trial", "time_s", "event"})) {
    Motion& m = motions[row[0]];
    const double time = std::stod(row[1]);
    if (row[2] == "liftoff" && m.liftoff == 0.0) m.liftoff = time;
    if (row[2] == "apex" && m.apex == 0.0 && m.liftoff > 0.0) m.apex = time;
  }
  return motions;
}

// Distance of the two bodies over the first hop, up to its apex: root of the mean square [m].
double FirstHopRms(const mjModel& model, const std::string& trial, const Motion& motion) {
  const MujocoData data = NewData(model);
  const int key = mj_name2id(&model, mjOBJ_KEY, trial.c_str());
  EXPECT_GE(key, 0) << trial;
  mj_resetDataKeyframe(&model, data.get(), key);
  double sum = 0.0;
  int rows = 0;
  for (std::size_t i = 0; i < motion.t.size() && motion.t[i] <= motion.apex; ++i) {
    while (data->time < motion.t[i] - 0.5 * model.opt.timestep) mj_step(&model, data.get());
    const double dx = data->qpos[0] - motion.x[i], dy = data->qpos[1] - motion.y[i];
    sum += dx * dx + dy * dy;
    ++rows;
  }
  EXPECT_GT(rows, 100);
  EXPECT_TRUE(std::isfinite(sum));
  return std::sqrt(sum / rows);
}

class Mujoco : public ::testing::Test {
 protected:
  void Fit(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"fit", ShippedDataset("rig-drops"), "--quiet", "--out",
                                      "run"};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult run = RunHoplab(words, temp_.path());
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  MujocoModel Export(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"export", "run", "--mujoco", "leg.xml", "--force"};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult run = RunHoplab(words, temp_.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return LoadMujoco(temp_.path() / "leg.xml");
  }
  // Over all trials.
  double Rms(const mjModel& model) {
    double sum = 0.0, worst = 0.0;
    const std::map<std::string, Motion> motions = MotionsOf(temp_.path() / "run");
    EXPECT_EQ(motions.size(), 9u);
    for (const auto& [trial, motion] : motions) {
      const double rms = FirstHopRms(model, trial, motion);
      sum += rms * rms;
      worst = std::max(worst, rms);
    }
    std::printf(" first hop of 9 trials: rms %.3f mm, worst trial %.3f mm\n",
                1e3 * std::sqrt(sum / 9.0), 1e3 * worst);
    return std::sqrt(sum / 9.0);
  }
  TempFolder temp_;
};

constexpr double kBound = 1e-3;  // m

TEST_F(Mujoco, TheExportedLegHopsAsHoplabSays) {
  Fit({"--with", "leg_material_damping,leg_mass", "--fix", "d=0"});
  std::vector<double> rms;
  for (const char* arcs : {"6", "12", "24"}) {
    const MujocoModel model = Export({"--arcs", arcs});
    ASSERT_TRUE(model);
    std::printf("  %s arcs:", arcs);
    rms.push_back(Rms(*model));
  }
  EXPECT_LT(rms[1], 0.5 * rms[0]) << "more arcs come closer";
  EXPECT_LT(rms[2], rms[1]);
  EXPECT_LT(rms[2], kBound);
}

// M113 beside a chain of arcs that stands 5 mm outside the line of its hinges.
TEST_F(Mujoco, ALegOnASoleHopsAsHoplabSays) {
  Fit({"--with", "leg_material_damping,leg_mass,sole_thickness", "--fix", "d=0", "--fix",
       "sole_thickness.h_sole=0.005", "--fix", "leg_material_damping.tau=400e-6", "--fix",
       "leg_mass.m_leg=0.01"});
  const MujocoModel model = Export({});
  ASSERT_TRUE(model);
  std::printf("  on a sole of 5 mm:");
  EXPECT_LT(Rms(*model), kBound);
}

// M124 beside a chain of arcs that are bent more at one end than at the other.
TEST_F(Mujoco, ALegThatIsNoCircleHopsAsHoplabSays) {
  for (const char* chi : {"0.04", "-0.04"}) {
    Fit({"--with", "leg_material_damping,leg_mass,uneven_curvature", "--fix", "d=0", "--fix",
         "uneven_curvature.chi=" + std::string(chi), "--fix", "leg_material_damping.tau=400e-6",
         "--fix", "leg_mass.m_leg=0.01", "--force"});
    const MujocoModel model = Export({});
    ASSERT_TRUE(model);
    std::printf("  chi = %s:", chi);
    EXPECT_LT(Rms(*model), kBound) << chi;
  }
}

// A leg that damps along its chord has no counterpart in a chain of arcs: the model says so, and
// comes as near as the fit does to what it was fitted to.
TEST_F(Mujoco, ADamperAlongTheChordIsToldAndReplaced) {
  Fit({});
  const MujocoModel model = Export({"--arcs", "12", "--leg-mass", "0.01"});
  ASSERT_TRUE(model);
  EXPECT_NE(ReadText(temp_.path() / "leg.xml").find("which loses at touch-down"),
            std::string::npos);
  EXPECT_LT(Rms(*model), 5e-3);
}

// A leg of 20 g, another damping than the rigs', other motors: modulus, damping and mass come back.
TEST_F(Mujoco, AnExportedLegOf20gIsFittedFromItsHops) {
  Fit({"--with", "leg_material_damping", "--fix", "d=0", "--fix",
       "leg_material_damping.tau=500e-6"});
  const auto value = [](const Json& run, const std::string& name) {
    for (const Json& p : run.at("parameters"))
      if (p.at("name") == name) return p.at("value").get<double>();
    return std::nan("");
  };
  const double modulus = value(Json::parse(ReadText(temp_.path() / "run/run.json")), "E");
  const MujocoModel model = Export({"--leg-mass", "0.02"});
  ASSERT_TRUE(model);
  RecordHops({.hold_stiffness = 10.0, .hold_damping = 0.08, .release = 0.0, .seed = 7}, *model,
             temp_.path() / "drops");
  const ProcessResult run = RunHoplab({"fit", "drops", "--with", "leg_material_damping,leg_mass",
                                       "--fix", "d=0", "--json", "--out", "again"},
                                      temp_.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json again = Json::parse(run.out);
  const double E = value(again, "E"), tau = value(again, "leg_material_damping.tau"),
               mass = value(again, "leg_mass.m_leg");
  std::printf("  E %+.2f %%, tau %.0f us of 500, leg %.1f g of 20\n", 100.0 * (E / modulus - 1.0),
              1e6 * tau, 1e3 * mass);
  EXPECT_NEAR(E, modulus, 0.005 * modulus);
  EXPECT_NEAR(tau, 500e-6, 15e-6);
  EXPECT_NEAR(mass, 0.02, 0.005);
}

// The rig as it is stated: a guide leaves one way, friction of hip and guide is where MuJoCo has
// it.
TEST_F(Mujoco, TheRigIsTheOneOfTheRun) {
  const std::string scenario = std::string(HOPLAB_SOURCE_DIR) + "/experiments/three-drops.yaml";
  const ProcessResult run = RunHoplab(
      {"simulate", scenario, "--set", "mechanism.guide=vertical", "--set", "initial.vx_m_per_s=0",
       "--set", "dataset=null", "--with", "hip_viscous_friction:b_h=0.004", "--with",
       "guide_coulomb_friction:f_c=0.3", "--with", "leg_mass:m_leg=0.05", "--out", "run"},
      temp_.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const MujocoModel model = Export({"--arcs", "16"});
  ASSERT_TRUE(model);
  EXPECT_EQ(model->nq, 17);  // up, the hip and 15 hinges
  EXPECT_EQ(mj_name2id(model.get(), mjOBJ_JOINT, "body_x"), -1);
  const int up = mj_name2id(model.get(), mjOBJ_JOINT, "body_y");
  const int hip = mj_name2id(model.get(), mjOBJ_JOINT, "hip");
  ASSERT_GE(std::min(up, hip), 0);
  EXPECT_EQ(model->dof_frictionloss[model->jnt_dofadr[up]], 0.3);
  EXPECT_EQ(model->dof_damping[model->jnt_dofadr[hip]], 0.004);
  double mass = 0.0;
  for (int i = 0; i < model->nbody; ++i) mass += model->body_mass[i];
  EXPECT_NEAR(mass, 1.0, 1e-12);
  EXPECT_NEAR(mass - model->body_mass[mj_name2id(model.get(), mjOBJ_BODY, "body")], 0.05, 1e-12);
  // A torque that is positive pushes the hip forward: theta falls (section 4 of the sheet).
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  data->qpos[0] = 1.0;
  data->ctrl[0] = 0.01;
  mj_forward(model.get(), data.get());
  EXPECT_LT(data->qacc[model->jnt_dofadr[hip]], 0.0);
}

}  // namespace
}  // namespace hoplab::testing
