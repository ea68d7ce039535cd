#include "fitting/diagnosis/free_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "datasets/read_dataset.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::NullFit;

const ProbeGroup& GroupNamed(const ProbeBasis& basis, const std::string& name) {
  for (const ProbeGroup& g : basis.groups) {
    if (g.name == name) return g;
  }
  throw std::logic_error("no probe group " + name);
}
const ReconstructedForce* ForceNamed(const FreeForces& forces, const std::string& name) {
  for (const ReconstructedForce& f : forces.forces) {
    if (f.group.name == name) return &f;
  }
  return nullptr;
}
double InclusionOf(const ReconstructedForce& force, const std::string& term) {
  for (const RegressionTerm& t : force.terms) {
    if (t.term == term) return t.inclusion;
  }
  return -1.0;
}

// Data in which a probe really acts: the traces shifted by what it does to a simulation.
Dataset WithProbe(const Candidate& probe, double size) {
  const Dataset clean = testing::DatasetOf({});
  const FitProblem with = Extend(MakeProblem(clean, {}), std::array{probe});
  Eigen::VectorXd on(3), off(3);
  on << 22e9, 3.0, size;
  off << 22e9, 3.0, 0.0;
  Dataset d = clean;
  for (std::size_t i = 0; i < d.trials.size(); ++i) {
    const TrialEvaluator evaluator(with, with.trials[i]);
    Trajectory acted, plain;
    evaluator.Simulate({on, with.trials[i].start, false}, with.integrator, acted);
    evaluator.Simulate({off, with.trials[i].start, false}, with.integrator, plain);
    for (std::size_t c = 0; c < 2; ++c) {
      std::vector<double>& values = d.trials[i].trace.columns[c].values;
      for (std::size_t row = 0; row < values.size(); ++row)
        values[row] += acted.samples[2 * row + c] - plain.samples[2 * row + c];
    }
  }
  return d;
}

TEST(FreeForces, AForceThroughAProbeIsFoundWithinItsBand) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  const ProbeGroup& group = GroupNamed(basis, "flight force along x");
  const double push = 0.15;  // N
  const NullFit fit(WithProbe(basis.probes[group.first], push));
  const FreeForces forces = Reconstruct(fit.With(basis.probes), basis, 1);
  const ReconstructedForce* force = ForceNamed(forces, group.name);
  ASSERT_NE(force, nullptr);
  ASSERT_EQ(force->points.size(), 1u);
  EXPECT_LT(force->points[0].band95, 0.5 * push);
  EXPECT_NEAR(force->points[0].value, push, 1.5 * force->points[0].band95);
  EXPECT_LT(force->p_value, 1e-6);
}

TEST(FreeForces, TheMostSignificantComesFirst) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  const ProbeGroup& group = GroupNamed(basis, "touch-down angle");
  const NullFit fit(WithProbe(basis.probes[group.first], 0.03));
  const FreeForces forces = Reconstruct(fit.With(basis.probes), basis, 1);
  for (std::size_t i = 1; i < forces.forces.size(); ++i)
    EXPECT_LE(forces.forces[i - 1].p_value, forces.forces[i].p_value);
  EXPECT_LT(forces.forces.front().p_value, 1e-6);
}

// A place where no stance goes has no force: what would act there moves nothing.
TEST(FreeForces, HaveNoSizeWhereTheDataHardlyGo) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  const ProbeGroup& group = GroupNamed(basis, "chord force, loading");
  ASSERT_GE(group.count, 3);
  Linearisation at = NullFit(testing::World{}).With(basis.probes);
  const int first = group.first;
  ASSERT_GT(Information(at, first + 1), 0.0);
  const FreeForces before = Reconstruct(at, basis, 1);
  EXPECT_TRUE(std::isfinite(ForceNamed(before, group.name)->points[1].value));
  at.columns.col(first + 1) *= 1e-4;
  at.length[first + 1] *= 1e-4;
  const FreeForces after = Reconstruct(at, basis, 1);
  EXPECT_TRUE(std::isnan(ForceNamed(after, group.name)->points[1].value));
  EXPECT_TRUE(std::isfinite(ForceNamed(after, group.name)->points[2].value));
}

TEST(FreeForces, OfCleanDataNoneStandsOut) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  const FreeForces forces = Reconstruct(NullFit(testing::World{}).With(basis.probes), basis, 1);
  ASSERT_FALSE(forces.forces.empty());
  EXPECT_GT(forces.forces.front().p_value, 0.01 / static_cast<double>(forces.forces.size()));
}

// Residuals that a force over the group's coordinate leaves, plus their noise.
template <class Force>
FreeForces Reconstructed(const std::string& group_name, const Force& force) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  const ProbeGroup& group = GroupNamed(basis, group_name);
  Linearisation at = NullFit(testing::World{}).With(basis.probes);
  for (int k = 0; k < group.count; ++k)
    at.r -= force(group.centres[static_cast<std::size_t>(k)]) * at.columns.col(group.first + k);
  return Reconstruct(at, basis, 1);
}

