#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "base/text.h"
#include "base/units.h"
#include "fitting/trace_faults.h"

namespace hoplab {
namespace {

// What a reader is told of one kind of fault in one channel.
class Telling {
 public:
  Telling(const Dataset& dataset, const TraceFault& first, bool kept)
      : trial_(dataset.trials[first.trial]), first_(first), kept_(kept) {}

  bool Covers(const TraceFault& fault) const {
    return fault.kind == first_.kind &&
           (fault.channel == first_.channel || fault.kind == TraceFault::Kind::kSmoothedEnd);
  }
  void Add(const TraceFault& fault) {
    count_ += fault.rows.size();
    ++trials_;
    largest_ = std::max(largest_, fault.largest);
  }

  std::string Sentence() const {
    const std::string name = ChannelName(first_.channel);
    const bool one = count_ == 1;
    const std::string samples = std::to_string(count_) + (one ? " sample of " : " samples of ") +
                                name + Many() + (one ? ", in " : ", first in ") + Where() + ", ";
    switch (first_.kind) {
      case TraceFault::Kind::kStray:
        return samples + (one ? "lies" : "lie") + " off the motion before and after by up to " +
               Size() + Fate(one ? "it is" : "they are");
      case TraceFault::Kind::kHeld:
        return samples + (one ? "repeats" : "repeat") +
               " the one before to the last digit, as where a sensor holds its value" +
               Fate(one ? "it is" : "they are");
      case TraceFault::Kind::kBeforeRelease:
        return "the body is held until " + Rounded(first_.release.time_s) + " s of " + trial_.file +
               Others() + ", and then falls free; what is before" + NotCompared(" is");
      case TraceFault::Kind::kAfterCatch:
        return "the body rests in the air at the end of " + trial_.file + Others() +
               ": it was caught, at " + Rounded(trial_.trace.time_s[first_.rows[0]]) +
               " s; what follows" + NotCompared(" is");
      case TraceFault::Kind::kBeforeFlight:
        return trial_.file + Others() +
               " begins in a stance; what is before the top of its first flight, at " +
               Rounded(trial_.trace.time_s[first_.rows.back() + 1]) + " s," + NotCompared(" is");
      case TraceFault::Kind::kFall:
        return "the body falls to the ground at the end of " + trial_.file + Others() +
               "; what follows the top of its last flight, at " +
               Rounded(trial_.trace.time_s[first_.rows[0] - 1]) + " s," + NotCompared(" is");
      case TraceFault::Kind::kSmoothedEnd:
        return "the traces were smoothed, and a filter makes up what lies beyond their ends: " +
               std::to_string(count_) + " samples near the ends" + NotCompared(" are");
      case TraceFault::Kind::kJump:
        break;
    }
    return name + " jumps by " + Size() +
           (one ? "" : " at most, " + std::to_string(count_) + " times") + Many() +
           (one ? ", in " : ", first in ") + Where() + ", while the motion goes on" + Reason() +
           Fate("what follows is");
  }

 private:
  std::string Many() const {
    return trials_ > 1 ? " in " + std::to_string(trials_) + " trials" : "";
  }
  std::string Others() const {
    return trials_ > 1 ? " (likewise in " + std::to_string(trials_ - 1) + " more)" : "";
  }
  std::string Where() const {
    return trial_.file + " at " + Rounded(trial_.trace.time_s[first_.rows[0]]) + " s";
  }
  std::string Size() const { return Rounded(largest_) + " " + ChannelUnit(first_.channel); }
  std::string NotCompared(const std::string& what) const {
    return what + (kept_ ? " compared all the same" : " not compared");
  }
  std::string Fate(const std::string& what) const { return "; " + NotCompared(what); }
  std::string Reason() const {
    constexpr double kTurn = 2.0 * kPi;
    const bool angle = std::string_view(ChannelUnit(first_.channel)) == "rad";
    if (angle && std::abs(largest_ - kTurn) < 0.01 * kTurn)
      return ", by a whole turn: an angle must go on counting";
    return angle ? "" : ", as where a camera or a marker is moved";
  }

  const Trial& trial_;
  const TraceFault& first_;
  bool kept_;
  std::size_t count_ = 0, trials_ = 0;
  double largest_ = 0.0;
};

}  // namespace

std::vector<std::string> FaultSentences(const Dataset& dataset,
                                        const std::vector<TraceFault>& faults, bool kept) {
  std::vector<Telling> tellings;
  for (const TraceFault& fault : faults) {
    auto telling = std::find_if(tellings.begin(), tellings.end(),
                                [&](const Telling& t) { return t.Covers(fault); });
    if (telling == tellings.end()) {
      tellings.emplace_back(dataset, fault, kept);
      telling = std::prev(tellings.end());
    }
    telling->Add(fault);
  }
  std::vector<std::string> sentences;
  for (const Telling& telling : tellings) sentences.push_back(telling.Sentence());
  return sentences;
}

}  // namespace hoplab
