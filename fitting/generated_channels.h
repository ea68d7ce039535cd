#pragma once

#include <optional>
#include <vector>

#include "datasets/dataset.h"
#include "datasets/scenario.h"

namespace hoplab {

/// The channels of a dataset that is generated, each with its noise: the scenario's, else x and y
/// of the body with 1 mm. `noise` replaces every sigma. Throws InputError for a channel without a
/// number and for one of a leg that the robot does not have.
std::vector<ChannelSpec> ChannelsToGenerate(const Scenario& scenario,
                                            const std::optional<double>& noise);

/// Throws InputError for a channel without any sample and for a sample out of its channel's range:
/// such a dataset could not be read. `noise` as it was given to ChannelsToGenerate.
void CheckGenerated(const Dataset& dataset, const std::optional<double>& noise);

}  // namespace hoplab
