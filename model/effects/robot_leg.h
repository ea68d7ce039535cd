#pragma once

#include <array>
#include <string_view>

#include "model/effects/effect.h"

namespace hoplab::effect_detail {

// What may be amiss with one leg of a robot alone, or with its motor. `leg` counts from the
// hindmost, 1. Against one modulus (damping) that all legs share, one leg that is stiffer (less
// damped) is the others being softer (more damped), so these point one way.

inline constexpr std::array<std::string_view, kMaxLegs + 1> kSoftLeg = {
    "", "leg 1 (the hindmost) is softer than the others: a crack, a loose clamp, another batch",
    "leg 2 is softer than the others: a crack, a loose clamp, another batch",
    "leg 3 is softer than the others: a crack, a loose clamp, another batch",
    "leg 4 is softer than the others: a crack, a loose clamp, another batch"};
inline constexpr std::array<std::string_view, kMaxLegs + 1> kDampedLeg = {
    "", "the material of leg 1 (the hindmost) is more viscous than that of the others",
    "the material of leg 2 is more viscous than that of the others",
    "the material of leg 3 is more viscous than that of the others",
    "the material of leg 4 is more viscous than that of the others"};
inline constexpr std::array<std::string_view, kMaxLegs + 1> kWeakMotor = {
    "", "the motor of leg 1 (the hindmost) is weaker or stronger than its controller thinks",
    "the motor of leg 2 is weaker or stronger than its controller thinks",
    "the motor of leg 3 is weaker or stronger than its controller thinks",
    "the motor of leg 4 is weaker or stronger than its controller thinks"};

inline constexpr std::array<std::string_view, kMaxLegs + 1> kBiasedMotor = {
    "", "a torque that nobody asked for turns leg 1 (the hindmost): an amplifier offset, a cable",
    "a torque that nobody asked for turns leg 2: an amplifier offset, a cable",
    "a torque that nobody asked for turns leg 3: an amplifier offset, a cable",
    "a torque that nobody asked for turns leg 4: an amplifier offset, a cable"};

inline constexpr std::array<std::string_view, kMaxLegs + 1> kStiffBearing = {
    "", "the hip of leg 1 (the hindmost) resists turning in proportion to its speed",
    "the hip of leg 2 resists turning in proportion to its speed",
    "the hip of leg 3 resists turning in proportion to its speed",
    "the hip of leg 4 resists turning in proportion to its speed"};
inline constexpr std::array<std::string_view, kMaxLegs + 1> kRubbingBearing = {
    "", "the hip of leg 1 (the hindmost) rubs with a torque that only asks which way it turns",
    "the hip of leg 2 rubs with a torque that only asks which way it turns",
    "the hip of leg 3 rubs with a torque that only asks which way it turns",
    "the hip of leg 4 rubs with a torque that only asks which way it turns"};

inline constexpr std::array<std::string_view, kMaxLegs + 1> kLegAskew = {
    "the legs sit on their motors at another angle than the encoders read",
    "leg 1 (the hindmost) sits on its motor at another angle than the encoder reads",
    "leg 2 sits on its motor at another angle than the encoder reads",
    "leg 3 sits on its motor at another angle than the encoder reads",
    "leg 4 sits on its motor at another angle than the encoder reads"};

inline constexpr std::array<std::string_view, kMaxLegs + 1> kGearWithPlay = {
    "the gears of the robot's motors have play: no torque passes while their teeth are apart",
    "the gear of the motor of leg 1 (the hindmost) has play: no torque passes while its teeth are "
    "apart",
    "the gear of the motor of leg 2 has play: no torque passes while its teeth are apart",
    "the gear of the motor of leg 3 has play: no torque passes while its teeth are apart",
    "the gear of the motor of leg 4 has play: no torque passes while its teeth are apart"};

inline constexpr std::array<std::string_view, kMaxLegs + 1> kClockAhead = {
    "the clock of the robot's legs is ahead of what is stated, or behind it",
    "the clock of leg 1 (the hindmost) is ahead of what is stated, or behind it",
    "the clock of leg 2 is ahead of what is stated, or behind it",
    "the clock of leg 3 is ahead of what is stated, or behind it",
    "the clock of leg 4 is ahead of what is stated, or behind it"};

constexpr EffectInfo InfoOfLeg(int leg, std::string_view name, std::string_view equation,
                               std::string_view sentence,
                               std::span<const EffectParameter> parameters) {
  return {.name = name,
          .kind = EffectKind::kParameter,
          .equation = equation,
          .sentence = sentence,
          .for_legs = false,
          .for_ball = false,
          .dissipative = false,
          .parameters = parameters,
          .for_robot = true,
          .robot_leg = leg};
}

constexpr EffectInfo Dissipative(EffectInfo info) {
  info.dissipative = true;
  return info;
}
constexpr EffectInfo Sharp(EffectInfo info) {
  info.sharp = true;
  return info;
}
constexpr EffectInfo OfClock(EffectInfo info) {
  info.about = MachinePart::kClock;
  return info;
}
constexpr EffectInfo Scales(InputKind input, EffectInfo info) {
  info.scales = BitOf(input);
  return info;
}

template <int leg>
struct LegStiffness {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "", "leg_stiffness_1", "leg_stiffness_2", "leg_stiffness_3", "leg_stiffness_4"};
  static constexpr std::array kParameters = {EffectParameter{"loss", "-", 0.0, 0.0, 0.95, 0.1}};
  static constexpr EffectInfo kInfo =
      InfoOfLeg(leg, kNames[leg], "E (1 - loss) of that leg (M78)", kSoftLeg[leg], kParameters);

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->E_scale[leg - 1] *= 1.0 - p[0];
  }
};

