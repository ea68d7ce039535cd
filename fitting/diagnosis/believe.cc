#include "fitting/diagnosis/believe.h"

#include <algorithm>
#include <cmath>

#include "fitting/diagnosis/verdict.h"

namespace hoplab {
namespace {

constexpr double kMostOthers = 2.0;      // no more causes were planted together
constexpr double kMostNatsOfGap = 50.0;  // a gap beyond is no surer
constexpr double kLeastChance = 1e-10, kLeastShare = 1e-4;
constexpr double kPlainRarity = 3.0;  // trials that differ this plainly differ
// Sizes in the trials that spread by this share of the effect's own are not of one cause. A spread
// of half a per cent is certain, too, where rows are many, and says nothing.
constexpr double kUnlikeSizes = 0.5;

// Of the log odds by which a wider group is surer. The best of several is too sure by itself; this
// share tells the calibration's cases best (docs/decisions/0021).
constexpr double kBelievedOfWider = 0.8;

double GapFeature(double nats) { return std::log1p(std::clamp(nats, 0.0, kMostNatsOfGap)); }
double Rarity(double p_value) { return -std::log10(std::max(p_value, kLeastChance)); }

bool SomeMainIsLikely(const std::vector<CauseReport>& causes) {
  return std::any_of(causes.begin(), causes.end(),
                     [](const CauseReport& c) { return c.main && c.group_probability >= kLikely; });
}

// What nothing explains, as a share of the misfit, as far as it is more than the noise.
double UnexplainedShare(const ExtensionReport& report, const Detection& seen) {
  const double share = 1.0 - report.explained;
  const double over_noise = LeftOverNoise(seen, share);
  return over_noise > 1.0 ? share * (1.0 - 1.0 / (over_noise * over_noise)) : 0.0;
}

}  // namespace

double MostBelievable(double explained, double unexplained) {
  return unexplained > 0.0 ? std::max(explained, 0.0) / (std::max(explained, 0.0) + unexplained)
                           : 1.0;
}

double GroupProbability(const NameFeatures& f, const std::vector<WiderGroup>& wider,
                        bool leaves_noise) {
  const double narrow = CalibratedProbability(f);
  if (!leaves_noise) return narrow;
  double best = narrow;
  for (const WiderGroup& group : wider) {
    NameFeatures as_part = f;
    as_part.gap = GapFeature(group.gap);
    as_part.group = group.others;
    best = std::max(best, group.told * CalibratedProbability(as_part));
  }
  const double from = LogOddsOf(narrow);
  return ProbabilityOf(from + kBelievedOfWider * (LogOddsOf(best) - from));
}

double Disagreement(std::span<const Heterogeneity> sizes, const Candidate& of) {
  const auto typical = [&](std::size_t k) {
    return std::abs(of.Parameter(static_cast<int>(k)).typical);
  };
  double size = 0.0, most = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    size = std::max(size, std::abs(sizes[k].mean) / typical(k));
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const Heterogeneity& h = sizes[k];
    const double unlike = kUnlikeSizes * size * typical(k);
    const double spread = h.spread < unlike ? h.spread / unlike : 1.0;
    most = std::max(most, std::min(Rarity(h.p_value), kPlainRarity) * spread);
  }
  return most;
}

void Believe(ExtensionReport& report, const Diagnosis& diagnosis,
             const std::vector<Heterogeneity>& sizes) {
  const Naming& naming = diagnosis.naming;
  const FittedModel& best = naming.best;
  NameFeatures common;
  common.left_gain = std::log1p(std::max(best.evidence.discrepancy - best.evidence.white, 0.0));
  common.left_share = std::log10(std::clamp(1.0 - report.explained, kLeastShare, 1.0));
  common.remainder = Rarity(report.remainder.p_value);
  const double gain = best.evidence.log_z() - diagnosis.null.evidence.log_z();
  common.gain = std::log10(1.0 + std::max(gain, 0.0));
  const double unexplained = UnexplainedShare(report, diagnosis.detection);
  const bool leaves_noise = !report.SomeRemains() && best.evidence.discrepancy_probability() < 0.5;
  common.others = std::min(static_cast<double>(best.members.size() - 1), kMostOthers);
  for (CauseReport& c : report.causes) {
    const std::size_t member = naming.MemberOf(c.candidate);
    NameFeatures& f = c.features = common;
    f.gap = GapFeature(naming.gaps[member]);
    f.group = static_cast<double>(naming.groups[member].size() - 1);
    const auto first = sizes.begin() + best.PlaceOf(static_cast<int>(member));
    c.sizes.assign(first, first + c.cause.parameter_count());
    // Sizes of each trial's own disagree by what they are.
    f.heterogeneity = c.cause.each_trial ? 0.0 : Disagreement(c.sizes, c.cause);
    c.group_probability = std::min(GroupProbability(f, naming.wider[member], leaves_noise),
                                   MostBelievable(report.OfMisfit(c.share), unexplained));
    c.probability = c.group_probability * naming.group_weights[member].front();
  }
}

void FindStandIns(std::vector<CauseReport>& causes) {
  if (!SomeMainIsLikely(causes)) return;
  for (CauseReport& c : causes) {
    c.stands_in = c.main && c.group_probability < kLikely;
    c.main = c.main && !c.stands_in;
  }
}

void BelieveLessAtBound(std::vector<CauseReport>& causes) {
  for (CauseReport& c : causes) {
    const double share = c.group_probability > 0.0 ? c.probability / c.group_probability : 0.0;
    c.group_probability = std::min(c.group_probability, kMostAtBound);
    c.probability = share * c.group_probability;
  }
}

SetAside AsSetAside(const CauseReport& c, const ExtensionReport& report, const Naming& naming) {
  const int member = static_cast<int>(naming.MemberOf(c.candidate));
  return {c.candidate,
          c.cause,
          naming.best.ValuesOf(member),
          c.share,
          report.OfMisfit(c.share),
          c.probability,
          c.group_probability,
          c.evidence_probability,
          c.features,
          naming.GroupOf(c.candidate),
          std::nullopt};
}

std::vector<SetAside> DoubtfulCorrections(const ExtensionReport& report, const Naming& naming) {
  std::vector<SetAside> doubtful;
  if (!SomeMainIsLikely(report.causes)) return doubtful;
  for (const CauseReport& c : report.causes) {
    if (c.main || c.stands_in || c.group_probability >= kLikely) continue;
    doubtful.push_back(AsSetAside(c, report, naming));
  }
  return doubtful;
}

std::vector<SetAside> AllCorrections(const ExtensionReport& report, const Naming& naming) {
  std::vector<SetAside> all;
  for (const CauseReport& c : report.causes) all.push_back(AsSetAside(c, report, naming));
  return all;
}

}  // namespace hoplab
