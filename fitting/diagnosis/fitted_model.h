#pragma once

#include <atomic>
#include <limits>
#include <span>
#include <vector>

#include "fitting/diagnosis/candidate.h"
#include "fitting/diagnosis/evidence.h"
#include "fitting/fit.h"

namespace hoplab {

/// A model with candidate effects in it, fitted to the train trials. With no members it is the
/// null fit.
struct FittedModel {
  std::vector<Candidate> members;
  FitProblem problem;                     // the null problem extended by the members
  Eigen::VectorXd shared;                 // fitted: those of the null problem, then the members'
  std::vector<OwnValues> initial_states;  // of the train trials
  /// Half the sum of squares of the data over sigma, and of priors: what least squares minimise.
  double cost = 0.0;
  SolveStatus status = SolveStatus::kFailed;
  bool complete = false;  // every train trial is simulated to the end of its data
  /// Its own noise was sought (Settle); what follows is known only then.
  bool settled = false;
  DiscrepancyEstimate discrepancy;
  Evidence evidence;

  bool ok() const { return IsUsable(status) && complete; }
  /// Where among the shared values those of member `i` begin.
  int PlaceOf(int i) const;
  /// Fitted values of member `i`.
  Eigen::VectorXd ValuesOf(int i) const;
  /// All values of member `i` are at their nulls: it is not there.
  bool AtNull(int i) const;
  /// A member's value lies on a bound other than its null: physics would have to give more.
  bool AtPhysicalBound(int i) const;
  int parameter_count() const { return ParameterCount(members); }
  /// Some member has a size of each trial's own (Candidate::each_trial).
  bool has_own_sizes() const;
  /// Log-likelihood gained over `null` [nats].
  double GainOver(const FittedModel& null) const { return null.cost - cost; }
};

/// Those of `candidates` whose effect the model does not have.
std::vector<Candidate> CandidatesBeside(const FittedModel& model,
                                        std::span<const Candidate> candidates);

/// What every refit of a diagnosis shares.
struct RefitSettings {
  const std::vector<TrialProblem>* train = nullptr;
  int max_iterations = 40;  // in all
  /// A refit that would not get below this cost at its present pace ends.
  double give_up_above = std::numeric_limits<double>::infinity();
  /// What the linear model promises of a refit [nats]: one that falls well short of it is begun
  /// again nearer to null.
  double forecast = 0.0;
  Discrepancy discrepancy = Discrepancy::kMatern;
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
};

/// Fits `base` with `added` candidates, from the base's values and the added ones' `sizes` off
/// their null (own units; NaN: none). A start that cannot be simulated is moved towards null.
FittedModel Refit(const FittedModel& base, std::span<const Candidate> added,
                  const Eigen::VectorXd& sizes, const RefitSettings& settings);

/// `model`, fitted from `base`, sought anew from beyond the thresholds of what it adds, where it
/// has some; kept where that fits no better.
void RefitBeyondThresholds(FittedModel& model, const FittedModel& base,
                           const RefitSettings& settings);

/// The same model without member `i`.
FittedModel RefitWithout(const FittedModel& base, int i, const FitProblem& null_problem,
                         const RefitSettings& settings);

/// The same by small steps: the member's size falls to nothing, and at each step what is left
/// follows. No model, where that cannot be done. `plain_cost`: of the model without any member.
FittedModel LeadOut(const FittedModel& base, int i, const FitProblem& null_problem,
                    double plain_cost, const RefitSettings& settings);

/// Ends the model's fit, seeks the noise that suits what it leaves, and takes its evidence. With
/// `settings.discrepancy` kNone the noise stays white.
void Settle(FittedModel& model, const RefitSettings& settings);

/// Ends the model's fit alone; false if it could not be led on from where it is. A cost that is not
/// known is infinite.
bool EndFit(FittedModel& model, const RefitSettings& settings);

/// Noise and evidence alone, the values as they are. A model of which a trial cannot be
/// differentiated to its end stays unsettled: with a trial less it would seem to fit better.
/// `also`, if it is not white, is a noise that the search may not reach, taken if the evidence is
/// larger.
void SettleNoise(FittedModel& model, const RefitSettings& settings, const NoiseModel& also = {});

}  // namespace hoplab
