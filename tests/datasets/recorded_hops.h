#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "datasets/read_dataset.h"
#include "datasets/write_dataset.h"
#include "tests/datasets/small_dataset.h"
#include "tests/support/input_error_of.h"

namespace hoplab::testing {

/// Two drops: down through 0.17 m (touch-down at 25 deg: 0.1716 m), up, down again.
inline const char* const kRecordedHops =
    "time_s,body_y_m,leg_angle_rad,hip_torque_N_m,command\n"
    "0.0,0.30,0.50,0.1,1\n"
    "0.1,0.19,0.44,0.2,1\n"
    "0.2,0.15,0.10,0.3,2\n"
    "0.3,0.25,0.60,0.4,2\n"
    "0.4,0.18,0.40,0.5,3\n"
    "0.5,0.14,0.20,0.6,3\n";
inline const char* const kRecordYaml =
    "format: hoplab-dataset/1\n"  // 1
    "name: hops\n"                // 2
    "mechanism:\n"                // 3
    "  type: c_leg\n"             // 4
    "  body_mass_kg: 1.0\n"       // 5
    "  gravity_m_per_s2: 9.81\n"  // 6
    "  leg: {rest_radius_m: 0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, "
    "damping_N_s_per_m: 3}\n"                 // 7
    "channels: {body_y_m: {sigma: 0.001}}\n"  // 8
    "trials:\n"                               // 9
    "  - file: a.csv\n"                       // 10
    "    role: train\n"                       // 11
    "    touchdown_angle_deg: 25\n";          // 12

inline Dataset ReadRecord(const std::string& yaml, const std::string& csv = kRecordedHops) {
  return ReadDatasetText(yaml, {{"a.csv", csv}}, "hops");
}

/// kRecordYaml with one line changed.
inline Dataset RecordWith(const std::string& from, const std::string& to) {
  return ReadRecord(Replace(kRecordYaml, from, to));
}

inline std::string RecordErrorWith(const std::string& from, const std::string& to,
                                   const std::string& csv = kRecordedHops) {
  return InputErrorOf([&] { ReadRecord(Replace(kRecordYaml, from, to), csv); });
}

inline std::string ErrorOfAngle(const std::string& angle, const std::string& csv = kRecordedHops) {
  return RecordErrorWith("touchdown_angle_deg: 25", "touchdown_angle_deg: " + angle, csv);
}

inline std::string ErrorOfInputs(const std::string& inputs) {
  return RecordErrorWith("trials:", "inputs: " + inputs + "\ntrials:");
}

inline void ExpectRoundTrip(const Dataset& dataset) {
  std::map<std::string, std::string> files = FormatDataset(dataset);
  const Dataset again = ReadDatasetText(files["dataset.yaml"], files);
  EXPECT_EQ(again, dataset) << files["dataset.yaml"];
}

/// What a file was refused with, and what it should say.
struct Refusal {
  std::string error, says;
};
inline void ExpectSays(const std::vector<Refusal>& table) {
  for (const Refusal& one : table) EXPECT_EQ(one.error, one.says);
}

}  // namespace hoplab::testing
