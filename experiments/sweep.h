#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "datasets/read_scenario.h"
#include "experiments/sweep_outputs.h"

namespace hoplab {

/// A sweep's rows before they are computed: a grid (last key fastest), a list or a Latin hypercube,
/// in an order that depends on the scenario and the seed alone.
class SweepPlan {
 public:
  /// Throws InputError for a scenario without a sweep block, or an output that does not exist.
  SweepPlan(const ScenarioDocument& document, const IntegratorOptions& integrator,
            std::uint64_t seed);

  int size() const { return size_; }
  const std::string& name() const { return name_; }
  const std::vector<std::string>& keys() const { return keys_; }
  const std::vector<const SweepOutput*>& outputs() const { return outputs_; }
  Law law() const { return law_; }
  const ThesisReading& reading() const { return reading_; }
  /// Values of the keys in row `i`.
  std::vector<double> Point(int i) const;
  /// Computes row `i`; a scenario that cannot be run at that point is a row with the reason. May be
  /// called from several threads.
  SweepRow Compute(int i) const;
  /// Changes whenever a row could: a hash of the resolved scenario, the points, the outputs and the
  /// integrator.
  const std::string& fingerprint() const { return fingerprint_; }

 private:
  void Layout(const SweepSpec& spec, std::uint64_t seed);
  void Fingerprint(const IntegratorOptions& integrator);

  ScenarioDocument document_;
  IntegratorOptions integrator_;
  std::string name_;
  Law law_ = Law::kElastica;
  ThesisReading reading_;
  std::vector<std::string> keys_;
  std::vector<std::vector<double>> columns_;  // grid: values per key; else: one value per row
  bool grid_ = false;
  int size_ = 0;
  std::vector<const SweepOutput*> outputs_;
  std::string fingerprint_;
};

}  // namespace hoplab
