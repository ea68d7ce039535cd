#pragma once

#include "experiments/study/study_result.h"

namespace hoplab {

/// "figure-4.5", "figure-4.6", "figure-6.5" to "figure-6.34", in this order.
std::vector<std::string> StudyFigureNames();

/// Runs what the caption of that figure states; `name` must be one of the above.
StudyFigure RunStudyFigure(const std::string& name, const Study& study);

/// Settings of the captions, for figures and for the claims about them.
struct StudyCaptions {
  /// Figures 6.5 to 6.10: a single jump from 0.3 m, upright at rest or at 20 deg and 0.6 m/s.
  static CaptionSettings SingleJump(bool rolling, double damping);
  /// Figures 6.11 to 6.16: no torque, from rest.
  static CaptionSettings FromRest(double touchdown_angle_deg, double damping);
  /// Figures 6.17 to 6.22: no torque, 20 deg, 1 m/s.
  static CaptionSettings Forward(double damping);
  /// Figures 6.23 to 6.34: controlled, 40 deg, 1 m/s.
  static CaptionSettings Controlled(double damping);
  /// The straight leg that stands for the controlled C-leg of that damping.
  static CaptionSettings Straight(const Study& study, double damping);
};

}  // namespace hoplab
