#include "app/records/reproduction_runs.h"

#include <algorithm>

#include "app/records/trajectory_tables.h"

namespace hoplab {
namespace {

constexpr double kRate = 250.0;   // Hz
constexpr double kLongest = 6.0;  // s: several hops of either leg

bool ComparesLegs(const StudyFigure& figure) {
  const auto has = [&](bool straight) {
    return std::any_of(figure.curves.begin(), figure.curves.end(), [&](const StudyCurve& curve) {
      return curve.settings && curve.settings->straight.has_value() == straight;
    });
  };
  return has(true) && has(false);
}

}  // namespace

std::optional<RunsInMotion> ComparedLegs(const Study& study, const Reproduction& reproduction) {
  const auto figure =
      std::find_if(reproduction.figures.begin(), reproduction.figures.end(), ComparesLegs);
  if (figure == reproduction.figures.end()) return std::nullopt;
  RunsInMotion runs;
  CsvText csv(TrajectoryHeader({"run"}));
  for (const StudyCurve& curve : figure->curves) {
    if (!curve.settings) continue;
    const Hopper hopper = HopperOfCaption(study, *curve.settings);
    SimulationRequest request = RequestOf(hopper);
    request.horizon = std::min(request.horizon, kLongest);
    AddTrajectoryRows(request, kRate, {curve.label}, 0.0, csv);
    runs.mechanisms[curve.label] = MechanismRecord(request);
  }
  runs.table = csv.text();
  return runs;
}

}  // namespace hoplab
