#pragma once

#include <string>
#include <vector>

#include "datasets/input_spec.h"
#include "datasets/mechanism_spec.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

// The blocks a robot has in a dataset or a scenario (datasets/README.md, "A robot").

/// Keys below `mechanism` of a robot, beside type, body_mass_kg and gravity_m_per_s2.
const std::vector<std::string>& RobotKeys();
/// All of them; throws InputError as ReadMechanism does.
RobotSpec ReadRobot(const YamlCursor& mechanism);

/// A `controller` with a type: {type: held, angles_rad: [0.5, 0.5]}.
MotorsSpec ReadMotors(const YamlCursor& cursor);

/// Throws InputError, at `owner`, where controller and start do not go with the mechanism: a robot
/// without motors or with a number of angles that is not that of its legs, a hopper with motors or
/// a pitch.
void CheckMotors(const YamlCursor& owner, const MechanismSpec& mechanism,
                 const std::optional<ControllerSpec>& controller,
                 const std::optional<StateSpec>& initial);

/// Throws InputError where what drives a robot does not go with its controller: an input of a motor
/// it does not have or that follows no log, a motor of `type: recorded` that nothing or two things
/// drive, one that a torque drives and that begins nowhere. `path` leads the keys in messages.
void CheckRobotInputs(const std::string& place, const std::string& path,
                      const MechanismSpec& mechanism,
                      const std::optional<ControllerSpec>& controller,
                      const std::vector<InputSpec>& inputs);

}  // namespace hoplab
