#include "fitting/diagnosis/odd_channel.h"

#include <algorithm>
#include <string>
#include <utility>

#include "fitting/diagnosis/verdict.h"

namespace hoplab {
namespace {

// What a clock may be off by before it is looked at [s].
constexpr double kClockSigma = 0.02;

bool IsOfPose(Channel c) { return c <= Channel::kBodyVy || c == Channel::kBodyPitch; }
bool IsOther(const ChannelSpec& c) { return !IsOfPose(c.id) && !IsContact(c.id); }

Dataset WithClockOf(Dataset dataset, std::size_t channel) {
  std::string name = std::string(NameOf(dataset.channels[channel].id)) + "_clock";
  for (const ClockSpec& other : dataset.clocks)
    if (other.name == name) name += "_2";
  dataset.channels[channel].clock = name;
  dataset.clocks.push_back({name, 0.0, kClockSigma});
  return dataset;
}
Dataset WithoutChannel(Dataset dataset, std::size_t channel) {
  dataset.channels.erase(dataset.channels.begin() + static_cast<std::ptrdiff_t>(channel));
  return dataset;
}

bool IsAdequate(const Diagnosis& d) {
  return !d.interrupted && d.refusal.empty() && d.verdict == Verdict::kAdequate;
}

// How the fitted offset of the last clock is known.
OddChannel ByClock(const Diagnosis& d, Channel channel) {
  OddChannel odd{channel};
  const std::string name = "clock." + d.problem.clocks.back().name + ".offset";
  for (std::size_t k = 0; k < d.problem.shared.size(); ++k) {
    if (d.problem.shared[k].name != name) continue;
    odd.offset_s = d.null.shared[static_cast<Eigen::Index>(k)];
    odd.offset_ci95 = d.uncertainty.parameters[k].Wider();
  }
  return odd;
}

}  // namespace

bool HasOtherSensors(const Dataset& dataset) {
  const auto of_pose = [](const ChannelSpec& c) { return IsOfPose(c.id); };
  return std::any_of(dataset.channels.begin(), dataset.channels.end(), IsOther) &&
         std::any_of(dataset.channels.begin(), dataset.channels.end(), of_pose);
}

Diagnosis DiagnoseWithOddChannel(const Dataset& dataset, const DiagnosisOptions& options,
                                 const Diagnosing& diagnose) {
  DiagnosisOptions look = options;
  look.max_effects = 0;
  Diagnosis seen = diagnose(dataset, look);
  if (seen.interrupted || !seen.refusal.empty() || IsAdequate(seen)) return seen;
  const auto stage = [&](Channel channel, const char* what) {
    if (options.stage)
      options.stage("looking whether all but " + std::string(NameOf(channel)) + what);
  };
  for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
    const ChannelSpec& channel = dataset.channels[c];
    if (!IsOther(channel) || !channel.clock.empty()) continue;
    if (options.fit.IsStopped()) break;
    stage(channel.id, "'s clock is right");
    Diagnosis d = diagnose(WithClockOf(dataset, c), look);
    if (!IsAdequate(d)) continue;
    d.odd_channel = ByClock(d, channel.id);
    d.notes.push_back(std::string(NameOf(channel.id)) +
                      " was given a clock of its own; `clocks` in dataset.yaml keeps it");
    return d;
  }
  for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
    const ChannelSpec& channel = dataset.channels[c];
    if (!IsOther(channel)) continue;
    if (options.fit.IsStopped()) break;
    stage(channel.id, " is right");
    Diagnosis without = diagnose(WithoutChannel(dataset, c), look);
    if (!IsAdequate(without)) continue;
    // A cause may show in that channel alone: one is told rather than a sensor that is wrong.
    DiagnosisOptions one = options;
    one.max_effects = 1;
    Diagnosis by_cause = diagnose(dataset, one);
    if (by_cause.interrupted || (NamesSomething(by_cause) && !by_cause.left.material &&
                                 by_cause.verdict != Verdict::kUnexplained))
      return by_cause;
    without.odd_channel = OddChannel{channel.id};
    without.notes.push_back(std::string(NameOf(channel.id)) +
                            " was left out: neither another clock nor any one cause makes it agree "
                            "with the others; its gain, its zero or a filter may be wrong");
    return without;
  }
  if (options.fit.IsStopped()) {
    seen.interrupted = true;
    return seen;
  }
  return diagnose(dataset, options);
}

}  // namespace hoplab
