#include "app/records/stride_record.h"

namespace hoplab {

Json StateRecord(const std::vector<SectionComponent>& components, const SectionState& state) {
  Json record = Json::object();
  for (std::size_t i = 0; i < components.size(); ++i)
    record[components[i].name] =
        state.size() > 0 ? NumberOrNull(state[static_cast<Eigen::Index>(i)]) : Json(nullptr);
  return record;
}

double SpeedOf(const Hop& hop) { return hop.advance / hop.period; }

void AddStride(const GaitRun& run, Json& record) {
  record["own_run"] = {{"outcome", NameOf(run.own_outcome)}, {"strides", run.own_strides}};
  record["clock"] = Json::object();
  for (const ParameterId id : ClockParameters())
    record["clock"][std::string(InfoOf(id).name)] = Field(run.hopper.request.parameters, id);
  record["stride"] = nullptr;
  if (!run.stride) return;
  const StrideMeasures& stride = *run.stride;
  Json legs = Json::array();
  for (const LegUse& leg : stride.legs)
    legs.push_back({{"duty", leg.duty}, {"middle", leg.middle}});
  record["stride"] = {{"kind", NameOf(stride.kind)},
                      {"speed_m_per_s", NumberOrNull(stride.speed)},
                      {"cost_of_transport", NumberOrNull(stride.cost_of_transport)},
                      {"peak_torque_N_m", NumberOrNull(stride.peak_torque)},
                      {"flight_share", stride.flight_share},
                      {"section_phase", dynamic_cast<const StrideMap&>(*run.map).phase()},
                      {"legs", legs}};
}

}  // namespace hoplab
