#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fitting/diagnosis/free_forces.h"
#include "fitting/diagnosis/gate.h"
#include "fitting/diagnosis/localise.h"
#include "fitting/diagnosis/measure.h"
#include "fitting/diagnosis/name.h"
#include "fitting/diagnosis/other_models.h"
#include "fitting/diagnosis/probes.h"
#include "fitting/diagnosis/separate.h"
#include "fitting/diagnosis/set_aside.h"
#include "fitting/diagnosis/shares.h"
#include "fitting/fit_dataset.h"
#include "fitting/uncertainty.h"

namespace hoplab {

enum class Verdict {
  kAdequate,    // nothing is missing that these data could show
  kNamed,       // one cause (or one for each effect found) stands alone
  kConfounded,  // several causes explain the data equally well
  kUnexplained  // something is missing, and nothing in the catalogue explains it
};
std::string_view NameOf(Verdict verdict);

/// Level of the global test: the share of clean datasets on which something is seen.
inline constexpr double kDetectionLevel = 0.01;
/// Level of the same test beside an extension, from which its names are given with a doubt: there
/// an idle doubt costs less than a wrong name.
inline constexpr double kDoubtLevel = 0.05;
/// Probability from which a cause is named without a doubt, and below which something that is not
/// in the catalogue is the more likely cause.
inline constexpr double kSure = 0.95, kLikely = 0.5;
/// Where no told cause is likely and the model misses less than this share of the noise, nothing is
/// wrong with it that matters.
inline constexpr double kSlight = 0.2;
/// Share of the misfit's excess over noise an extension must explain to name a cause while some
/// misfit remains: then what remains is seen, but of no consequence. With 0.9 one in five wrong
/// names of an effect outside the catalogue passed in spite of what it left. A cause with the
/// probability kProbable, four times that of all that no list holds, is told whatever it leaves:
/// more than one thing is wrong then. One below kUnlikely is not told even where it leaves nothing.
inline constexpr double kExplained = 0.95, kProbable = 0.8, kUnlikely = 0.2;

/// Steps where hundreds of models are tried. After a second of two legs positions are off by
/// 1e-9 m; derivatives of positions and angles are good to 5e-6 (docs/decisions/0001).
inline constexpr IntegratorOptions kDiagnosisSteps{.relative_tolerance = 1e-7,
                                                   .absolute_tolerance = 1e-8};

/// Where an event is met almost without crossing it derivatives change quickly, and those of a
/// neighbouring run are others.
inline constexpr IntegratorOptions kFinerSteps{.relative_tolerance = 1e-10,
                                               .absolute_tolerance = 1e-11};

/// What draws random numbers, each from a stream of its own.
enum class Draws : std::uint64_t { kDetection = 11, kRemainder, kBootstrap, kForces };

struct DiagnosisOptions {
  ProblemOptions problem{.integrator = kDiagnosisSteps};
  FitOptions fit;  // jobs, stop and seed serve the whole diagnosis
  Segmentation span = Segmentation::kAuto;
  CandidateOptions candidates;
  int max_effects = 5;
  double material = kMaterial;
  std::uint64_t Seed(Draws of) const { return fit.seed * 64 + static_cast<std::uint64_t>(of); }
  /// Called with what is probably not meant in the data (DataWarnings), before anything is fitted.
  std::function<void(const std::vector<std::string>& warnings)> warned = nullptr;
  /// Called where a stage begins, and how far it is (may come from several threads, one at a time).
  std::function<void(std::string_view stage)> stage = nullptr;
  /// `of` is what is planned so far: more may follow from what is found.
  std::function<void(const std::string& text, int done, int of)> step = nullptr;
};

/// One test of the detection: a candidate's score or a probe group's chi-square.
struct DetectionTest {
  std::string name;
  double statistic = 0.0;
  int dof = 0;  // 0: it cannot be told from the fitted values
  double p_value = 1.0;
};

/// Whether anything is there, candidates and probes tested together.
struct Detection {
  double p_value = 1.0;              // chance of as extreme a test under noise alone
  std::vector<DetectionTest> tests;  // candidates, then probe groups
  std::size_t candidates = 0;        // how many of the tests
  double chi2 = 0.0;                 // of all residuals
  int degrees_of_freedom = 0;        // what noise alone would leave of it
};

/// How one of the old parameters moved when the accepted effects joined.
struct Movement {
  std::string name, unit;
  double before = 0.0, after = 0.0;
  std::optional<double> std_errors;  // (after - before) over the standard error before
};

/// What the accepted extension, or the plain model if there is none, leaves.
struct Leftover {
  /// Of the plain model's squared misfit beyond noise, 0..1.
  double share = 0.0;
  /// That a discrepancy is there beside white noise.
  double probability = 0.0;
  NoiseModel noise;
  /// There, and more than is of no consequence.
  bool material = false;
};

/// What the extension is worth with a size in each trial of told causes whose size differs between
/// trials: of the one that gains most to first order, and of others as far as theirs pay beside it.
/// The extension itself stays the model that is told.
struct SizesReport {
  bool refitted = false;              // some refit came to rest; else nothing else is filled in
  double gain = 0.0;                  // VaryingModel::gain
  double explained = 0.0;             // share of the excess chi-square, 0..1
  std::vector<double> held_out_rmse;  // per channel, each held-out trial's size found as its start
  HeldOutGain held_out_gain;          // over one size for all, likewise
  /// It gains kVaryingPays.
  bool pays = false;
  /// SizesMatter.
  bool matters = false;
};

/// What the accepted extension is worth.
struct ExtensionReport {
  Uncertainty uncertainty;  // of the extended model, its intervals hold other_models too
  std::vector<OtherModel> other_models;  // not told and not ruled out, the likeliest first
  HeldOutErrors after;
  HeldOutGain gain;
  std::vector<std::string> left_out;  // held-out trials that could not be compared
  std::vector<Movement> movements;
  Detection remainder;               // the other candidates and the probes at the extension
  double explained = 0.0;            // share of the excess chi-square, 0..1
  double white_square = 0.0;         // squares left when fitted under white noise
  bool at_bound = false;             // a told cause's size lies on a physical bound
  std::vector<std::string> at_wall;  // fitted values of the plain model at the end of their range

