#include "fitting/smoothed_ends.h"

#include <algorithm>
#include <cmath>

#include "fitting/filtered_noise.h"
#include "model/pose_filter.h"

namespace hoplab {
namespace {

constexpr double kMostShare = 0.125;  // of a trial, at either end

// How long what a filter made up for is seen [s].
struct MadeUp {
  double at_begin, at_end;
};
MadeUp MadeUpBy(const NoiseShape& noise) {
  constexpr double kDecayed = 5.0;
  switch (noise.filter) {
    case RecordFilter::kTwoPass:
      return {kDecayed * noise.time, kDecayed * noise.time};
    case RecordFilter::kOnePass:
      return {2.0 * kDecayed * noise.time, 0.0};
    case RecordFilter::kMovingAverage:
      return {noise.time, noise.time};
    case RecordFilter::kFirstOrder:  // as noise may be without a filter
    case RecordFilter::kNone:
      break;
  }
  return {0.0, 0.0};
}

}  // namespace

std::vector<TraceFault> FindSmoothedEnds(const Dataset& dataset) {
  std::vector<TraceFault> ends;
  const MadeUp made_up = MadeUpBy(NoiseShapeOf(dataset));
  if (!(made_up.at_begin > 0.0)) return ends;
  for (const ChannelSpec& channel : dataset.channels) {
    if (!IsFiltered(channel.id)) continue;
    for (std::size_t k = 0; k < dataset.trials.size(); ++k) {
      const Trace& trace = dataset.trials[k].trace;
      const std::vector<double>* values = trace.Find(channel.id);
      if (!values || trace.time_s.empty()) continue;
      const double begin = trace.time_s.front(), end = trace.time_s.back();
      const double most = kMostShare * (end - begin);
      TraceFault first{TraceFault::Kind::kSmoothedEnd, k, channel.id, {}}, last = first;
      for (std::size_t row = 0; row < values->size(); ++row) {
        if (std::isnan((*values)[row])) continue;
        if (trace.time_s[row] < begin + std::min(made_up.at_begin, most)) first.rows.push_back(row);
        if (trace.time_s[row] > end - std::min(made_up.at_end, most)) last.rows.push_back(row);
      }
      for (TraceFault* fault : {&first, &last})
        if (!fault->rows.empty()) ends.push_back(*fault);
    }
  }
  return ends;
}

}  // namespace hoplab
