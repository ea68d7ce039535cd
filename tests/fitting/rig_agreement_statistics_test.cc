// Another engine's hops (tests/support/beam_rig.h) against our laws, with a camera so good that
// little is hidden: what is not the same, and what of that is the rig's foot.
// ctest -L statistics -R RigAgreement

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "datasets/read_dataset.h"
#include "fitting/fit_dataset.h"
#include "fitting/uncertainty.h"
#include "tests/support/beam_rig.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {
namespace {

struct Agreement {
  double modulus;     // E over that of the rig, less 1
  double relaxation;  // tau over that of the rig, less 1
  double mass;        // of the leg, less the rig's [kg]
  double left;        // root mean square of what neither the model nor the noise is [m]
};

// A leg of 2 g, whose foot meets the floor in every hop with the full blow of the law.
Agreement AgreementOf(int studs) {
  BeamRig rig;
  rig.leg_mass = 0.002;
  rig.noise = 5e-5;
  rig.studs = studs;
  const TempFolder temp;
  RecordRig(rig, temp.path() / "rig");
  ProblemOptions told;
  told.with_effects = {"leg_material_damping", "leg_mass"};
  told.fix = {{"d", 0.0}};
  const int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  FitOptions options;
  options.jobs = jobs;
  const DatasetFit fit = FitDataset(ReadDataset(temp.path() / "rig"), told, options);
  EXPECT_TRUE(fit.result.ok && fit.result.stop.IsMinimum()) << fit.result.message;
  const auto value = [&](const char* name) {
    const auto at =
        std::find_if(fit.problem.shared.begin(), fit.problem.shared.end(),
                     [&](const SharedParameter& parameter) { return parameter.name == name; });
    return fit.result.shared[at - fit.problem.shared.begin()];
  };
  const Uncertainty of = AssessUncertainty(fit.problem, TrialsOf(fit.problem, TrialRole::kTrain),
                                           fit.result.shared, fit.result.initial_states, {}, jobs);
  return {value("E") * StatedSecondMoment() / rig.bending_stiffness - 1.0,
          value("leg_material_damping.tau") / rig.relaxation - 1.0,
          value("leg_mass.m_leg") - rig.leg_mass,
          rig.noise * std::sqrt(std::max(of.chi2_per_dof - 1.0, 0.0))};
}

void Print(const char* foot, const Agreement& a) {
  fmt::print("  {:20} E {:+.2f} %, tau {:+.1f} %, leg {:+.1f} g, {:.0f} um are left\n", foot,
             100.0 * a.modulus, 100.0 * a.relaxation, 1e3 * a.mass, 1e6 * a.left);
  std::fflush(stdout);
}

TEST(RigAgreement, AFootOnItsArcHopsAsOurLawsSay) {
  const Agreement a = AgreementOf(0);
  Print("on the arc", a);
  EXPECT_NEAR(a.modulus, 0.0, 0.001);
  EXPECT_NEAR(a.relaxation, 0.0, 0.01);
  EXPECT_NEAR(a.mass, 0.0, 0.001);
  EXPECT_LT(a.left, 4e-5);
}

// What is off falls with the distance of the studs: it is theirs.
TEST(RigAgreement, AFootOnStudsDoesNot) {
  const Agreement coarse = AgreementOf(4), fine = AgreementOf(12);
  Print("on studs of 2.9 mm", coarse);
  Print("on studs of 1.0 mm", fine);
  EXPECT_GT(coarse.left, 2.0 * fine.left);
  EXPECT_LT(fine.left, 1e-4);
}

}  // namespace
}  // namespace hoplab::testing
