#pragma once

#include "optimize/return_map.h"

namespace hoplab {

/// State of a hopper at an apex: (vx [m/s], y [m]). vy is 0 there, and x does not matter on level
/// ground.
using ApexState = Eigen::Vector2d;

/// The apex-to-apex map of a legged hopper. Of a run that ends at the apex, the derivative along
/// the section is S + f dt_e/dp.
class ApexMap final : public ReturnMap {
 public:
  explicit ApexMap(Hopper hopper);
  std::unique_ptr<ReturnMap> Clone() const override;

  Hop Differentiate(const SectionState& start,
                    std::span<const SensitivityDirection> parameters = {}) override;
  Hop Apply(const SectionState& start) override;
  std::vector<SectionComponent> Components(const SectionState& at) const override;

  double SpecificEnergy(const SectionState& state) const override;
  Eigen::RowVectorXd SpecificEnergyRate(const SectionState& state) const override;
  bool ConservesEnergy(const SectionState& state) override;

 private:
  SimulationRequest RequestFrom(const SectionState& start) const;
  Hop Read(std::size_t parameters) const;

  Trajectory run_;
};

}  // namespace hoplab