  std::vector<CauseReport> causes;   // the members, the largest share first
  std::optional<SizesReport> sizes;  // absent where none varies that may matter
  /// A cause's share (CauseReport::share) of the plain model's misfit, of which all of them explain
  /// `explained`.
  double OfMisfit(double share) const { return share * explained; }
  /// Whether the told cause's parameter `k` is told to differ between trials: it does to first
  /// order, and the refit came to rest, pays and matters.
  bool TellsSizesOf(const CauseReport& cause, std::size_t k) const;

  /// Some misfit is left for certain, or may be: one of the members may stand in for another cause.
  bool SomeRemains() const { return remainder.p_value <= kDetectionLevel; }
  bool InDoubt() const { return remainder.p_value <= kDoubtLevel; }
  /// Only a size or a value that cannot be makes the extension fit.
  bool IsBeyondPhysics() const { return at_bound || !at_wall.empty(); }
  std::vector<const CauseReport*> MainCauses() const;
  /// The main causes; all of them where none is main.
  std::vector<const CauseReport*> ToldCauses() const;
  /// That every told cause is right, or a name that does as well: the least of them, since what
  /// spoils one spoils all.
  double ToldProbability() const;
  /// The same, and nothing stands in for another.
  double Probability() const;
  /// Nothing does as well in the place of a told cause.
  bool Alone(const Naming& naming) const;
};

/// The extension that first parts of the trials led to, fitted to the whole trials.
struct CarriedOn {
  FittedModel model;
  /// Whether that is a minimum: else the model does not follow the whole trials.
  StopCheck stop;
  /// Of a minimum. Where a smooth error is left, its intervals hold those of the first parts.
  Uncertainty uncertainty;
  HeldOutErrors errors;  // of a minimum
};

/// A channel that disagrees with the others, in which nothing is missing.
struct OddChannel {
  Channel channel = Channel::kBodyX;
  /// What it stamps t was read at t + offset, and then it agrees [s]; absent: it does not, and was
  /// left out.
  std::optional<double> offset_s = std::nullopt;
  std::optional<std::pair<double, double>> offset_ci95 = std::nullopt;
};

/// A diagnosis from the gate to the proposed experiment. What was not reached is empty.
struct Diagnosis {
  FitProblem problem;  // the null problem; trials are hops if `by_hop`
  bool by_hop = false;
  std::optional<double> until;        // DatasetFit::until
  std::vector<double> noise_squares;  // DatasetFit::noise_squares
  std::vector<std::string> warnings;  // DataWarnings
  std::vector<std::string> notes;     // what was decided on the way
  std::string own_sizes;  // the one of `notes` about sizes of each trial's own; or empty
  FitResult fit;
  Gate gate;
  /// Why there is no diagnosis; empty if there is one.
  std::string refusal;
  bool interrupted = false;
  /// Stopped while longer parts of the trials were looked at: the verdict is of the first ones.
  bool cut_short = false;

