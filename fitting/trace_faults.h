#pragma once

#include <string>
#include <vector>

#include "datasets/dataset.h"
#include "fitting/handled_ends.h"

namespace hoplab {

/// What a trace of the body's place or pitch shows that no body does, of one channel of one trial.
struct TraceFault {
  enum class Kind {
    kStray,  // samples far off the motion on both of their sides, which is one smooth motion
    kHeld,   // repeats of the sample before, where the noise makes equal samples impossible
    kJump,   // from these rows on the motion goes on smoothly, but from another place
    kBeforeRelease,  // the body is held, and then let go: the rows before (FindRelease)
    kAfterCatch,     // it is caught in the air: the rows from there on (FindCatch)
    kBeforeFlight,   // the record begins in a stance: the rows before its first flight's top
    kFall,           // the body falls to the ground: the rows after its last flight's top
    kSmoothedEnd     // of a trace that was smoothed: the samples near its ends (FindSmoothedEnds)
  };
  Kind kind = Kind::kStray;
  std::size_t trial = 0;
  Channel channel = Channel::kBodyX;
  std::vector<std::size_t> rows;  // of the trace, ascending
  double largest = 0.0;           // the largest distance [the channel's unit]
  Release release = {};           // of kBeforeRelease

  /// The rows are all before, or all after, what is compared.
  bool IsAnEnd() const {
    return kind == Kind::kBeforeRelease || kind == Kind::kAfterCatch ||
           kind == Kind::kBeforeFlight || kind == Kind::kFall;
  }
};
/// "stray", "held", "jump", "before_release", "after_catch", "before_flight", "fall" or
/// "smoothed_end".
std::string_view NameOf(TraceFault::Kind kind);

/// All of them, by what is recorded alone: no law is asked. The motion beside a sample is a
/// parabola through up to six samples on either side; where these do not lie on one, as about a
/// blow, nothing is called stray. A stray sample is 6 standard deviations of the noise off it, and
/// the first and last of several 4 off the motion on their own side; a jump is 10. At most ten
/// stray samples follow one another, more only between a jump and one back. The first and the last
/// sample must lie as far off the motion beside them, and farther than a blow within that step can
/// throw the body: what turns the fastest motion that is seen about, of a ball 4.5 times that
/// speed. Up to three between a gap and an end of the trace are held against the motion before the
/// gap. The noise is that of HighFrequencyNoise; where it cannot be told, or where a twelfth of the
/// samples is off the motion before them, as in a trace that is sampled coarsely, nothing is found.
std::vector<TraceFault> FindTraceFaults(const Dataset& dataset);

/// The dataset with stray and held samples and those near the ends of smoothed traces missing, and
/// of a channel that jumps all that follows: nobody knows where the body is from there on. A trial
/// begins after the release and ends before the catch, or at the top of the flight from which the
/// body fell; a start that is stated is that of the release, moved on to the first row. One that
/// begins in a stance begins at the top of its first flight, and what is stated of its start is
/// dropped: the trace has it.
Dataset WithoutFaults(Dataset dataset, const std::vector<TraceFault>& faults);

/// A sentence for each channel and kind, for a reader: how many samples of which trials, and
/// whether they are compared.
std::vector<std::string> FaultSentences(const Dataset& dataset,
                                        const std::vector<TraceFault>& faults, bool kept);

}  // namespace hoplab
