#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/diagnosis/fitted_model.h"
#include "fitting/gradient_certificate.h"
#include "fitting/stop_check.h"

namespace hoplab {

/// One condition of a diagnosis.
struct GateCheck {
  std::string name;  // "fit", "noise", "events", "gradients"
  bool passed = false;
  std::string text;  // what was found, with figures
};

struct Gate {
  std::vector<GateCheck> checks;
  GradientCertificate certificate;
  bool at_minimum = false;  // the fit without further effects is
  bool passed() const;
  /// The first condition that failed, in words; empty if none did.
  std::string Refusal() const;
  /// Nothing failed but the check of the gradients, which were compared.
  bool OnlyGradientsFailed() const;
};

/// Sensitivities must agree with differences this well to be trusted with a diagnosis.
inline constexpr double kGradientBound = 1e-4;

/// A wrong model may fit best right where an event is met without crossing it: there a derivative
/// ends, which the certificate flags. It is trusted where the other trials have the right ones.
GateCheck CheckGradients(const GradientCertificate& certificate);

/// Whether the null fit may be diagnosed: every train trial is simulated through all its data, the
/// noise is known, the gradients hold. Where the fit is no minimum that is told; an extension of it
/// may be one.
Gate CheckGate(const FittedModel& null, const std::vector<TrialProblem>& train, int jobs);

/// Replaces stated noise that the flights contradict (estimated more than a quarter above it) by
/// the estimate, gives trials that scatter more a noise of their own (FindTrialNoise), and counts
/// noise that is alike in neighbouring samples (NoiseCorrelation), or went through a filter
/// (FindFilteredNoise), as white noise that does the same to slow motion; notes say so. A diagnosis
/// with noise stated too small would see causes everywhere.
std::vector<std::string> CorrectNoise(FitProblem& problem);

/// Of each channel of a problem corrected so: the mean square, over sigma squared, that noise alone
/// leaves. 1 of white noise; less where noise that is alike in neighbouring samples counts as a
/// stronger one, which is that of slow motion, while each sample scatters by less.
std::vector<double> NoiseSquares(const FitProblem& problem);

/// How many rows fewer than `trials` have would leave the same square (NoiseSquares; empty: 1).
double AlikeRows(const std::vector<TrialProblem>& trials, const std::vector<double>& squares);

}  // namespace hoplab
