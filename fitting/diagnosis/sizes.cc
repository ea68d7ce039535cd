#include "fitting/diagnosis/sizes.h"

#include <algorithm>
#include <cmath>

#include "fitting/diagnosis/verdict.h"

namespace hoplab {
namespace {

// Places of a cause's values among those of the extension.
int FirstPlace(const Diagnosis& d, const CauseReport& cause) {
  return d.naming.best.PlaceOf(static_cast<int>(d.naming.MemberOf(cause.candidate)));
}

// Values of a told cause that differ between trials.
struct DifferingCause {
  std::vector<int> places;
  double gain = 0.0;  // nats, to first order, of the one that gains most
};

// A cause whose sizes promise less than this share of what would matter is not refitted.
constexpr double kPromise = 0.1;

std::vector<DifferingCause> DifferingCauses(const ExtensionReport& report, const Diagnosis& d,
                                            const std::vector<Heterogeneity>& white,
                                            double material) {
  const double excess = d.detection.chi2 - d.detection.degrees_of_freedom;
  const double matters = material * report.explained * excess;
  std::vector<DifferingCause> causes;
  for (const CauseReport* c : report.ToldCauses()) {
    if (c->cause.each_trial) continue;
    DifferingCause cause;
    for (std::size_t k = 0; k < c->sizes.size(); ++k) {
      if (!Differs(c->sizes[k])) continue;
      const int place = FirstPlace(d, *c) + static_cast<int>(k);
      cause.places.push_back(place);
      cause.gain = std::max(cause.gain, white[static_cast<std::size_t>(place)].gain);
    }
    if (!cause.places.empty() && 2.0 * cause.gain >= kPromise * matters)
      causes.push_back(std::move(cause));
  }
  return causes;
}

// Those that still differ beside the sizes that `v` has.
std::vector<DifferingCause> StillDiffering(const VaryingModel& v,
                                           const std::vector<DifferingCause>& causes, int jobs) {
  const std::vector<Heterogeneity> seen = HeterogeneityOf(v.model, v.train, jobs);
  std::vector<DifferingCause> left;
  for (const DifferingCause& cause : causes) {
    DifferingCause now;
    for (const int place : cause.places) {
      const Heterogeneity& h = seen[static_cast<std::size_t>(place)];
      if (!Differs(h)) continue;
      now.places.push_back(place);
      now.gain = std::max(now.gain, h.gain);
    }
    if (!now.places.empty()) left.push_back(std::move(now));
  }
  return left;
}

// Sizes of one cause after another, the one that gains most first, as long as they pay beside
// those that are there already: where one cause differs, all that act like it seem to.
VaryingModel RefitOf(const FittedModel& best, std::vector<DifferingCause> causes,
                     const RefitSettings& settings) {
  VaryingModel v;
  std::vector<int> places;
  while (!causes.empty()) {
    const auto most = std::max_element(
        causes.begin(), causes.end(),
        [](const DifferingCause& a, const DifferingCause& b) { return a.gain < b.gain; });
    std::vector<int> more = places;
    more.insert(more.end(), most->places.begin(), most->places.end());
    causes.erase(most);
    VaryingModel longer = RefitVarying(best, more, settings);
    if (!longer.converged) continue;
    const bool pays = longer.gain >= (places.empty() ? 0.0 : v.gain) + kVaryingPays;
    if (pays || !v.converged) v = std::move(longer);
    if (!pays) continue;
    places = std::move(more);
    causes = StillDiffering(v, causes, settings.jobs);
  }
  return v;
}

void HandOut(const VaryingModel& v, const Diagnosis& d, ExtensionReport& report) {
  for (CauseReport& c : report.causes) {
    if (c.cause.each_trial) continue;
    c.refitted.resize(c.sizes.size());
    for (std::size_t k = 0; k < c.refitted.size(); ++k) {
      const int place = FirstPlace(d, c) + static_cast<int>(k);
      for (const VaryingValue& value : v.values)
        if (value.place == place) c.refitted[k] = value;
    }
  }
}

}  // namespace

bool SizesMatter(const SizesReport& sizes, const ExtensionReport& report, double material) {
  constexpr double kWorse = 1.05;
  const std::vector<double>&one_size = report.after.test.rmse, &own = sizes.held_out_rmse;
  for (std::size_t c = 0; c < std::min(one_size.size(), own.size()); ++c)
    if (std::isfinite(one_size[c]) && !std::isfinite(own[c])) return false;
  const double more = sizes.explained - report.explained;
  const double share = report.explained > 0.0 ? more / report.explained : more;
  return IsMainCause(share, ErrorGrowsBy(one_size, own), sizes.held_out_gain, material) &&
         ErrorGrowsBy(own, one_size) < kWorse;
}

void MeasureSizes(ExtensionReport& report, const Diagnosis& d, double material, std::uint64_t seed,
                  const RefitSettings& settings) {
  const std::vector<const CauseReport*> told = report.ToldCauses();
  if (std::none_of(told.begin(), told.end(),
                   [](const CauseReport* c) { return c->Varies() && !c->cause.each_trial; }))
    return;
  const FittedModel& best = d.naming.best;
  std::vector<DifferingCause> differing = DifferingCauses(
      report, d, HeterogeneityOf(UnderWhiteNoise(best), *settings.train, settings.jobs), material);
  if (differing.empty()) return;
  VaryingModel v = RefitOf(best, std::move(differing), settings);
  SizesReport& out = report.sizes.emplace();
  if (!v.converged) return;
  HandOut(v, d, report);
  out.refitted = true;
  out.gain = v.gain;
  out.explained = report.explained;
  out.held_out_rmse = report.after.test.rmse;
  if (v.values.empty()) return;
  // A deviation is a value more and its prior a row more.
  out.explained = 1.0 - LeftShare(d.detection, v.square, best.parameter_count());
  SetRidges(v);
  const HeldOutErrors errors =
      MeasureHeldOut(v.model, settings.jobs, /*test_only=*/true, &report.after);
  out.held_out_rmse = errors.test.rmse;
  out.held_out_gain = CompareHeldOut(best, report.after, errors, seed, nullptr);
  out.pays = out.gain >= kVaryingPays;
  out.matters = SizesMatter(out, report, material);
}

}  // namespace hoplab
