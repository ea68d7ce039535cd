#include "app/reports/gait_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"

namespace hoplab {
namespace {

std::string EndText(BranchEnd end, Outcome outcome) {
  switch (end) {
    case BranchEnd::kRange:
      return "the end of the range";
    case BranchEnd::kHopFails:
      return IsComplete(outcome) ? "where no whole hop or stride is made any more"
                                 : "where the hop fails: it " + std::string(SentenceOf(outcome));
    case BranchEnd::kNotConverged:
      return "where no fixed point is found any more";
    case BranchEnd::kLost:
      return "where the branch is lost: the fixed point found next is another branch's";
    case BranchEnd::kPointLimit:
      return "the limit of points";
    case BranchEnd::kStopped:
      return "the interruption";
  }
  return "";
}

std::string BranchReport(const GaitRun& run) {
  const Branch& branch = run.branch;
  if (!run.along || branch.points.empty()) return "";
  const std::string& name = run.along->name;
  std::string text =
      fmt::format("\n  along {}, {} points from {} ({}) to {} ({})\n", name, branch.points.size(),
                  Significant(branch.points.front().parameter, 4),
                  EndText(branch.first_end, branch.first_outcome),
                  Significant(branch.points.back().parameter, 4),
                  EndText(branch.last_end, branch.last_outcome));
  // A branch that turns back goes beyond its ends.
  const auto [least, most] = std::minmax_element(
      branch.points.begin(), branch.points.end(),
      [](const BranchPoint& a, const BranchPoint& b) { return a.parameter < b.parameter; });
  const auto [lower, upper] =
      std::minmax(branch.points.front().parameter, branch.points.back().parameter);
  if (least->parameter < lower || most->parameter > upper)
    text += fmt::format("  it turns, and reaches from {} to {}\n", Significant(least->parameter, 4),
                        Significant(most->parameter, 4));
  // A stride has some twenty events: where their order changes is told, not how.
  const bool strides = HasStrides(run.hopper);
  std::string orders;
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const BranchPoint &a = branch.points[i - 1], &b = branch.points[i];
    if (strides && b.sequence_changed)
      orders += (orders.empty() ? "" : ", ") + Significant(b.parameter, 4);
    const std::string place = fmt::format("  {} = {}: ", name, Significant(b.parameter, 4));
    if (b.sequence_changed && !strides)
      text += place + "an event grazes, " + EventSequence(a.fixed_point.hop) + " becomes " +
              EventSequence(b.fixed_point.hop) + "\n";
    else if (b.near_grazing && !a.near_grazing && !strides)
      text += place + "an event is close to grazing from here on\n";
    if (a.fixed_point.stable() != b.fixed_point.stable())
      text += place + (b.fixed_point.stable() ? "stable" : "unstable") + " from here on\n";
  }
  if (!orders.empty()) text += "  another order of events from " + name + " = " + orders + " on\n";
  for (const Bifurcation& b : branch.bifurcations)
    text += fmt::format("  {} = {}: {}\n", name, Significant(b.parameter, 4), NameOf(b.kind));
  return text;
}

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

// "0.94" or "0.1 + 0.3i".
std::string Multiplier(const std::complex<double>& m) {
  if (m.imag() == 0.0) return Significant(m.real(), 7);
  return Significant(m.real(), 7) + (m.imag() > 0.0 ? " + " : " - ") +
         Significant(std::abs(m.imag()), 7) + "i";
}

// The steady stride of a robot and its stability.
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
    text += "  from its own start it " + std::string(SentenceOf(run.own_outcome)) + "\n";
  return text;
}

std::string PredictionText(const GaitRun& run) {
  if (run.prediction.linear_hops < 0) return "none, it does not come back";
  return fmt::format("{} (the slowest mode starts at {} % and needs {})",
                     run.prediction.linear_hops, Significant(100.0 * run.prediction.e0, 3),
                     Fixed(run.prediction.hops, 1));
}

std::string CountedText(const GaitRun& run) {
  if (!run.counted || !run.counted->converged()) return "";
  return fmt::format("{} in the scenario's run, at {} s{}", run.counted->hops,
                     Fixed(run.counted->time, 3),
                     run.counted->band == ConvergenceTime::Band::kTwoPercent ? "* (2 %)" : "");
}

// What each parameter does to the spectral radius.
std::string RateTable(const GaitRun& run, bool colours) {
  using enum TextTable::Align;
  TextTable table({kLeft, kRight, kRight, kRight});
  table.AddRow({"parameter", "value (SI)", "d rho/d parameter", "rho per +1 %"});
  for (std::size_t i = 0; i < run.rates.size(); ++i) {
    const double value = ValueOf(run.hopper, GaitDirection(run.hopper, run.parameters[i]));
    const double rate = run.rates[i].value;
    table.AddRow({run.parameters[i], Significant(value, 5),
                  !run.computed[i]   ? "not computed"
                  : std::isnan(rate) ? "does not exist"
                                     : fmt::format("{:+.5e}", rate),
                  std::isnan(rate) ? "" : fmt::format("{:+.6f}", 0.01 * value * rate)});
  }
  const std::vector<std::string> lines = table.Lines();
  std::string text = "\n" + Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  return text;
}

}  // namespace

std::string GaitReport(const std::string& name, const GaitRun& run, bool colours) {
  const FixedPoint& p = run.point;
  std::string text = Styled(name, Emphasis::kBold, colours);
  if (HasStrides(run.hopper)) {
    text += fmt::format("  law robot, {} strides from its start\n\n", Fixed(run.own_strides, 1));
    return p.found() ? text + StrideReport(run) + RateTable(run, colours) + BranchReport(run)
                     : text;
  }
  text +=
      fmt::format("  law {}, from an apex at {} m with {} m/s\n\n", NameOf(run.hopper.request.law),
                  Fixed(run.start[1], 4), Fixed(run.start[0], 4));
  if (!p.found()) return text;
  text += fmt::format("  steady hop       vx {} m/s, apex {} m, every {} s ({})\n",
                      Significant(p.state[0], 7), Significant(p.state[1], 7),
                      Significant(p.hop.period, 5), EventSequence(p.hop));
  text += fmt::format("  multipliers      {} and {}\n", Multiplier(p.multipliers[0]),
                      Multiplier(p.multipliers[1]));
  text += fmt::format("  spectral radius  {}, {}\n", Significant(p.spectral_radius, 7),
                      p.conserves_energy ? "one multiplier is the energy's, which is conserved"
                      : p.stable()       ? "stable"
                                         : "unstable");
  text += "  hops to 1 %      " + PredictionText(run) + "\n";
  if (const std::string counted = CountedText(run); !counted.empty())
    text += "  counted          " + counted + "\n";
  if (run.hopper.request.law == Law::kLargeDeflection &&
      p.hop.max_deflection_ratio > kMaxDeflectionRatio)
    text += fmt::format("  the leg bends to F C/l0 = {}; beyond {} this law is not to be trusted\n",
                        Significant(p.hop.max_deflection_ratio, 2), kMaxDeflectionRatio);
  return text + RateTable(run, colours) + BranchReport(run);
}

}  // namespace hoplab
