#pragma once

#include <vector>

#include "app/records/run_record.h"
#include "model/effects/effect.h"

namespace hoplab {

/// The laws of every mechanism, each mechanism's default first.
std::vector<Law> AllLaws();
std::vector<Law> LawsWith(const Effect& effect);

/// An effect as `hoplab effects --json` has it.
Json EffectRecord(const Effect& effect);

}  // namespace hoplab
