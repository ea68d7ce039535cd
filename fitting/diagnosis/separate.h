#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fitting/diagnosis/extension.h"

namespace hoplab {

/// A trial somebody could record: one of the train trials with some settings changed.
struct TrialDesign {
  std::string like;              // file of the train trial it is modelled on
  double touchdown_angle = 0.0;  // rad
  double height = 0.0;           // of the start [m]
  double speed = 0.0;            // vx of the start [m/s]
  std::optional<double> kp;      // N s; absent without a controller
};

/// The trial that tells rival models apart best, with what it is expected to bring.
struct SeparatingExperiment {
  TrialDesign design;
  /// Expected log-likelihood ratio against the closest rival, after that one has been refitted to
  /// old and new data together [nats].
  double expected_nats = 0.0;
  std::string closest_rival;  // name of what the best model is hardest to tell from
  int designs_tried = 0;
  /// Enough to settle it.
  bool Separates() const;
};

/// Looks over a grid of designs around the train trials by a linear forecast and settles the most
/// promising by refits. `rivals[0]` is taken for the truth. Absent
/// if there is no rival or no design can be simulated under all of them.
std::optional<SeparatingExperiment> ProposeExperiment(std::span<const Extension> rivals,
                                                      const std::vector<TrialProblem>& train,
                                                      int jobs);

/// "drop from 0.35 m at 1.2 m/s, touch-down angle 40 deg": a design in words.
std::string Describe(const TrialDesign& design);

}  // namespace hoplab
