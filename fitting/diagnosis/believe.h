#pragma once

#include <span>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// How plainly the trials disagree about one effect, from the sizes of its parameters in them: the
/// rarity of that by chance, -lg p and at most 3, times their spread over half the effect's size.
/// A parameter of several may be zero (a mass ahead of its place, at the right height), so it is
/// measured, in typical sizes, against the largest of them.
double Disagreement(std::span<const Heterogeneity> sizes, const Candidate& of);

/// The probability that a name has at most: the odds that it is right are no better than what it
/// explains of the misfit against what nothing explains and the noise does not hide. A search finds
/// a small corner of an error of the model that some cause fits, without any of it being there.
double MostBelievable(double explained, double unexplained);

/// The probability that one of a told group is right, by what is seen of it (`f`): as that group,
/// or, where what is left looks like noise, as part of a wider one. What does a little worse in a
/// name's place makes its gap small, as that of a name that hardly explains anything is; but where
/// the model lacks nothing else, evidence alone tells the two names apart.
double GroupProbability(const NameFeatures& f, const std::vector<WiderGroup>& wider,
                        bool leaves_noise);

/// How sure each name of `report` is, by what cases that looked like it turned out to be
/// (NameFeatures). `sizes`: of the shared values of the extension.
void Believe(ExtensionReport& report, const Diagnosis& diagnosis,
             const std::vector<Heterogeneity>& sizes);

/// Tells main causes from those that stand in for something else (CauseReport::stands_in).
void FindStandIns(std::vector<CauseReport>& causes);

/// Of a name in an extension with a size at its bound: less than even odds.
inline constexpr double kMostAtBound = 0.49;

/// Where a told size lies on a physical bound the extension as a whole is not what acts, so none of
/// its names has better than even odds.
void BelieveLessAtBound(std::vector<CauseReport>& causes);

/// A told cause as one that is set aside.
SetAside AsSetAside(const CauseReport& cause, const ExtensionReport& report, const Naming& naming);

/// The small corrections whose names are most likely wrong, where some main cause is likely right.
std::vector<SetAside> DoubtfulCorrections(const ExtensionReport& report, const Naming& naming);

/// All of its causes.
std::vector<SetAside> AllCorrections(const ExtensionReport& report, const Naming& naming);

}  // namespace hoplab
