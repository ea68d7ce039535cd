#pragma once

#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "model/effects/effect.h"

namespace hoplab {

/// The laws of every mechanism, each mechanism's default first.
std::vector<Law> AllLaws();
std::vector<Law> LawsWith(const Effect& effect);

/// An effect as `hoplab effects --json` has it.
Json EffectRecord(const Effect& effect);

/// The effect of this name or file, or, where `name` is empty, all that go with a law (empty: with
/// any). Throws InputError for a name or law that is none.
std::vector<const Effect*> ChosenEffects(const std::string& name, const std::string& law);

/// What `hoplab effects --json` prints of them.
Json EffectsRecord(const std::vector<const Effect*>& effects, const std::string& law);

}  // namespace hoplab
