// The robots of datasets/, which a physics engine made, with one thing wrong in what measures them:
// what diagnose calls a main cause, and whether it is there. ctest -L statistics -R RobotSensors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "datasets/read_dataset.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab::testing {
namespace {

std::vector<double>* ColumnOf(Trace& trace, Channel channel) {
  for (TraceColumn& column : trace.columns)
    if (column.name == ChannelName(channel)) return &column.values;
  return nullptr;
}

void Scale(Trace& trace, Channel channel, double by) {
  for (double& value : *ColumnOf(trace, channel)) value *= by;
}

// A marker that sits at (dx, dy) in the body frame, by the pitch that was read: its noise of 1 mrad
// moves it by 8 um.
void MoveMarker(Trace& trace, double dx, double dy) {
  std::vector<double>&x = *ColumnOf(trace, Channel::kBodyX), &y = *ColumnOf(trace, Channel::kBodyY);
  const std::vector<double>& pitch = *ColumnOf(trace, Channel::kBodyPitch);
  for (std::size_t row = 0; row < x.size(); ++row) {
    x[row] += dx * std::cos(pitch[row]) - dy * std::sin(pitch[row]);
    y[row] += dx * std::sin(pitch[row]) + dy * std::cos(pitch[row]);
  }
}

// The pose by so many rows later; there is none before the start.
void DelayPose(Trace& trace, std::size_t rows) {
  for (const Channel channel : {Channel::kBodyX, Channel::kBodyY, Channel::kBodyPitch}) {
    std::vector<double>& values = *ColumnOf(trace, channel);
    values.insert(values.begin(), rows, std::numeric_limits<double>::quiet_NaN());
    values.resize(trace.time_s.size());
  }
}

// What a camera that hangs askew sees, its pitch included.
void Roll(Trace& trace, double roll) {
  std::vector<double>&x = *ColumnOf(trace, Channel::kBodyX), &y = *ColumnOf(trace, Channel::kBodyY);
  for (std::size_t row = 0; row < x.size(); ++row) {
    const double across = std::cos(roll) * x[row] - std::sin(roll) * y[row];
    y[row] = std::sin(roll) * x[row] + std::cos(roll) * y[row];
    x[row] = across;
  }
  for (double& pitch : *ColumnOf(trace, Channel::kBodyPitch)) pitch += roll;
}

struct SensorFault {
  const char* text;
  std::vector<std::string> causes;
  void (*distort)(Trace& trace);
};
const SensorFault kFaults[] = {
    {"a marker 8 mm above", {"marker_offset"}, [](Trace& t) { MoveMarker(t, 0.0, 0.008); }},
    {"a marker 8 mm ahead", {"marker_offset"}, [](Trace& t) { MoveMarker(t, 0.008, 0.0); }},
    {"the pose 4 ms late", {"pose_delay"}, [](Trace& t) { DelayPose(t, 2); }},
    {"pitch 3 % too large",
     {"sensor_scale_pitch"},
     [](Trace& t) { Scale(t, Channel::kBodyPitch, 1.03); }},
    {"x 1 % too large", {"sensor_scale_x"}, [](Trace& t) { Scale(t, Channel::kBodyX, 1.01); }},
    {"y 1 % too large", {"sensor_scale_y"}, [](Trace& t) { Scale(t, Channel::kBodyY, 1.01); }},
    {"a camera 10 mrad askew",
     {"camera_roll", "sensor_offset_pitch"},
     [](Trace& t) { Roll(t, 0.01); }},
    {"a clock 0.5 % fast",
     {"clock_scale"},
     [](Trace& t) {
       for (double& time : t.time_s) time *= 1.005;
     }},
};

struct Robot {
  const char* dataset;
  double least;  // share of the causes that are told with P >= 0.5
};
class RobotSensors : public ::testing::TestWithParam<Robot> {};

TEST_P(RobotSensors, WhatIsWrongIsNamed) {
  const Dataset sound =
      ReadDataset(std::filesystem::path(HOPLAB_SOURCE_DIR) / "datasets" / GetParam().dataset);
  long planted = 0, likely = 0, named = 0, wrong = 0;
  for (const SensorFault& fault : kFaults) {
    Dataset dataset = sound;
    for (Trial& trial : dataset.trials) fault.distort(trial.trace);
    DiagnosisOptions options;
    options.fit.jobs = static_cast<int>(std::thread::hardware_concurrency());
    const Diagnosis d = Diagnose(dataset, options);
    std::printf("%-22s %s", fault.text,
                d.refusal.empty() ? std::string(NameOf(d.verdict)).c_str() : d.refusal.c_str());
    planted += static_cast<long>(fault.causes.size());
    for (const CauseReport* c :
         d.extension ? d.extension->MainCauses() : std::vector<const CauseReport*>()) {
      const bool right = std::count(fault.causes.begin(), fault.causes.end(), c->cause.Name()) > 0;
      likely += right && c->probability >= kLikely;
      named += right && c->probability >= kSure;
      wrong += !right && c->probability >= kSure;
      std::printf("; %s P %.2f, %.0f %% of the misfit", c->cause.Name().c_str(), c->probability,
                  100.0 * d.extension->OfMisfit(c->share));
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  std::printf(
      "of %ld causes %ld are told with P >= %.1f, %ld with P >= %.2f; %ld other names with P >= "
      "%.2f\n",
      planted, likely, kLikely, named, kSure, wrong, kSure);
  EXPECT_GE(static_cast<double>(likely), GetParam().least * static_cast<double>(planted));
  EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(, RobotSensors,
                         ::testing::Values(Robot{"robot-drops", 1.0}, Robot{"robot-walk", 0.9}),
                         [](const auto& info) {
                           return std::string(info.param.dataset) == "robot-drops" ? "Drops"
                                                                                   : "Walk";
                         });

}  // namespace
}  // namespace hoplab::testing