template <int leg>
struct LegDamping {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "", "leg_damping_1", "leg_damping_2", "leg_damping_3", "leg_damping_4"};
  static constexpr std::array kParameters = {EffectParameter{"tau", "s", 0.0, 0.0, 0.1, 2e-4}};
  static constexpr EffectInfo kInfo = InfoOfLeg(
      leg, kNames[leg], "leg_damping + tau of that leg (M78)", kDampedLeg[leg], kParameters);

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->extra_damping[leg - 1] += p[0];
  }
};

template <int leg>
struct MotorGainOf {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "", "motor_gain_1", "motor_gain_2", "motor_gain_3", "motor_gain_4"};
  static constexpr std::array kParameters = {EffectParameter{"gamma", "-", 0.0, -0.9, 2.0, 0.05}};
  static constexpr EffectInfo kInfo = Scales(
      OfMotor(InputKind::kHipTorque1, leg - 1),
      InfoOfLeg(leg, kNames[leg], "that motor gives (1 + gamma) of the torque it is told (M75)",
                kWeakMotor[leg], kParameters));

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->gain_of[leg - 1] *= 1.0 + p[0];
  }
};

template <int leg>
struct TorqueBiasOf {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "", "torque_bias_1", "torque_bias_2", "torque_bias_3", "torque_bias_4"};
  static constexpr std::array kParameters = {
      EffectParameter{"tau_0", "N m", 0.0, -1000.0, 1000.0, 0.02}};
  static constexpr EffectInfo kInfo = InfoOfLeg(
      leg, kNames[leg], "tau_0 on that motor, always (M101)", kBiasedMotor[leg], kParameters);

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->torque_bias[leg - 1] += p[0];
  }
};

/// Of a leg; of all of them where `leg` is 0.
template <int leg>
struct LegZeroOffset {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "leg_zero_offset", "leg_zero_offset_1", "leg_zero_offset_2", "leg_zero_offset_3",
      "leg_zero_offset_4"};
  static constexpr std::array kParameters = {
      EffectParameter{"offset", "rad", 0.0, -0.5, 0.5, 0.02}};
  static constexpr EffectInfo kInfo =
      InfoOfLeg(leg, kNames[leg], "the leg's angle is the encoder's + offset (M100)",
                kLegAskew[leg], kParameters);

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    for (int i = 0; i < kMaxLegs; ++i)
      if (leg == 0 || i == leg - 1) parameters.robot->leg_zero[static_cast<std::size_t>(i)] += p[0];
  }
};

