#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/records/stored_run.h"
#include "model/simulate.h"

namespace hoplab {

/// A start of a recorded trial, as the fit has it.
struct ExportedStart {
  std::string trial;
  double touchdown_angle;         // rad
  std::array<double, 4> state{};  // x, y [m], vx, vy [m/s]
};

/// What a run identified, ready to be written as a law or a model of another program.
struct ExportedModel {
  std::string origin;  // "rig-drops, fit by hoplab 0.2.0"
  Law law = Law::kElastica;
  LiftoffRule liftoff = LiftoffRule::kZeroForce;
  Parameters<double> parameters;       // as stated and fitted, before effects change them
  std::vector<EffectSetting> effects;  // off their null
  std::vector<std::string> driven_by;  // columns of a log that drove it
  std::vector<ExportedStart> initial_states;

  /// The parameters as the effects leave them.
  Parameters<double> Effective() const;
  /// Value of an effect's first parameter; 0 where it does not act.
  double Of(std::string_view effect) const;
  bool Has(std::string_view effect) const;
};

/// The model of a stored run: of a diagnosis the one with the causes it found. Throws InputError
/// (place: the run.json) for a run without a model, one written before hoplab kept it whole, or one
/// that was damaged.
ExportedModel ModelOfRun(const std::filesystem::path& folder, const StoredRun& run);

/// A number as C and XML read it back exactly.
std::string ExactNumber(double value);

/// Whether a list of effects holds this one.
bool IsAmong(std::string_view name, std::span<const char* const> names);

/// "E = 22.98 GPa", for the head of a file.
std::string DescribeEffect(const EffectSetting& setting);

}  // namespace hoplab
