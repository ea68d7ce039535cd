#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/input_kind.h"
#include "datasets/dataset.h"
#include "datasets/import/start_of_trace.h"

namespace hoplab {

/// What a new dataset.yaml says.
struct DatasetText {
  struct Trial {
    std::string file;
    TrialRole role = TrialRole::kTrain;
    RobotTrial robot;  // of a robot alone
  };
  std::string name;
  std::string note;  // of the source
  MechanismKind type = MechanismKind::kCLeg;
  std::vector<Channel> channels;
  std::vector<Trial> trials;
  int legs = 0;                                             // of a robot
  std::vector<InputKind> inputs;                            // that drive its motors
  std::vector<std::pair<std::string, std::string>> values;  // by dotted key
};

/// What stands behind the keys of values that are not known.
enum class Blanks {
  kBlank,   // nothing, and the hint what it is
  kSamples  // a value of the right form, to see whether the rest is right
};

/// dataset.yaml with every value a fit needs: those given, gravity of 9.81 m/s^2, of a robot the
/// initial states that its traces tell, and blanks. Throws InputError for a value that has no place
/// there.
std::string FormatDatasetText(const DatasetText& dataset, Blanks blanks);

}  // namespace hoplab
