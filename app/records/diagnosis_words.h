#pragma once

#include <string>

#include "app/records/diagnosis_record.h"

namespace hoplab {

/// The verdict in one sentence of at most thirty words, main causes only; empty if there is none.
std::string VerdictSentence(const Diagnosis& diagnosis);

/// What the extension leaves: that it looks like noise, beside a smooth error where one is, or that
/// not all of the misfit is explained. Asks for a diagnosis with an extension.
std::string RemainderSentence(const Diagnosis& diagnosis);

/// "0.012 N s^2/m^2": a size with its unit, two significant digits.
std::string SizeText(double value, const std::string& unit);

/// "97 %", "4.2 %", never rounded up.
std::string ShareText(double share);

/// "97 %", to the next.
std::string WholeShareText(double share);

/// "p = 0.31", "p < 0.001".
std::string ChanceText(double p_value);

/// "body_x late in flight": where a cell of the misfit map lies.
std::string PlaceText(const FitProblem& problem, const MisfitCell& cell);

/// "air_drag", "air_drag in train-2.csv".
std::string CauseText(const Candidate& candidate);

/// "E 22.01 (21.96 .. 22.06) GPa, leg_damping ..": shared values with their 95 % intervals.
std::string ValuesText(const FitProblem& problem, const Eigen::VectorXd& shared,
                       const Uncertainty& uncertainty);

}  // namespace hoplab
