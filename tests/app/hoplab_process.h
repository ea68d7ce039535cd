#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/run_process.h"

namespace hoplab::testing {

/// Runs the program under test in `folder`.
inline ProcessResult RunHoplab(const std::vector<std::string>& arguments,
                               const std::filesystem::path& folder,
                               std::chrono::seconds timeout = std::chrono::seconds(120)) {
  ProcessRequest request{.command = {HOPLAB_BINARY}, .folder = folder, .timeout = timeout};
  request.command.insert(request.command.end(), arguments.begin(), arguments.end());
  return RunProcess(request);
}

/// A file or folder of the project.
inline std::string Shipped(const std::string& name) {
  return (std::filesystem::path(HOPLAB_SOURCE_DIR) / name).string();
}

inline std::string ShippedDataset(const std::string& name) { return Shipped("datasets/" + name); }

/// A short, exactly known scenario of three trials for `generate`.
inline const char* const kScenario =
    "format: hoplab-scenario/1\n"
    "name: three-hops\n"
    "law: elastica\n"
    "mechanism: {type: c_leg, body_mass_kg: 1.0, gravity_m_per_s2: 9.81, leg: {rest_radius_m: "
    "0.09, "
    "E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, damping_N_s_per_m: 3.0}}\n"
    "touchdown_angle_deg: 25\n"
    "initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 1.0, vy_m_per_s: 0}\n"
    "stop: {time_s: 1.0}\n";

/// Writes the scenario with `extra` lines at its end; returns the file's name in `folder`.
inline std::string WriteScenario(const std::filesystem::path& folder,
                                 const std::string& extra = "") {
  WriteText(folder / "hops.yaml", std::string(kScenario) + extra);
  return "hops.yaml";
}

/// `rig-drops` with every trial's CSV passed through `change`, in `folder`/data.
template <class Change>
std::string ChangedDataset(const std::filesystem::path& folder, const Change& change) {
  const std::filesystem::path copy = folder / "data";
  std::filesystem::create_directories(copy);
  for (const auto& entry : std::filesystem::directory_iterator(ShippedDataset("rig-drops"))) {
    const std::string text = ReadText(entry.path());
    const bool trial = entry.path().extension() == ".csv";
    WriteText(copy / entry.path().filename(), trial ? change(text) : text);
  }
  return "data";
}

inline nlohmann::json ReadRecord(const std::filesystem::path& folder) {
  return nlohmann::json::parse(ReadText(folder / "run.json"));
}

/// A run.json without the line that tells how long the run took.
inline std::string WithoutSeconds(const std::string& record) {
  const std::size_t begin = record.find(" \"seconds\"");
  return record.substr(0, begin) + record.substr(record.find('\n', begin));
}

}  // namespace hoplab::testing