  FittedModel plain;        // the null fit under white noise
  FittedModel null;         // the same under the noise that suits it
  Uncertainty uncertainty;  // of the null fit
  Detection detection;
  Localisation localisation;
  Naming naming;
  /// Of each candidate added alone; one that is not settled under the noise of `null`.
  std::vector<std::optional<HeldOutGain>> candidate_gains;
  HeldOutErrors before;
  std::optional<ExtensionReport> extension;
  std::vector<SetAside> set_aside;   // what the evidence wanted besides; without an extension, all
  bool nothing_seen_before = false;  // Beforehand::nothing_seen
  Leftover left;
  std::optional<SeparatingExperiment> experiment;
  std::optional<CarriedOn> carried_on;    // where causes were named by first parts of the trials
  std::optional<FreeForces> free_forces;  // where the catalogue does not explain the misfit
  std::optional<OddChannel> odd_channel;
  Verdict verdict = Verdict::kAdequate;
  std::string reason;  // why the verdict is what it is

  /// Place in naming.candidates of the largest cause; absent without an extension.
  std::optional<int> Cause() const;
  /// That something acts that the catalogue does not hold: by cases that looked like this one where
  /// there is an extension, else by the evidence for a discrepancy.
  double UnlistedProbability() const;
  /// What was named, if anything, may only stand in for something else.
  bool CausesMayStandIn() const;
  /// Nothing is told, but what is set aside would be likely had it been seen in shorter parts, too.
  bool ShowsLateAlone() const;
};

/// What a diagnosis of shorter parts of the same trials has found: NamingOptions.
struct Beforehand {
  std::vector<FittedModel> begin = {};  // as NamingOptions has it
  bool slow_ones_only_beside = false;
  bool nothing_seen = false;  // shorter parts were looked at and are adequate
};

/// Diagnoses what a fit of the model as it is leaves, up to the verdict.
Diagnosis DiagnoseFitted(DatasetFit null, const DiagnosisOptions& options,
                         const Beforehand& beforehand = {});

/// The same diagnosis, judged anew without `members`, some of its causes but not all, which are set
/// aside; with them still in it where the model without them could not be fitted. The other names
/// keep their probabilities. A diagnosis that is stopped meanwhile is `interrupted`.
Diagnosis DiagnosedWithout(Diagnosis diagnosis, const std::vector<SetAside>& members,
                           const DiagnosisOptions& options);

/// Diagnoses a dataset. Of a robot the first stances are looked at before whole trials, in which
/// what is wrong has grown until no small cause looks like itself; what is named there is carried
/// on to the whole trials. Throws InputError for options that do not suit it.
Diagnosis Diagnose(const Dataset& dataset, const DiagnosisOptions& options);

}  // namespace hoplab
