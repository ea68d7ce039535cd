#pragma once

#include <string>
#include <vector>

#include "app/export/exported_model.h"
#include "model/hybrid/automaton.h"
#include "model/mechanisms/leg.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {

/// A leg twice: as the library has it, and as its exported C file, compiled and run, has it.
class ExportedLeg {
 public:
  struct State {
    Mode mode;
    double contact, arc;  // the search for the arc begins there
    double z[4];
  };

  /// What one of the two says of a state.
  struct Answer {
    int lost = 0;
    double fx, fy, torque, contact_x, length, arc, angle, angle_rate, contact_rate;
    int next = 0;
    double next_contact, vx, vy;
  };

  explicit ExportedLeg(ExportedModel model);
  /// States of every mode: hips that sink and rise, legs pressed by more and less.
  std::vector<State> Grid() const;
  /// The law's own root: found once, and then from there, so that what its stop leaves is gone.
  Answer Library(const State& s);
  /// Compiles and runs the file.
  std::vector<Answer> CFile(const std::vector<State>& states);
  /// The largest difference, forces over the weight or their own size, the rest over its unit.
  double Compare();
  /// The rate of the leg angle against differences of the angle along the hip's way.
  double CompareRates();

 private:
  double Reach() const;
  std::string Describe(const State& s) const;

  ExportedModel model_;
  Parameters<double> p_;
  SystemStorage<double> body_;
  TempFolder temp_;
};

}  // namespace hoplab::testing
