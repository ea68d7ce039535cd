#pragma once

#include <string>
#include <vector>

#include "app/records/run_record.h"

namespace hoplab {

/// One of the figures a report begins with.
struct HeadlineFigure {
  std::string label;    // "E", "test error, body_y"
  std::string value;    // "22.98", "not computed"
  std::string unit;     // "GPa"; may be empty
  std::string note;     // "22.79 .. 23.16 between trials"; may be empty
  std::string pointer;  // where it stands in run.json, as "/parameters/0/value"
};

/// The answer of a run: a sentence and up to three figures, from its run.json alone.
struct Headline {
  std::string title;  // "Fit of rig-drops"
  std::string sentence;
  std::vector<HeadlineFigure> figures;
};

/// Never throws for a record that lacks something: what is missing is left out, or "not computed".
Headline HeadlineOf(const Json& record);

}  // namespace hoplab
