#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fitting/generate.h"

namespace hoplab::testing {

/// Every law a diagnosis is tested under.
inline constexpr std::array kAllLaws = {Law::kThesis,          Law::kNoSlip,      Law::kConsistent,
                                        Law::kLargeDeflection, Law::kStraightLeg, Law::kBall};

/// Five train and two test trials of one to three hops that move what effects act on: touch-down
/// angle, height, speed, hip torque in some trials and none in others. Complete under its law.
Scenario DiagnosisScenario(Law law);

/// Effects with their values, by name: what a test plants and a diagnosis must find.
struct PlantedEffect {
  std::string name;
  std::vector<double> values;  // own units, in the order of its parameters
  bool operator==(const PlantedEffect&) const = default;
};

/// Noise of the traces, and what the dataset states about it.
struct NoiseModel {
  enum class Kind { kWhite, kAutoregressive, kStudent, kQuantised };
  Kind kind = Kind::kWhite;  // AR(1) with 0.5; Student's t with 3 degrees; steps of one sigma
  double dropped = 0.0;      // share of samples that are missing
  double stated = 1.0;       // stated sigma over the true one
};

/// What stands behind a dataset and is kept from the diagnosis.
struct Truth {
  Law law = Law::kLargeDeflection;
  /// What the diagnosis takes it for: a law that is nearly right, as every law is of a real leg.
  std::optional<Law> told_law = {};
  std::vector<PlantedEffect> effects;  // none: the model is right
  double size = 0.0;                   // in delta80; 0 without an effect
  std::string only_recording = {};     // the one trial the effects act in; empty: all
  /// Each trial has sizes of its own: `effects` times N(0, 1), drawn from the seed; its absolute
  /// where an effect has one sign.
  bool own_sizes = false;
  /// The traces are mirrored about those without an effect: to first order the opposite sizes.
  bool mirrored = false;
  std::uint64_t seed = 1;  // of noise and initial states
  NoiseModel noise = {};
};

/// The dataset of a truth, made by another integrator than fits use. Its nominal values are off the
/// true ones. `notes` gets what GenerateDataset has to say.
Dataset MakeDataset(const Truth& truth, std::vector<std::string>* notes = nullptr);

/// The same without noise, with true initial states and true nominal values.
Dataset MakeExactDataset(Law law);

/// The value fits are after, E (k, restitution of the other mechanisms): the first free by default.
double TrueStiffness(Law law);

/// A dataset folder and, beside it, the sealed truth. A diagnosis is given `dataset()` alone.
class SealedCase {
 public:
  SealedCase(const std::filesystem::path& folder, const Truth& truth);
  std::filesystem::path dataset() const { return folder_ / "dataset"; }
  /// Breaks the seal: call it after the diagnosis.
  Truth Open() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace hoplab::testing
