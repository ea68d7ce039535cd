#include "fitting/diagnosis/sizes.h"

#include <algorithm>

#include "fitting/diagnosis/verdict.h"

namespace hoplab {
namespace {

// Places of a cause's values among those of the extension.
int FirstPlace(const Diagnosis& d, const CauseReport& cause) {
  return d.naming.best.PlaceOf(static_cast<int>(d.naming.MemberOf(cause.candidate)));
}

// Places that differ between trials: of each told cause that varies, the largest share first.
std::vector<std::vector<int>> DifferingPlaces(const ExtensionReport& report, const Diagnosis& d) {
  std::vector<std::vector<int>> of_causes;
  for (const CauseReport* c : report.ToldCauses()) {
    std::vector<int> places;
    for (std::size_t k = 0; k < c->sizes.size(); ++k)
      if (Differs(c->sizes[k])) places.push_back(FirstPlace(d, *c) + static_cast<int>(k));
    if (!places.empty()) of_causes.push_back(std::move(places));
  }
  return of_causes;
}

// All that vary together; where that does not come to rest, the first cause that does alone.
VaryingModel RefitOf(const FittedModel& best, const std::vector<std::vector<int>>& of_causes,
                     const RefitSettings& settings) {
  std::vector<int> all;
  for (const std::vector<int>& places : of_causes)
    all.insert(all.end(), places.begin(), places.end());
  VaryingModel v = RefitVarying(best, all, settings);
  for (std::size_t i = 0; i < of_causes.size() && of_causes.size() > 1 && !v.converged; ++i)
    v = RefitVarying(best, of_causes[i], settings);
  return v;
}

void HandOut(const VaryingModel& v, const Diagnosis& d, ExtensionReport& report) {
  for (CauseReport& c : report.causes) {
    c.refitted.resize(c.sizes.size());
    for (std::size_t k = 0; k < c.refitted.size(); ++k) {
      const int place = FirstPlace(d, c) + static_cast<int>(k);
      for (const VaryingValue& value : v.values)
        if (value.place == place) c.refitted[k] = value;
    }
  }
}

}  // namespace

void MeasureSizes(ExtensionReport& report, const Diagnosis& d, const RefitSettings& settings) {
  const std::vector<std::vector<int>> differing = DifferingPlaces(report, d);
  if (differing.empty()) return;
  const FittedModel& best = d.naming.best;
  const VaryingModel v = RefitOf(best, differing, settings);
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
  out.held_out_rmse = MeasureHeldOut(v.model, settings.jobs, /*test_only=*/true).test.rmse;
  out.pays = out.gain >= kVaryingPays;
}

}  // namespace hoplab
