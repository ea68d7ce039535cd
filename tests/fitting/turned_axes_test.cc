// Records of another engine's robot and rig, written with one sign or order turned.

#include "fitting/turned_axes.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/units.h"
#include "datasets/read_dataset.h"
#include "fitting/problem.h"

namespace hoplab {
namespace {

Dataset Shipped(const std::string& name) {
  return ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name);
}
std::vector<std::string> SaidOf(const Dataset& dataset) {
  return TurnedAxes(MakeProblem(dataset, {}));
}
std::vector<std::string> SaidOfRobotWith(const std::function<void(Trial&)>& turn) {
  Dataset robot = Shipped("robot-drops");
  for (Trial& trial : robot.trials) turn(trial);
  return SaidOf(robot);
}
void Negate(Trial& trial, const std::string& name) {
  for (TraceColumn& column : trial.trace.columns)
    if (column.name == name)
      for (double& value : column.values) value = -value;
}
void ExpectSaid(const std::vector<std::string>& said, const std::string& what) {
  ASSERT_EQ(said.size(), 1U) << what;
  EXPECT_NE(said[0].find("with " + what + "; "), std::string::npos) << said[0];
}

TEST(TurnedAxes, NothingIsSaidOfRecordsThatAreRight) {
  for (const char* name : {"robot-drops", "robot-pronk", "robot-walk", "rig-drops",
                           "rig-controlled", "rig-drops-undamped"})
    EXPECT_TRUE(SaidOf(Shipped(name)).empty()) << name;
}

TEST(TurnedAxes, NothingIsSaidOfAWrongModulus) {
  for (const double factor : {0.5, 2.0}) {
    Dataset robot = Shipped("robot-drops");
    for (Trial& trial : robot.trials) trial.mechanism.robot.E_Pa *= factor;
    EXPECT_TRUE(SaidOf(robot).empty()) << factor;
    Dataset rig = Shipped("rig-drops");
    for (Trial& trial : rig.trials) trial.mechanism.c_leg.E_Pa *= factor;
    EXPECT_TRUE(SaidOf(rig).empty()) << factor;
  }
}

// A pitch of 0.12 rad that the simulation does not have: in degrees it would hardly be one.
TEST(TurnedAxes, NothingIsSaidOfAPitchThatIsNotSimulated) {
  Dataset robot = Shipped("robot-drops");
  for (Trial& trial : robot.trials) {
    trial.initial->pitch_rad = trial.initial->pitch_rate_rad_per_s = 0.0;
    std::vector<double>& times = trial.trace.time_s;
    times.resize(31);  // of flight
    const StateSpec& start = *trial.initial;
    for (TraceColumn& column : trial.trace.columns) {
      column.values.resize(times.size());
      for (std::size_t i = 0; i < times.size(); ++i) {
        const double t = times[i];
        if (column.name == "body_pitch_rad") column.values[i] = 2.0 * t;
        if (column.name == "body_x_m") column.values[i] = start.x_m + start.vx_m_per_s * t;
        if (column.name == "body_y_m")
          column.values[i] = start.y_m + start.vy_m_per_s * t - 0.5 * 9.81 * t * t;
      }
    }
  }
  EXPECT_TRUE(SaidOf(robot).empty()) << SaidOf(robot)[0];
}

TEST(TurnedAxes, ARobotsPitchIsSeen) {
  ExpectSaid(SaidOfRobotWith([](Trial& trial) {
               Negate(trial, "body_pitch_rad");
               trial.initial->pitch_rad = -*trial.initial->pitch_rad;
               trial.initial->pitch_rate_rad_per_s = -*trial.initial->pitch_rate_rad_per_s;
             }),
             "the sign of the pitch turned");
}

TEST(TurnedAxes, ARobotsWayIsSeen) {
  ExpectSaid(SaidOfRobotWith([](Trial& trial) {
               Negate(trial, "body_x_m");
               trial.initial->x_m = -trial.initial->x_m;
               trial.initial->vx_m_per_s = -trial.initial->vx_m_per_s;
             }),
             "the sign of x turned");
}

TEST(TurnedAxes, TheOrderOfItsLegsIsSeen) {
  ExpectSaid(SaidOfRobotWith([](Trial& trial) {
               std::swap(trial.controller->motors->angles_rad[0],
                         trial.controller->motors->angles_rad[1]);
               std::swap(trial.trace.columns[3].name, trial.trace.columns[4].name);
             }),
             "the order of the legs turned");
}

TEST(TurnedAxes, TheSignsOfItsLegsAnglesAreSeen) {
  ExpectSaid(SaidOfRobotWith([](Trial& trial) {
               for (double& angle : trial.controller->motors->angles_rad) angle = -angle;
               Negate(trial, "leg_angle_1_rad");
               Negate(trial, "leg_angle_2_rad");
             }),
             "the signs of the legs' angles turned");
}

// Columns that are written otherwise than what is stated beside them.
struct Column {
  const char* said;
  std::function<void(Trial&)> turn;
};

TEST(TurnedAxes, ARobotsColumnsAreSeen) {
  const auto scale = [](const char* name, double factor) {
    return [=](Trial& trial) {
      for (TraceColumn& column : trial.trace.columns)
        if (column.name.starts_with(name))
          for (double& value : column.values) value *= factor;
    };
  };
  const auto both = [&](Trial& trial) {
    scale("body_pitch", RadToDeg(1.0))(trial);
    *trial.initial->pitch_rad *= RadToDeg(1.0);
    *trial.initial->pitch_rate_rad_per_s *= RadToDeg(1.0);
  };
  const Column columns[] = {
      {"the sign of x turned, but not that of its start", scale("body_x", -1.0)},
      {"the sign of the pitch turned, but not that of its start", scale("body_pitch", -1.0)},
      {"the pitch and its start taken for degrees", both},
      {"the pitch taken for degrees, but not its start", scale("body_pitch", RadToDeg(1.0))},
      {"the columns of the legs' angles exchanged",
       [](Trial& trial) { std::swap(trial.trace.columns[3].name, trial.trace.columns[4].name); }},
      {"the signs of the columns of the legs' angles turned", scale("leg_angle", -1.0)},
      {"the columns of the legs' angles taken for degrees", scale("leg_angle", RadToDeg(1.0))}};
  for (const Column& column : columns) ExpectSaid(SaidOfRobotWith(column.turn), column.said);
}

TEST(TurnedAxes, AHoppersWayIsSeen) {
  Dataset rig = Shipped("rig-drops");
  for (Trial& trial : rig.trials) {
    Negate(trial, "body_x_m");
    trial.initial->x_m = -trial.initial->x_m;
    trial.initial->vx_m_per_s = -trial.initial->vx_m_per_s;
  }
  ExpectSaid(SaidOf(rig), "the sign of x turned");
}

}  // namespace
}  // namespace hoplab
