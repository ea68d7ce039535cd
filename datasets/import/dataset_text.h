#pragma once

#include <string>
#include <utility>
#include <vector>

#include "datasets/dataset.h"

namespace hoplab {

/// What a new dataset.yaml says.
struct DatasetText {
  struct Trial {
    std::string file;
    TrialRole role = TrialRole::kTrain;
  };
  std::string name;
  std::string note;  // of the source
  MechanismKind type = MechanismKind::kCLeg;
  std::vector<Channel> channels;
  std::vector<Trial> trials;
  std::vector<std::pair<std::string, std::string>> values;  // by dotted key
};

/// dataset.yaml with every value a fit needs: those given, gravity of 9.81 m/s^2, and the rest with
/// `blank` behind the key and the hint what it is. Throws InputError for a value that has no place
/// there.
std::string FormatDatasetText(const DatasetText& dataset, const std::string& blank);

}  // namespace hoplab
