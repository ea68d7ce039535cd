#pragma once

#include <string>
#include <vector>

#include "datasets/import/dataset_text.h"

namespace hoplab {

/// A value that a new dataset.yaml has a place for and nobody has said yet.
struct WaitingValue {
  std::string key;     // "mechanism.body_mass_kg", "trials.0.controller"
  std::string hint;    // what it is and where to get it
  std::string sample;  // of the right form: "0.01", "[1, 1]"
  bool optional = false;
};

/// Those of a robot beside what its mechanism needs: hips, what its motors did or where they begin,
/// and the initial states that a trace does not tell. `controller` of all trials may stand for each
/// one's.
void AddRobotValues(const DatasetText& dataset, std::vector<WaitingValue>* values);

/// The lines `initial` and `initial_sigma` of a trial, without those that are `given` or that its
/// trace does not tell.
std::string StartText(const RobotTrial& trial, bool given);

}  // namespace hoplab
