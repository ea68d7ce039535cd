#include "fitting/generated_channels.h"

#include <cmath>
#include <string>

#include "base/channel.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

void CheckLeg(const ChannelSpec& channel, const MechanismSpec& mechanism) {
  const int leg = LegOf(channel.id);
  const int legs = static_cast<int>(mechanism.robot.legs.size());
  if (mechanism.type != MechanismKind::kRobot || leg < legs) return;
  throw InputError({channel.origin.place, ChannelName(channel.id),
                    "is of leg " + std::to_string(leg + 1) + ", and the robot has " +
                        std::to_string(legs) + (legs == 1 ? " leg" : " legs"),
                    "Remove the channel, or add the leg."});
}

void CheckSample(const ChannelSpec& channel, double value, const Trial& trial, bool for_all) {
  const Range range = ChannelRange(channel.id);
  if (range.Contains(value)) return;
  const std::string name = ChannelName(channel.id);
  throw InputError({for_all ? "--noise" : channel.origin.place,
                    name + ": {sigma: " + FormatDouble(channel.sigma.value_or(0.0)) + "}",
                    trial.file + " would have " + name + " = " + Rounded(value) +
                        ", and a sample must be in " + range.Text(),
                    "Let the noise be smaller."});
}

}  // namespace

std::vector<ChannelSpec> ChannelsToGenerate(const Scenario& scenario,
                                            const std::optional<double>& noise) {
  std::vector<ChannelSpec> channels;
  if (scenario.dataset) channels = scenario.dataset->channels;
  if (channels.empty()) channels = {{Channel::kBodyX, 0.001}, {Channel::kBodyY, 0.001}};
  for (ChannelSpec& c : channels) {
    CheckLeg(c, scenario.mechanism);
    if (IsContact(c.id))
      c.sigma.reset();  // no noise is added to it
    else if (noise)
      c.sigma = *noise;
    if (!c.sigma && !IsContact(c.id))
      throw InputError({c.origin.place, std::string(ChannelName(c.id)) + ": {sigma: estimate}",
                        "a dataset to generate needs the noise itself", "State sigma."});
  }
  return channels;
}

void CheckGenerated(const Dataset& dataset, const std::optional<double>& noise) {
  for (const ChannelSpec& channel : dataset.channels) {
    bool found = false;
    for (const Trial& trial : dataset.trials) {
      const std::vector<double>* const values = trial.trace.Find(channel.id);
      if (values == nullptr) continue;
      for (const double value : *values) {
        if (std::isnan(value)) continue;  // a gap
        found = true;
        CheckSample(channel, value, trial, noise.has_value());
      }
    }
    if (!found)
      throw InputError({channel.origin.place, ChannelName(channel.id),
                        "no trial would have a sample of it", "Remove the channel."});
  }
}

}  // namespace hoplab