/// Of a leg; of all of them where `leg` is 0.
template <int leg>
struct GaitPhaseShift {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "gait_phase_shift", "gait_phase_shift_1", "gait_phase_shift_2", "gait_phase_shift_3",
      "gait_phase_shift_4"};
  static constexpr std::array kParameters = {EffectParameter{"shift", "-", 0.0, -0.5, 0.5, 0.02}};
  static constexpr EffectInfo kInfo = OfClock(
      InfoOfLeg(leg, kNames[leg], "the leg's phase + shift, as a share of a turn, in M76 (M110)",
                kClockAhead[leg], kParameters));

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    for (int i = 0; i < kMaxLegs; ++i)
      if (leg == 0 || i == leg - 1) parameters.robot->phase[static_cast<std::size_t>(i)] += p[0];
  }
};

template <int leg>
struct HipViscousFrictionOf {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "", "hip_viscous_friction_1", "hip_viscous_friction_2", "hip_viscous_friction_3",
      "hip_viscous_friction_4"};
  static constexpr std::array kParameters = {
      EffectParameter{"b_h", "N m s/rad", 0.0, 0.0, 100.0, 0.005}};
  static constexpr EffectInfo kInfo =
      Dissipative(InfoOfLeg(leg, kNames[leg], "-b_h dpsi/dt on the hub of that leg (M99)",
                            kStiffBearing[leg], kParameters));

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->hip_viscous[leg - 1] += p[0];
  }
};

template <int leg>
struct HipCoulombFrictionOf {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "", "hip_coulomb_friction_1", "hip_coulomb_friction_2", "hip_coulomb_friction_3",
      "hip_coulomb_friction_4"};
  static constexpr std::array kParameters = {
      EffectParameter{"tau_c", "N m", 0.0, 0.0, 1000.0, 0.03}};
  static constexpr EffectInfo kInfo = Dissipative(Sharp(InfoOfLeg(
      leg, kNames[leg], "-tau_c sign(dpsi/dt) on the hub of that leg, which is held at rest (M99)",
      kRubbingBearing[leg], kParameters)));

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    parameters.robot->hip_coulomb[leg - 1] += p[0];
  }
};

/// Of the motor of a leg; of all of them where `leg` is 0.
template <int leg>
struct Backlash {
  static constexpr std::array<std::string_view, kMaxLegs + 1> kNames = {
      "backlash", "backlash_1", "backlash_2", "backlash_3", "backlash_4"};
  static constexpr std::array kParameters = {
      EffectParameter{"play", "rad", 0.0, 0.0, 0.5, 0.02},
      EffectParameter{"tooth_torque", "N m", 20.0, 0.1, 1e5, 10.0, /*is_shape=*/true},
      EffectParameter{"tooth_damping", "s/rad", 0.2, 0.0, 10.0, 0.1, /*is_shape=*/true},
      EffectParameter{"hub_share", "-", 0.1, 0.001, 0.9, 0.1, /*is_shape=*/true}};
  static constexpr EffectInfo kInfo = {
      .name = kNames[leg],
      .kind = EffectKind::kParameter,
      .equation =
          "no torque passes while |twist| < play/2; beyond, 2 tooth_torque/play of it (M96)",
      .sentence = kGearWithPlay[leg],
      .for_legs = false,
      .for_ball = false,
      .dissipative = true,
      .has_threshold = true,
      .slow = true,
      .parameters = kParameters,
      .for_robot = true,
      .robot_leg = leg};

  template <class T>
  static void ChangeParameters(const T* p, Parameters<T>& parameters) {
    RobotParameters<T>& robot = *parameters.robot;
    for (int i = 0; i < kMaxLegs; ++i) {
      if (leg != 0 && i != leg - 1) continue;
      const auto motor = static_cast<std::size_t>(i);
      robot.play[motor] += p[0];
      robot.tooth_torque[motor] = p[1];
      robot.tooth_damping[motor] = p[2];
      robot.hub_share[motor] = p[3];
    }
  }
};

}  // namespace hoplab::effect_detail
