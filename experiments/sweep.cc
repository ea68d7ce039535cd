#include "experiments/sweep.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "base/input_error.h"
#include "base/nan.h"
#include "base/random.h"
#include "base/text.h"
#include "experiments/fingerprint.h"
#include "experiments/scenario_hopper.h"

namespace hoplab {
namespace {

constexpr std::size_t kMaxRows = 10'000'000;

// One value per row in each of `samples` equal slices of the range, in random order.
std::vector<double> HypercubeColumn(const KeyRange& range, int samples, RandomStream& random) {
  std::vector<int> slices(static_cast<std::size_t>(samples));
  std::iota(slices.begin(), slices.end(), 0);
  for (int i = samples - 1; i > 0; --i)
    std::swap(slices[i], slices[static_cast<int>(random.Uniform(0.0, i + 1.0))]);
  std::vector<double> values;
  for (const int slice : slices) {
    const double place = (slice + random.Uniform(0.0, 1.0)) / samples;
    values.push_back(range.low + place * (range.high - range.low));
  }
  return values;
}

// An output that the mechanism has.
void CheckOutput(const SweepOutput& output, const Scenario& scenario) {
  const auto refuse = [&](const char* rule) {
    throw InputError({scenario.sweep->origin.place, std::string(output.name), rule,
                      "Remove it from sweep.outputs."});
  };
  const MechanismKind kind = scenario.mechanism.type;
  if (kind == MechanismKind::kBall && output.needs_fixed_point) refuse("does not exist for a ball");
  if (kind != MechanismKind::kRobot) return;
  if (output.needs_fixed_point && scenario.controller->motors->kind != MotorControl::kClock)
    refuse("does not exist for a robot whose motors follow no clock");
  if (output.name == "energy_percent")
    refuse("is not told of a robot, whose pitch and motors hold energy, too");
}

}  // namespace

SweepPlan::SweepPlan(const ScenarioDocument& document, const IntegratorOptions& integrator,
                     std::uint64_t seed)
    : document_(document), integrator_(integrator) {
  const Scenario scenario = document.Read();
  name_ = scenario.name;
  if (!scenario.sweep) {
    throw InputError({scenario.origin.place, "sweep", "is absent: what is to be varied?",
                      "Add sweep: {grid: {initial.y_m: [0.2, 0.3]}, outputs: [hops]}."});
  }
  for (const OutputName& output : scenario.sweep->outputs)
    outputs_.push_back(&ResolveSweepOutput(output.name, output.origin.place));
  for (const SweepOutput* output : outputs_) CheckOutput(*output, scenario);
  law_ = HopperOfScenario(scenario, integrator).request.law;
  reading_ = scenario.mechanism.reading;
  Layout(*scenario.sweep, seed);
  Fingerprint(integrator);
}

void SweepPlan::Layout(const SweepSpec& spec, std::uint64_t seed) {
  switch (spec.kind) {
    case SweepKind::kGrid: {
      grid_ = true;
      std::size_t rows = 1;
      for (const SweepAxis& axis : spec.grid) {
        keys_.push_back(axis.key);
        columns_.push_back(axis.values);
        rows *= axis.values.size();
        if (rows > kMaxRows)
          throw InputError({axis.origin.place, "sweep.grid", "has more than ten million rows",
                            "Leave values out, or use latin_hypercube."});
      }
      size_ = static_cast<int>(rows);
      return;
    }
    case SweepKind::kList:
      for (const NamedNumber& number : spec.list.front()) keys_.push_back(number.name);
      columns_.resize(keys_.size());
      for (const auto& row : spec.list) {
        for (std::size_t k = 0; k < keys_.size(); ++k) columns_[k].push_back(row[k].value);
      }
      size_ = static_cast<int>(spec.list.size());
      return;
    case SweepKind::kLatinHypercube:
      for (std::size_t k = 0; k < spec.ranges.size(); ++k) {
        RandomStream random(seed, 9000 + k);
        keys_.push_back(spec.ranges[k].key);
        columns_.push_back(HypercubeColumn(spec.ranges[k], spec.samples, random));
      }
      size_ = spec.samples;
      return;
  }
}

std::vector<double> SweepPlan::Point(int i) const {
  std::vector<double> point(keys_.size());
  auto place = static_cast<std::size_t>(i);
  for (std::size_t k = keys_.size(); k-- > 0;) {
    const std::size_t count = columns_[k].size();
    point[k] = columns_[k][grid_ ? place % count : static_cast<std::size_t>(i)];
    if (grid_) place /= count;
  }
  return point;
}

SweepRow SweepPlan::Compute(int i) const {
  const std::vector<double> point = Point(i);
  std::vector<std::pair<std::string, double>> values;
  for (std::size_t k = 0; k < keys_.size(); ++k) values.emplace_back(keys_[k], point[k]);
  try {
    const Scenario scenario = document_.ReadAt(values, "sweep");
    return ComputeSweepRow(HopperOfScenario(scenario, integrator_), outputs_);
  } catch (const InputError& error) {
    // Each value was held against its range before; together they may still not fit.
    return {std::vector<double>(outputs_.size(), kNaN), "bad_input", error.what()};
  }
}

void SweepPlan::Fingerprint(const IntegratorOptions& integrator) {
  hoplab::Fingerprint hash;
  hash.Add(document_.ResolvedText());
  for (const std::string& key : keys_) hash.Add(key);
  for (int i = 0; i < size_; ++i) {
    for (const double value : Point(i)) hash.Add(value);
  }
  for (const SweepOutput* output : outputs_) hash.Add(output->name);
  hash.Add(NameOf(integrator.kind));
  hash.Add(integrator.relative_tolerance);
  hash.Add(integrator.absolute_tolerance);
  fingerprint_ = hash.Text();
}

}  // namespace hoplab
