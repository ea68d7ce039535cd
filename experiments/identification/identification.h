#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/identification/study_scores.h"
#include "experiments/identification/study_unit.h"

namespace hoplab {

/// Makes the fits of a stage's units, in their order, wherever it likes: on threads, on the ranks
/// of a job, out of a journal. A unit that a stop cut short has a misfit of NaN or of what was
/// found.
using FitUnits =
    std::function<std::vector<StudyFit>(const std::string& stage, const std::vector<StudyUnit>&)>;

/// FitUnits on threads.
struct ThreadedFits {
  int jobs = 1;
  /// Called after each unit, one at a time.
  std::function<void(const std::string& stage, int done, int of)> progress = nullptr;

  FitUnits On(const UnitContext& context) const;
};

/// The constants and the reading of its law that a study does not print, found from its tables.
struct IdentificationRequest {
  UnitContext context;
  std::vector<StudyReading> readings;  // to choose from; see AllReadings
  std::vector<StudyConstant> free;     // searched; the others stay as in `fixed`
  /// Searched besides in a last round, with a mass at the toe and the readings that do best without
  /// one; none: no such round. Of lift-off rules it knows kZeroForce alone.
  std::vector<StudyConstant> toe_free;
  StudyConstants fixed = ConstantsAsPrinted();
  int budget = 3000;  // evaluations of a unit over steady hops; the others have shares of it
  /// Evaluations of a search with a toe mass from scratch, within all bounds; 0: only in a box
  /// about the best without one, by a share of `budget`.
  int toe_budget = 0;
  /// Readings that go on from table 6.5 to the steady hops.
  int keep_readings = 192;
  /// Fits that go on from the steady hops to all tables, and to a mass at the toe.
  int keep = 24, keep_toe = 3;
  /// Fits whose readings of the times are tried in turn, and that are searched on from in the end.
  int refine = 4;
  bool with_front = true;  // between the parts of the misfit
  std::uint64_t seed = 1;
};

/// The 192 readings of the law, lift-off rules included, that table 6.5 tells apart: all but the
/// sign of the hip torque, which is tried on each of them.
std::vector<StudyReading> AllReadings();

struct ScoredFit {
  StudyFit fit;
  StudyScores scores;
  ConvergenceReading convergence;  // that its times are read by
};

/// A direction in the logarithms of the free constants, and how strongly the tables speak to it:
/// the singular value of the residuals' slopes. Below about 1 they do not.
struct StudyDirection {
  double strength = 0.0;
  std::vector<double> loadings;  // one a free constant, length 1
};

/// What a table says about one open point: the least misfit with each of its words.
struct PointDecision {
  std::string point;  // "rolling", ..., "liftoff", "torque_sign", "toe_mass"
  struct Word {
    std::string word;
    double energy_misfit;  // 6.5 alone; NaN where none was tried
    double steady_misfit;  // all tables, by their steady hops; NaN likewise
    double all_misfit;     // all tables, by their runs; NaN likewise
  };
  std::vector<Word> words;
};

/// What the best hopper's times come to by one of the readings of "convergence time".
struct ReadingOfTimes {
  ConvergenceReading reading;
  double damped_misfit, undamped_misfit;  // in units, mean squares
  TimeScores damped_initial_states;       // 6.2
};

/// The fit where a part of the misfit counts ten times, or not at all.
struct FrontPoint {
  std::string name;  // "all", "energy x 10", "without stiffness"
  ScoredFit fit;
};

struct IdentificationResult {
  std::vector<StudyFit> by_energy;  // table 6.5 alone: all readings, best first
  ScoredFit best_by_energy;
  std::vector<StudyFit> by_steady;  // steady hops: all readings, both signs, best first
  std::vector<ScoredFit> by_all;    // every table, best first
  /// Constants of `by_all` whose misfit is within twice the best's: least and greatest.
  StudyConstants low{}, high{};
  int as_good = 0;                                // how many those are
  std::vector<StudyDirection> energy_directions;  // of the best, 6.5 alone; strongest first
  std::vector<StudyDirection> smooth_directions;  // 6.5 and the stiffness ranges
  std::vector<PointDecision> decisions;
  std::vector<ReadingOfTimes> times;  // all 24 readings, for the best
  std::vector<FrontPoint> front;
  std::vector<PullingCell> cells;  // of the best
  long evaluations = 0;            // of a set of tables
  bool interrupted = false;
};

/// Table 6.5 over all readings; then everything by the steady hops and what their return maps
/// predict; the best of that on all tables, by the likely readings of the times in turn, the best
/// of those refined; with a mass at the toe; and the front between the parts of the misfit.
IdentificationResult Identify(const IdentificationRequest& request, const FitUnits& fit_units);

/// The fit's scores over all tables, and the runs behind them.
ScoredFit Scored(const StudyFit& fit, const UnitContext& context);

}  // namespace hoplab
