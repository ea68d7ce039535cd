#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "datasets/dataset.h"
#include "datasets/scenario.h"
#include "model/simulate.h"

namespace hoplab {

/// The simulator's parameters of a described mechanism at a touch-down angle.
Parameters<double> ParametersOfSpec(const MechanismSpec& mechanism,
                                    const std::optional<ControllerSpec>& controller,
                                    double touchdown_angle_rad);
LegMass LegMassOfSpec(const MechanismSpec& mechanism);
Eigen::Vector4d StateOfSpec(const StateSpec& state);
StateSpec SpecOfState(const Eigen::Vector4d& state);
/// The mode a record begins in.
Mode ModeOfSpec(StartMode mode, MechanismKind type);
/// The same as a simulation begins with.
std::vector<double> InitialOf(const StateSpec& state);

/// The law named `name` (empty: the mechanism's default). Throws InputError, place `place`, for a
/// law that does not exist or belongs to another mechanism.
Law ResolveLaw(const std::string& name, MechanismKind mechanism, const std::string& place);

/// Throws InputError, place `place`, for a reading of another law than `law`.
void CheckReading(const ThesisReading& reading, Law law, const std::string& place);

/// The effect named `name`: one of `formulas`, one of the catalogue, or the formula in the file of
/// that name (IsEffectFile). Throws InputError with the nearest known name, or for a bad file.
const Effect& ResolveEffect(const std::string& name, const std::string& place,
                            std::span<const Effect* const> formulas = {});

/// The effect in a file; throws InputError with the place in it for what is not right.
const Effect& EffectOfFile(const EffectFile& file);

/// Legs of a robot; 0 of any other mechanism.
RobotLegs RobotLegsOfSpec(const MechanismSpec& mechanism);

/// Throws InputError if the effect means nothing under the law, on a leg with that mass, without
/// an input it changes, or on a robot with that many legs.
void CheckApplies(const Effect& effect, Law law, LegMass mass, const std::string& place,
                  InputSet inputs = 0, RobotLegs robot_legs = {});

/// Throws InputError, place `place`, for a value of an effect's parameter out of its bounds.
void CheckEffectValue(const Effect& effect, int parameter, double value, const std::string& name,
                      const std::string& place);

/// Effects with their values as a scenario gives them; parameters not given stay null. Throws
/// InputError for unknown names, values out of bounds, an effect that this law or leg cannot have.
std::vector<EffectSetting> ResolveEffects(const std::vector<EffectSpec>& specs, Law law,
                                          LegMass mass, InputSet inputs = 0,
                                          RobotLegs robot_legs = {});

}  // namespace hoplab
