#include "experiments/identification/identification.h"

namespace hoplab {

std::vector<StudyReading> AllReadings() {
  std::vector<StudyReading> readings = {StudyReading()};
  for (const ReadingKey& key : ReadingKeys()) {
    if (key.key == "torque_sign") continue;
    std::vector<StudyReading> longer;
    for (const StudyReading& reading : readings) {
      for (int word = 0; word < static_cast<int>(key.words.size()); ++word) {
        longer.push_back(reading);
        key.set(longer.back().law, word);
      }
    }
    readings = std::move(longer);
  }
  const std::size_t half = readings.size();
  for (std::size_t i = 0; i < half; ++i) {
    readings.push_back(readings[i]);
    readings.back().liftoff = LiftoffRule::kRestLength;
  }
  return readings;
}

}  // namespace hoplab
