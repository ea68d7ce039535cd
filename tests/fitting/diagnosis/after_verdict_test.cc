#include "fitting/diagnosis/after_verdict.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::DatasetOf;
using testing::EffectOfSize;
using testing::OptionsWith;

const DiagnosisOptions& LookAlikeOptions() {
  static const DiagnosisOptions options = OptionsWith({"touchdown_loss", "touchdown_angle_bias"});
  return options;
}

// Two causes that do as well, without what is told beside the verdict.
Diagnosis LookAlikes() {
  static const Diagnosis told =
      Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_loss", 0.02)}, .seed = 7}),
               LookAlikeOptions());
  Diagnosis d = told;
  d.experiment.reset();
  d.candidate_gains.clear();
  return d;
}

TEST(AfterVerdict, ATrialIsProposedWhereACauseIsTold) {
  Diagnosis d = LookAlikes();
  ASSERT_EQ(d.verdict, Verdict::kConfounded);
  TellBesides(d, LookAlikeOptions());
  ASSERT_TRUE(d.experiment);
  EXPECT_GT(d.experiment->expected_nats, 0.0);
  EXPECT_EQ(d.candidate_gains.size(), 2u);
  // Which of two wrong names does as well is no question to record a trial for.
  Diagnosis unexplained = LookAlikes();
  unexplained.verdict = Verdict::kUnexplained;
  TellBesides(unexplained, LookAlikeOptions());
  EXPECT_FALSE(unexplained.experiment);
  EXPECT_EQ(unexplained.candidate_gains.size(), 2u);
  EXPECT_TRUE(std::any_of(unexplained.candidate_gains.begin(), unexplained.candidate_gains.end(),
                          [](const auto& gain) { return gain && gain->nats_per_sample > 0.0; }));
}

// A model whose own noise was not sought is compared under the noise of that without causes: one
// that changes nothing gains nothing.
TEST(AfterVerdict, ACandidateIsMeasuredOnHeldOutTrialsAsTheModelWithoutIs) {
  Diagnosis d = LookAlikes();
  d.null.problem.noise.amplitude.assign(d.problem.channels.size(), 2.0);
  d.null.problem.noise.time_scale = 0.05;
  d.before = MeasureHeldOut(d.null, 1);
  CandidateResult idle = d.naming.candidates.front();
  const std::vector<Candidate> added = {idle.candidate};
  idle.alone = d.plain;
  idle.alone.members = added;
  idle.alone.problem = Extend(d.plain.problem, added);
  idle.alone.shared.resize(d.null.shared.size() + 1);
  idle.alone.shared << d.null.shared, NullValues(added);
  idle.alone.settled = false;
  idle.gain = 10.0;
  d.naming.candidates = {idle};
  d.naming.rivals.clear();
  TellBesides(d, LookAlikeOptions());
  ASSERT_TRUE(d.candidate_gains.front());
  EXPECT_NEAR(d.candidate_gains.front()->nats_per_sample, 0.0, 1e-6);
}

// A track and its camera that are tilted turn gravity, which looks like a force.
TEST(AfterVerdict, AForceIsToldAsATiltOfGroundAndCameraToo) {
  const DiagnosisOptions options = OptionsWith({"constant_force"});
  Diagnosis d = Diagnose(DatasetOf({.effects = {EffectOfSize("constant_force", -0.2)}}), options);
  ASSERT_TRUE(d.extension);
  const auto tilts = [&] {
    return std::count_if(d.notes.begin(), d.notes.end(), [](const std::string& note) {
      return note.find("the camera is turned with it") != std::string::npos;
    });
  };
  EXPECT_EQ(tilts(), 1);
  const auto& p = d.problem.trials[0].parameters;
  const double degrees = 0.2 / (p.m * p.g) * 180.0 / 3.14159265;
  const std::string& note = d.notes.back();
  const std::size_t at = note.find("rises by ");
  ASSERT_NE(at, std::string::npos) << note;
  EXPECT_NEAR(std::stod(note.substr(at + 9)), degrees, 0.1 * degrees);
  EXPECT_EQ(std::count_if(LookAlikes().notes.begin(), LookAlikes().notes.end(),
                          [](const std::string& other) {
                            return other.find("the camera is turned") != std::string::npos;
                          }),
            0);
  // A tilt is the same in all trials.
  d.notes.clear();
  for (CauseReport& cause : d.extension->causes) cause.cause.each_trial = true;
  TellBesides(d, options);
  EXPECT_EQ(tilts(), 0);
}

// Twice the mass and twice all forces is the same motion.
TEST(AfterVerdict, AStiffnessIsThatOfTheStatedMassWhereNothingWeighsTheBody) {
  const auto tells = [](const Diagnosis& d) {
    return std::any_of(d.notes.begin(), d.notes.end(), [](const std::string& note) {
      return note.starts_with("E is that of a body of ");
    });
  };
  const DiagnosisOptions options = OptionsWith({"air_drag", "body_mass_scale"});
  EXPECT_TRUE(tells(Diagnose(DatasetOf({}), options)));
  // A length beside it does not grow with the mass.
  DiagnosisOptions with_length = options;
  with_length.problem.free = {"r", "E", "d"};
  EXPECT_TRUE(tells(Diagnose(DatasetOf({}), with_length)));
  // A stated modulus weighs it.
  DiagnosisOptions known = OptionsWith({"air_drag", "body_mass_scale"});
  known.problem.fix = {{"E", 22e9}};
  EXPECT_FALSE(tells(Diagnose(DatasetOf({}), known)));
}

// Roughly is not "nothing": with much noise no usual error of the mass would show.
TEST(AfterVerdict, AStatedModulusWeighsTheBodyRoughlyWhereMuchIsNoise) {
  DiagnosisOptions known = OptionsWith({"air_drag", "body_mass_scale"});
  known.problem.fix = {{"E", 22e9}};
  const Diagnosis d = Diagnose(DatasetOf({.sigma_m = 0.03}), known);
  const auto mass = std::find_if(
      d.naming.candidates.begin(), d.naming.candidates.end(),
      [](const CandidateResult& c) { return c.candidate.Name() == "body_mass_scale"; });
  ASSERT_EQ(mass->status, CandidateStatus::kNotTested);
  EXPECT_TRUE(std::none_of(d.notes.begin(), d.notes.end(), [](const std::string& note) {
    return note.find("nothing here weighs it") != std::string::npos;
  }));
}

TEST(AfterVerdict, NothingIsAddedToADiagnosisThatIsStopped) {
  const std::atomic<bool> stop = true;
  DiagnosisOptions options = LookAlikeOptions();
  options.fit.stop = &stop;
  Diagnosis d = LookAlikes();
  TellBesides(d, options);
  EXPECT_FALSE(d.experiment);
  EXPECT_TRUE(d.candidate_gains.empty());
  EXPECT_FALSE(d.interrupted);
}

}  // namespace
}  // namespace hoplab
