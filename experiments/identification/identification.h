#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "experiments/identification/study_misfit.h"

namespace hoplab {

/// The constants and the reading of its law that a study does not print, found from its tables.
struct IdentificationRequest {
  StudyData data;
  std::vector<StudyReading> readings;  // to choose from; see AllReadings
  std::vector<StudyConstant> free;     // searched; the others stay as in `fixed`
  StudyConstants fixed{};
  int budget = 600;  // evaluations of each reading in each stage
  /// Families (readings up to what damps and when it leaves the ground, which 6.5 hardly tells
  /// apart) that go on from table 6.5 to all tables.
  int keep = 32;
  int keep_to_the_end = 2;  // of those, the ones polished on the convergence times, with relatives
  std::uint64_t seed = 1;
  int jobs = 1;  // never changes a result
  IntegratorOptions integrator;
  const std::atomic<bool>* stop = nullptr;  // keeps what was found
  /// Called after each reading of a stage, one at a time.
  std::function<void(const std::string& stage, int done, int of)> progress = nullptr;
};

/// The 192 readings of the law, lift-off rules included, that table 6.5 tells apart: all but the
/// sign of the hip torque, which is tried on the readings that are kept.
std::vector<StudyReading> AllReadings();

/// A reading with its best constants for some tables.
struct StudyFit {
  StudyReading reading;
  StudyConstants constants{};
  double misfit = 0.0;  // of the tables it was fitted to; see MisfitOf
};
struct ScoredFit {
  StudyFit fit;
  StudyScores scores;
};

/// A direction in the logarithms of the free constants, and how strongly the tables speak to it:
/// the singular value of the residuals' slopes. Below about 1 they do not.
struct StudyDirection {
  double strength = 0.0;
  std::vector<double> loadings;  // one a free constant, length 1
};

/// What a table says about one open point: the least misfit with each of its words.
struct PointDecision {
  std::string point;  // "rolling", ..., "liftoff", "torque_sign"
  struct Word {
    std::string word;
    double energy_misfit;  // 6.5 alone; NaN where none was tried
    double all_misfit;     // every table; NaN likewise
  };
  std::vector<Word> words;
};

struct IdentificationResult {
  std::vector<StudyFit> by_energy;  // table 6.5 alone: all readings, best first
  ScoredFit best_by_energy;
  std::vector<ScoredFit> by_all;  // every table, best first
  /// Constants of `by_all` whose misfit is within twice the best's: least and greatest.
  StudyConstants low{}, high{};
  int as_good = 0;                                // how many those are
  std::vector<StudyDirection> energy_directions;  // of the best, 6.5 alone; strongest first
  std::vector<StudyDirection> smooth_directions;  // 6.5 and the stiffness ranges
  std::vector<PointDecision> decisions;
  long evaluations = 0;  // of a set of tables
  bool interrupted = false;
};

/// Table 6.5 over all readings (NLopt's CRS2 and Sbplx, then Ceres with the simulator's
/// sensitivities); the best of them, with both signs of the torque, on 6.5 and the stiffness ranges
/// together; the best of those, and the other readings of their families, on all tables.
IdentificationResult Identify(const IdentificationRequest& request);

}  // namespace hoplab
