// The exported C file, compiled as it is written, beside the library: forces, contacts and what
// comes next, for every law over a grid of states.
#include <gtest/gtest.h>

#include "app/export/c_law.h"
#include "base/input_error.h"
#include "tests/app/exported_leg.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;

ExportedModel ModelOf(Law law) {
  ExportedModel model;
  model.origin = "a test";
  model.law = law;
  model.parameters =
      law == Law::kStraightLeg ? SteadyStraightLeg().parameters : ThickLegRequest(law).parameters;
  model.parameters.d = 3.0;
  model.parameters.kp = 0.7;
  model.parameters.v_des = 1.1;
  model.parameters.torque_limit = 0.8;
  return model;
}

EffectSetting Typical(const char* name) {
  const Effect* effect = FindEffect(name);
  EffectSetting setting = EffectSetting::Null(*effect);
  for (std::size_t i = 0; i < effect->info.parameters.size(); ++i)
    setting.values[i] = effect->info.parameters[i].typical;
  return setting;
}

const std::vector<Law> kLaws = {Law::kThesis,          Law::kNoSlip,   Law::kConsistent,
                                Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg};

TEST(ExportC, EveryLawIsTheLibrarysOverAGridOfStates) {
  for (const Law law : kLaws) {
    const double worst = ExportedLeg(ModelOf(law)).Compare();
    std::printf("  %-16s worst difference %.1e\n", std::string(NameOf(law)).c_str(), worst);
  }
}

TEST(ExportC, TheRateOfTheLegAngleIsThatOfTheAngle) {
  for (const Law law : kLaws) {
    const double worst = ExportedLeg(ModelOf(law)).CompareRates();
    std::printf("  %-16s worst difference %.1e\n", std::string(NameOf(law)).c_str(), worst);
  }
}

TEST(ExportC, EveryReadingOfThePublishedLawIsTheLibrarys) {
  for (const ReadingKey& key : ReadingKeys()) {
    ExportedModel model = ModelOf(Law::kThesis);
    key.set(model.parameters.reading, static_cast<int>(key.words.size()) - 1);
    ExportedLeg(model).Compare();
  }
}

TEST(ExportC, EveryLawWithTheEffectsOfTheLegIsTheLibrarys) {
  for (const Law law : kLaws) {
    ExportedModel model = ModelOf(law);
    for (const char* name :
         {"rest_radius_scale", "leg_hardening", "second_order_bending", "leg_material_damping",
          "leg_hysteresis", "leg_quadratic_damping", "foot_coulomb_friction",
          "hip_viscous_friction", "hip_coulomb_friction", "torque_gain", "torque_bias",
          "touchdown_angle_bias", "touchdown_angle_speed", "touchdown_loss"}) {
      // Which the elastica and M2b have of themselves.
      const bool has_it = law == Law::kElastica || law == Law::kLargeDeflection;
      if (has_it && std::string(name) == "second_order_bending") continue;
      // Under which friction at the hip bends the leg (M94), and is refused.
      if (law == Law::kElastica && std::string(name).starts_with("hip_")) continue;
      const EffectSetting setting = Typical(name);
      if (AppliesTo(*setting.effect, law)) model.effects.push_back(setting);
    }
    EXPECT_GE(model.effects.size(), law == Law::kElastica ? 11u : 12u);
    const double worst = ExportedLeg(model).Compare();
    std::printf("  %-16s with %zu effects: worst difference %.1e\n",
                std::string(NameOf(law)).c_str(), model.effects.size(), worst);
  }
}

TEST(ExportC, AnotherRuleOfLiftoffIsTheLibrarys) {
  for (const Law law : kLaws) {
    ExportedModel model = ModelOf(law);
    model.liftoff = LiftoffRule::kRestLength;
    ExportedLeg(model).Compare();
  }
}

TEST(ExportC, ItsHeadTellsWhatATorqueDoesToAnElastica) {
  const auto head_of = [](Law law) {
    const std::string text = CSourceOf(ModelOf(law), "run.json");
    return text.substr(0, text.find("#include"));
  };
  const std::string line = "what a torque of the hip does to the arc";
  EXPECT_NE(head_of(Law::kElastica).find(line), std::string::npos);
  EXPECT_EQ(head_of(Law::kLargeDeflection).find(line), std::string::npos);
}

TEST(ExportC, WhatTheFileDoesNotKnowIsRefusedOrTold) {
  for (const Effect* effect : AllEffects()) {
    const std::string name(effect->info.name);
    if (!AppliesTo(*effect, Law::kElastica)) continue;
    ExportedModel model = ModelOf(Law::kElastica);
    model.effects = {Typical(name.c_str())};
    try {
      const std::string text = CSourceOf(model, "run.json");
      const std::string head = text.substr(0, text.find("#include"));
      EXPECT_NE(head.find(name), std::string::npos) << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.parts().place, "run.json: effects");
      EXPECT_NE(error.parts().value.find(name), std::string::npos);
      EXPECT_NE(error.parts().remedy, "");
    }
  }
}

}  // namespace
}  // namespace hoplab
