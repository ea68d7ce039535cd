#include "app/records/stride_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/terminal/quantity.h"

namespace hoplab {
namespace {

// The multipliers that matter, a pair once: "0.94, 0.1 ± 0.3i and 9 smaller ones".
std::string MultiplierList(const std::vector<std::complex<double>>& multipliers) {
  constexpr std::size_t kShown = 4;
  std::string text;
  std::size_t shown = 0, i = 0;
  for (; i < multipliers.size() && shown < kShown; ++i, ++shown) {
    const std::complex<double>& m = multipliers[i];
    if (shown > 0) text += ", ";
    text += Significant(m.real(), 4);
    if (m.imag() == 0.0) continue;
    text += " ± " + Significant(std::abs(m.imag()), 4) + "i";
    ++i;
  }
  const std::size_t left = multipliers.size() - std::min(i, multipliers.size());
  return left > 0 ? text + fmt::format(" and {} smaller", left) : text;
}

}  // namespace

std::string Multiplier(const std::complex<double>& m) {
  if (m.imag() == 0.0) return Significant(m.real(), 7);
  return Significant(m.real(), 7) + (m.imag() > 0.0 ? " + " : " - ") +
         Significant(std::abs(m.imag()), 7) + "i";
}

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

std::string StrideReport(const GaitRun& run) {
  const FixedPoint& p = run.point;
  const StrideMeasures& stride = *run.stride;
  std::string duties, middles;
  for (const LegUse& leg : stride.legs) {
    duties += (duties.empty() ? "" : ", ") + Fixed(leg.duty, 2);
    middles += (middles.empty() ? "" : ", ") + Fixed(leg.middle, 2);
  }
  std::string text = fmt::format("  steady stride      {}, {} m/s, {} m in {} s\n",
                                 NameOf(stride.kind), Significant(stride.speed, 5),
                                 Significant(p.hop.advance, 5), Significant(p.hop.period, 5));
  text += fmt::format("  legs               on the ground {} of the stride, their middles at {}\n",
                      duties, middles);
  text += fmt::format("  in the air         {} of the stride\n", Fixed(stride.flight_share, 2));
  text += fmt::format("  cost of transport  {}, at most {} N m in a motor\n",
                      Significant(stride.cost_of_transport, 3), Significant(stride.peak_torque, 3));
  text += "  multipliers        " + MultiplierList(p.multipliers) + "\n";
  text += fmt::format("  spectral radius    {}, {}\n", Significant(p.spectral_radius, 6),
                      p.stable() ? "stable" : "unstable");
  if (run.own_outcome != Outcome::kCompleted)
    text += "  from its own start " + std::string(SentenceOf(run.own_outcome)) + "\n";
  return text;
}

}  // namespace hoplab
