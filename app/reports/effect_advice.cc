#include "app/reports/effect_advice.h"

#include <algorithm>
#include <array>

namespace hoplab {
namespace {

constexpr std::array kAdvice = {
    EffectAdvice{"air_drag",
                 "Drop the body without its leg, or hop at two speeds: drag grows with the square "
                 "of the speed, a steady pull does not.",
                 "constant_force"},
    EffectAdvice{"angle_input_delay",
                 "Mark one instant in both logs, a tap on the leg, and compare their stamps.", ""},
    EffectAdvice{"angle_input_scale", "Turn the leg by a known angle and read what the log says.",
                 ""},
    EffectAdvice{"body_mass_scale",
                 "Weigh the robot as it hops, battery and cables on it, and state that mass.",
                 "torque_gain"},
    EffectAdvice{"boom_inertia",
                 "Compute the boom's or carriage's inertia as seen at the hip, or swing the boom "
                 "alone; free flight falls slower than g where it counts upward.",
                 "clock_scale, gravity_scale, torque_lag"},
    EffectAdvice{"camera_roll",
                 "Film a plumb line: the turn of the picture against it is the roll. A slope of "
                 "the ground moves the data the same way.",
                 "ground_slope"},
    EffectAdvice{"clock_scale",
                 "Record a second clock, or a free fall: its g tells the true second.",
                 "boom_inertia, gravity_scale, sensor_scale_y"},
    EffectAdvice{"com_offset",
                 "Balance the robot on an edge across its body: the centre of mass lies above it.",
                 ""},
    EffectAdvice{"constant_force",
                 "Hop both ways: a draught or a cable pulls the same way in both.", "air_drag"},
    EffectAdvice{"foot_coulomb_friction",
                 "Pull the loaded foot sideways with a spring balance; film the foot as it lands, "
                 "where it slides some millimetres, or glue sandpaper under the sole.",
                 ""},
    EffectAdvice{"foot_slip",
                 "Film the contact from near by, or chalk it; another sole or a rougher floor "
                 "changes it.",
                 ""},
    EffectAdvice{"force_input_delay",
                 "Strike the force sensor and compare the moment with the camera's.", ""},
    EffectAdvice{"force_input_scale", "Hang a known weight on the force sensor.", ""},
    EffectAdvice{"gravity_scale",
                 "Let it fall: a counterweight or an inclined plane shows in free flight, before "
                 "any contact.",
                 "boom_inertia, clock_scale"},
    EffectAdvice{"ground_compliance",
                 "Load the floor statically and measure how far it sinks, or hop on concrete.",
                 "touchdown_angle_bias, sensor_offset_y, sensor_scale_y, rest_radius_scale"},
    EffectAdvice{"ground_slope",
                 "Put a level on the track, or hop back: a slope changes sign, a camera's roll "
                 "does not.",
                 "camera_roll"},
    EffectAdvice{"guide_coulomb_friction",
                 "Slide the carriage by hand with a spring balance; it sticks at rest.", ""},
    EffectAdvice{"guide_viscous_friction",
                 "Let the carriage fall with the leg off the ground: its speed approaches a limit.",
                 ""},
    EffectAdvice{"higher_order_bending",
                 "Use the law elastica, which has it: the leg bends further than second order is "
                 "good for.",
                 ""},
    EffectAdvice{"hip_coulomb_friction",
                 "Turn the joint slowly without power and read the torque at which it gives.",
                 "torque_bias, hip_viscous_friction"},
    EffectAdvice{"hip_viscous_friction",
                 "Turn the joint at several speeds without power: the torque grows with the speed.",
                 "leg_mass, touchdown_angle_bias, torque_bias, hip_coulomb_friction"},
    EffectAdvice{"leg_damping_1", "Pluck each leg: this one dies out in fewer periods.", ""},
    EffectAdvice{"leg_damping_2", "Pluck each leg: this one dies out in fewer periods.", ""},
    EffectAdvice{"leg_damping_3", "Pluck each leg: this one dies out in fewer periods.", ""},
    EffectAdvice{"leg_damping_4", "Pluck each leg: this one dies out in fewer periods.", ""},
    EffectAdvice{"leg_hardening",
                 "Press the leg slowly in a testing machine: the force over the deflection curves.",
                 ""},
    EffectAdvice{"leg_hysteresis",
                 "Load and unload the leg slowly: the loop stays open however slow you are.",
                 "leg_material_damping"},
    EffectAdvice{"leg_mass",
                 "Weigh the leg alone. With it, hold the loss at touch-down "
                 "(--fix touchdown_loss.zeta=0): it is the same blow.",
                 "hip_viscous_friction, touchdown_angle_bias"},
    EffectAdvice{"leg_material_damping",
                 "Load and unload the leg at several speeds: the loop closes when slow. With it, "
                 "hold the constant damper (--fix d=0).",
                 "leg_hysteresis"},
    EffectAdvice{"leg_quadratic_damping",
                 "Pluck the leg at two amplitudes: the larger one dies out in fewer periods.", ""},
    EffectAdvice{"leg_stiffness_1",
                 "Press each leg on a balance by the same way and read its load; look at this leg "
                 "and its clamp for a crack.",
                 ""},
    EffectAdvice{"leg_stiffness_2",
                 "Press each leg on a balance by the same way and read its load; look at this leg "
                 "and its clamp for a crack.",
                 ""},
    EffectAdvice{"leg_stiffness_3",
                 "Press each leg on a balance by the same way and read its load; look at this leg "
                 "and its clamp for a crack.",
                 ""},
    EffectAdvice{"leg_stiffness_4",
                 "Press each leg on a balance by the same way and read its load; look at this leg "
                 "and its clamp for a crack.",
                 ""},
    EffectAdvice{"magnus_lift",
                 "Mark the ball and film its spin; thrown without spin it flies a parabola.", ""},
    EffectAdvice{
        "motor_gain",
        "Hang a known weight on a lever at a motor and read the torque it is told to give.", ""},
    EffectAdvice{
        "motor_gain_1",
        "Hang a known weight on a lever at this motor and read the torque it is told to give.", ""},
    EffectAdvice{
        "motor_gain_2",
        "Hang a known weight on a lever at this motor and read the torque it is told to give.", ""},
    EffectAdvice{
        "motor_gain_3",
        "Hang a known weight on a lever at this motor and read the torque it is told to give.", ""},
    EffectAdvice{
        "motor_gain_4",
        "Hang a known weight on a lever at this motor and read the torque it is told to give.", ""},
    EffectAdvice{"motor_lag",
                 "Block a motor, step the torque it is told and read its current: how long does it "
                 "take to follow?",
                 ""},
    EffectAdvice{"pitch_inertia_scale", "Hang the robot by a hip, let it swing and time it.", ""},
    EffectAdvice{"rest_length_step",
                 "If the robot pushes, this is its work; if it does not, look for a spring that "
                 "latches or slips.",
                 ""},
    EffectAdvice{"rest_radius_scale",
                 "Measure the unloaded leg from the hip's axis to the outside of its sole.",
                 "sensor_offset_y, touchdown_angle_bias, sensor_scale_y, ground_compliance"},
    EffectAdvice{"restitution_speed",
                 "Drop the ball from several heights and plot the share it rebounds to.", ""},
    EffectAdvice{"rolling_law",
                 "Take another law (hoplab compare): this says that the contact advances as under "
                 "that one.",
                 ""},
    EffectAdvice{
        "second_order_bending",
        "Use the law elastica or large_deflection, which have it: the leg bends further than first "
        "order is good for.",
        ""},
    EffectAdvice{"sensor_delay",
                 "Strike the marker and compare the moment with a contact switch, or free the "
                 "start states less.",
                 ""},
    EffectAdvice{"sensor_offset_x",
                 "Measure where the marker sits against the hip, and where the track begins.", ""},
    EffectAdvice{"sensor_offset_y", "Stand the robot on the ground unloaded and read its height.",
                 "rest_radius_scale, sensor_scale_y, touchdown_angle_bias, ground_compliance"},
    EffectAdvice{"sensor_scale_x", "Move the marker by a known length along the track.", ""},
    EffectAdvice{"sensor_scale_y", "Move the marker by a known height.",
                 "sensor_offset_y, rest_radius_scale, touchdown_angle_bias, clock_scale, "
                 "ground_compliance"},
    EffectAdvice{"stiffness_drift",
                 "Repeat the first trial at the end of the day, or measure the leg's temperature.",
                 ""},
    EffectAdvice{"swinging_leg_mass", "Weigh a leg, from its clamp to its toe.", ""},
    EffectAdvice{"tip_rotation",
                 "Use the law elastica, large_deflection or consistent, which have it.", ""},
    EffectAdvice{"torque_bending",
                 "Hold the foot and turn the hip: a leg that bends under torque alone has it.", ""},
    EffectAdvice{"torque_bias", "Command no torque and measure what the joint holds.",
                 "hip_coulomb_friction, hip_viscous_friction"},
    EffectAdvice{"torque_gain",
                 "Hang a known weight on an arm at the joint and read the torque that holds it.",
                 "body_mass_scale"},
    EffectAdvice{"torque_input_delay",
                 "Hold the joint, step the command, and compare the stamps of both logs.", ""},
    EffectAdvice{"torque_lag",
                 "Step the command with the joint held and record the current or the torque.",
                 "boom_inertia"},
    EffectAdvice{"touchdown_angle_bias",
                 "Hold the leg against a protractor at the commanded angle.",
                 "sensor_offset_y, rest_radius_scale, ground_compliance, sensor_scale_y, "
                 "hip_viscous_friction, leg_mass"},
    EffectAdvice{"touchdown_angle_speed",
                 "Log the leg's angle in flight: placement by speed is a rule of the controller, "
                 "or air drag on the leg.",
                 ""},
    EffectAdvice{"touchdown_loss",
                 "Weigh the leg: the share lost is about its mass over the body's. Or give the "
                 "model a toe mass (--free m_toe).",
                 ""},
};

}  // namespace

const EffectAdvice* AdviceOn(std::string_view effect) {
  const auto* const found =
      std::find_if(kAdvice.begin(), kAdvice.end(),
                   [effect](const EffectAdvice& advice) { return advice.effect == effect; });
  return found == kAdvice.end() ? nullptr : &*found;
}

std::span<const EffectAdvice> AllAdvice() { return kAdvice; }

}  // namespace hoplab