TEST(FreeForces, BandsHoldTheForceWhereTheDataDetermineIt) {
  const auto torque = [](double s) { return 2.0 + 3.0 * s; };
  const FreeForces forces = Reconstructed("hip torque", torque);
  const ReconstructedForce* force = ForceNamed(forces, "hip torque");
  ASSERT_NE(force, nullptr);
  int determined = 0;
  for (const ForcePoint& p : force->points) {
    if (std::isnan(p.band95)) continue;
    ++determined;
    EXPECT_NEAR(p.value, torque(p.at), 1.5 * p.band95) << p.at;
  }
  EXPECT_GE(determined, 3);
}

TEST(FreeForces, TheRegressionFindsTheTermThatActs) {
  const FreeForces forces = Reconstructed("hip torque", [](double s) { return 40.0 * s; });
  const ReconstructedForce* force = ForceNamed(forces, "hip torque");
  ASSERT_NE(force, nullptr);
  EXPECT_GT(InclusionOf(*force, "s"), 0.8);
  for (const char* other : {"1", "s^2", "s^3"})
    EXPECT_LT(InclusionOf(*force, other), InclusionOf(*force, "s")) << other;
}

TEST(FreeForces, TermsAreOnlyLaidOverACoordinate) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  const FreeForces forces = Reconstruct(NullFit(testing::World{}).With(basis.probes), basis, 1);
  for (const ReconstructedForce& f : forces.forces) {
    if (f.group.against.empty()) {
      EXPECT_TRUE(f.terms.empty()) << f.group.name;
    }
    for (const RegressionTerm& t : f.terms) {
      EXPECT_GE(t.inclusion, 0.0);
      EXPECT_LE(t.inclusion, 1.0);
    }
  }
}

TEST(FreeForces, RepeatWithTheSameSeed) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  const Linearisation at = NullFit(testing::World{}).With(basis.probes);
  const FreeForces one = Reconstruct(at, basis, 4), two = Reconstruct(at, basis, 4);
  ASSERT_EQ(one.forces.size(), two.forces.size());
  for (std::size_t i = 0; i < one.forces.size(); ++i) {
    for (std::size_t t = 0; t < one.forces[i].terms.size(); ++t)
      EXPECT_EQ(one.forces[i].terms[t].inclusion, two.forces[i].terms[t].inclusion);
  }
}

// An encoder that reads 2 % too much, or 10 mrad, is found as that.
TEST(FreeForces, AReadingOfAMotorsAngleIsFound) {
  for (const auto& [gain, offset] : {std::pair{0.02, 0.0}, {0.0, 0.01}}) {
    Dataset robot = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/robot-drops");
    for (Trial& trial : robot.trials)
      for (TraceColumn& column : trial.trace.columns)
        for (double& value : column.values)
          if (column.name == "leg_angle_2_rad") value += gain * value + offset;
    const ProbeBasis basis = ProbesOf(Law::kRobot);
    const NullFit fit(robot);
    const FreeForces forces = Reconstruct(fit.With(basis.probes), basis, 1);
    ASSERT_EQ(forces.forces.front().group.name, "reading of leg_angle_2");
    const std::vector<ForcePoint>& found = forces.forces.front().points;
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].value, offset, 1.5 * found[0].band95 + 0.001);
    EXPECT_NEAR(found[1].value, gain, 1.5 * found[1].band95 + 0.002);
  }
}

TEST(Probes, EveryProbeIsInOneGroupOfItsHypothesis) {
  for (Law law : {Law::kThesis, Law::kConsistent, Law::kLargeDeflection, Law::kBall, Law::kRobot}) {
    const ProbeBasis basis = ProbesOf(law);
    int next = 0;
    for (std::size_t g = 0; g < basis.groups.size(); ++g) {
      EXPECT_EQ(basis.groups[g].first, next);
      EXPECT_EQ(basis.hypotheses[g].first, next);
      EXPECT_EQ(basis.hypotheses[g].count, basis.groups[g].count);
      EXPECT_EQ(static_cast<int>(basis.groups[g].centres.size()), basis.groups[g].count);
      next += basis.groups[g].count;
    }
    EXPECT_EQ(next, static_cast<int>(basis.probes.size()));
  }
}

TEST(Probes, ChangeNothingAtTheirNull) {
  const ProbeBasis basis = ProbesOf(Law::kLargeDeflection);
  for (const Candidate& probe : basis.probes) {
    EXPECT_EQ(probe.parameter_count(), 1);
    EXPECT_TRUE(EffectSetting::Null(*probe.effect).IsNull());
    EXPECT_EQ(probe.effect->info.parameters[0].null, 0.0);
  }
}

TEST(Probes, AGuardOffsetIsAmongThem) {
  // A basis of forces alone never saw a sloping ground, which acts through the guard.
  std::set<std::string> names;
  for (const ProbeGroup& g : ProbesOf(Law::kLargeDeflection).groups) names.insert(g.name);
  EXPECT_TRUE(names.count("touch-down angle"));
  EXPECT_TRUE(names.count("contact height"));
}

}  // namespace
}  // namespace hoplab
