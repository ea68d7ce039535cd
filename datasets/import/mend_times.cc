#include "datasets/import/mend_times.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace hoplab {
namespace {

std::string Counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::size_t SortByStamp(std::vector<StampedRow>& rows,
                        const std::function<void(std::size_t)>& too_far) {
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rows[a].time_s < rows[b].time_s; });
  std::size_t moved = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] == i) continue;
    ++moved;
    const std::size_t distance = order[i] > i ? order[i] - i : i - order[i];
    if (distance > kFurthestSwap) too_far(rows[order[i]].row);
  }
  std::vector<StampedRow> sorted;
  sorted.reserve(rows.size());
  for (const std::size_t i : order) sorted.push_back(std::move(rows[i]));
  rows = std::move(sorted);
  return moved;
}

// The rows [first, last) have one stamp: each gets its own, from there up to `next_s`.
void Spread(std::vector<StampedRow>& rows, std::size_t first, std::size_t last, double next_s) {
  const double begin = rows[first].time_s;
  const double step = (next_s - begin) / static_cast<double>(last - first);
  for (std::size_t i = first + 1; i < last; ++i) {
    rows[i].time_s = begin + step * static_cast<double>(i - first);
    rows[i].text = FormatDouble(rows[i].time_s);
    rows[i].time_s = *ParseDouble(rows[i].text);
  }
}

}  // namespace

std::string MendedTimes::Text() const {
  std::vector<std::string> words;
  if (swapped > 0)
    words.push_back(Counted(swapped, "row", "rows") + " put in the order of their stamps");
  if (dropped > 0) words.push_back(Counted(dropped, "repeated row", "repeated rows") + " dropped");
  if (spread > 0)
    words.push_back(Counted(spread, "row that shared a stamp", "rows that shared a stamp") +
                    " spread up to the next one");
  return Join(words);
}

MendedTimes MendTimes(std::vector<StampedRow>& rows,
                      const std::function<bool(std::size_t, std::size_t)>& same_samples,
                      const std::function<void(std::size_t)>& too_far) {
  MendedTimes mended;
  mended.swapped = SortByStamp(rows, too_far);
  std::vector<StampedRow> kept;
  kept.reserve(rows.size());
  for (StampedRow& row : rows) {
    bool repeats = false;
    for (auto other = kept.rbegin(); other != kept.rend() && other->time_s == row.time_s; ++other)
      repeats = repeats || same_samples(other->row, row.row);
    if (repeats)
      ++mended.dropped;
    else
      kept.push_back(std::move(row));
  }
  rows = std::move(kept);
  double step_before = 1e-3;  // s, from one stamp to the next, as the log has them
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first + 1;
    while (last < rows.size() && rows[last].time_s == rows[first].time_s) ++last;
    const std::size_t shared = last - first - 1;
    // The last stamp of a log is followed by as much time as the one before it was.
    if (last < rows.size()) step_before = rows[last].time_s - rows[first].time_s;
    if (shared > 0) {
      Spread(rows, first, last,
             last < rows.size() ? rows[last].time_s : rows[first].time_s + step_before);
      mended.spread += shared;
    }
    first = last;
  }
  return mended;
}

}  // namespace hoplab
