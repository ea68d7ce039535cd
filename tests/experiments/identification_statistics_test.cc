// Tables made from constants and a reading that the identification is not told, without and with a
// mass at the toe. Seeds are recorded inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/random.h"
#include "experiments/identification/identification.h"
#include "tests/experiments/study_hoppers.h"

namespace hoplab {
namespace {

using namespace testing;
using C = StudyConstant;
using Speed = ConvergenceReading::Speed;

constexpr int kInitialStates = 4;  // a side of the grid

const std::vector<ConvergenceReading>& ReadingsOfTimes() {
  static const std::vector<ConvergenceReading> readings = {
      {Speed::kFlight}, {Speed::kApex}, {Speed::kHopMean}};
  return readings;
}

// One departure from `thesis` each, and none.
std::vector<StudyReading> CandidateReadings() {
  std::vector<StudyReading> readings(5);
  readings[1].law.stiffness_radius = ThesisReading::StiffnessRadius::kRest;
  readings[2].law.rolling_radius = ThesisReading::RollingRadius::kRest;
  readings[3].law.rolling = ThesisReading::Rolling::kExplicit;
  readings[4].law.stiffness_angle = ThesisReading::StiffnessAngle::kVirtualLeg;
  return readings;
}

struct Truth {
  StudyHopper hopper;
  ConvergenceReading times;
  StudyData tables;
};

bool IsWhole(const StudyData& data) {
  return std::all_of(data.energy.begin(), data.energy.end(),
                     [](const EnergyCell& c) { return std::isfinite(c.percent); }) &&
         std::all_of(data.initial_states.begin(), data.initial_states.end(),
                     [](const StartCell& c) { return std::isfinite(c.convergence_time_s); }) &&
         std::all_of(data.modulus.begin(), data.modulus.end(), [](const ModulusRow& r) {
           return std::isfinite(r.k_min_N_per_m) && std::isfinite(r.convergence_time_s);
         });
}

// Draws until every cell of the tables has a number.
Truth DrawTruth(std::uint64_t seed, bool has_toe) {
  RandomStream random(seed, 1);
  const std::vector<StudyReading> readings = CandidateReadings();
  for (;;) {
    Truth truth;
    truth.hopper = SomeHopper();
    truth.hopper.reading = readings[static_cast<std::size_t>(random.Uniform(0.0, 5.0))];
    if (random.Uniform(0.0, 1.0) < 0.5)
      truth.hopper.reading.law.torque_sign = ThesisReading::TorqueSign::kPrinted;
    truth.times = ReadingsOfTimes()[static_cast<std::size_t>(random.Uniform(0.0, 3.0))];
    const auto draw = [&](C c, double low, double high) {
      At(truth.hopper.constants, c) = random.Uniform(low, high);
    };
    draw(C::kMass, 0.4, 0.8);
    draw(C::kRadius, 0.09, 0.11);
    draw(C::kBendingStiffness, 5.0, 9.0);
    draw(C::kGain, 3.0, 12.0);
    draw(C::kStartSpeed, 0.9, 1.2);
    draw(C::kPlacedShare, 0.35, 0.6);
    if (has_toe) {
      draw(C::kToeMass, 0.01, 0.03);
      draw(C::kPlacementRate, 35.0, 70.0);
      draw(C::kPlacementDamping, 0.3, 0.9);
    }
    truth.tables = TablesOf(truth.hopper, truth.times, kInitialStates);
    if (IsWhole(truth.tables)) return truth;
  }
}

// `with_toe`: a mass at the toe is searched, too.
IdentificationRequest RequestFor(const Truth& truth, bool with_toe) {
  IdentificationRequest request;
  request.context.data = truth.tables;
  request.context.convergence = ReadingsOfTimes();
  request.context.integrator.relative_tolerance = 1e-8;
  request.readings = CandidateReadings();
  request.free = {C::kMass, C::kRadius,     C::kBendingStiffness,
                  C::kGain, C::kStartSpeed, C::kPlacedShare};
  if (with_toe) request.toe_free = {C::kToeMass, C::kPlacementRate, C::kPlacementDamping};
  request.budget = 1000;
  request.keep = 4;
  request.keep_toe = 2;
  request.refine = 1;
  request.with_front = false;
  return request;
}

// Largest relative error of the constants that the truth has, and of which.
struct WorstConstant {
  double error = 0.0;
  std::string_view name = "none";
};
WorstConstant WorstOf(const StudyConstants& found, const Truth& truth) {
  const bool has_toe = HasToeMass(truth.hopper);
  WorstConstant worst;
  for (int i = 0; i < kStudyConstantCount; ++i) {
    const auto c = static_cast<C>(i);
    if (c == C::kRollingBlend || (NeedsToeMass(c) && !has_toe)) continue;
    const double error = std::abs(At(found, c) / At(truth.hopper.constants, c) - 1.0);
    if (error > worst.error) worst = {error, InfoOf(c).name};
  }
  return worst;
}

struct Recovered {
  int readings = 0, constants = 0;  // cases that come out right
};

// Cases from the seeds `first` on, a line of the protocol each.
Recovered Recover(std::uint64_t first, int cases, bool with_toe) {
  Recovered right;
  std::printf("seed  toe mass  reading  times  worst error of a constant  misfit\n");
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(cases); ++seed) {
    const Truth truth = DrawTruth(seed, with_toe);
    const IdentificationRequest request = RequestFor(truth, with_toe);
    const IdentificationResult result = Identify(request, ThreadedFits().On(request.context));
    const ScoredFit& best = result.by_all.front();
    const bool has_toe = At(best.fit.constants, C::kToeMass) > 0.0;
    const bool law =
        best.fit.reading == truth.hopper.reading && has_toe == HasToeMass(truth.hopper);
    const bool times = best.convergence == truth.times;
    const WorstConstant worst = WorstOf(best.fit.constants, truth);
    right.readings += law && times ? 1 : 0;
    right.constants += worst.error < 0.02 ? 1 : 0;
    std::printf("%4d  %5.1f g  %s  %s  %.4f %s  %.2g\n", static_cast<int>(seed),
                1e3 * At(truth.hopper.constants, C::kToeMass), law ? "right" : "wrong",
                times ? "right" : "wrong", worst.error, std::string(worst.name).c_str(),
                best.fit.misfit);
    std::fflush(stdout);
  }
  return right;
}

TEST(IdentificationStatistics, FindsConstantsAndReadingOfAMasslessLeg) {
  const Recovered right = Recover(1, 10, false);
  EXPECT_GE(right.readings, 9);
  EXPECT_GE(right.constants, 9);
}

TEST(IdentificationStatistics, FindsConstantsAndReadingOfALegWithAToeMass) {
  const Recovered right = Recover(11, 10, true);
  EXPECT_GE(right.readings, 9);
  EXPECT_GE(right.constants, 9);
}

}  // namespace
}  // namespace hoplab
