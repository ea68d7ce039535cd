#include "tests/support/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/support/richardson.h"
#include "tests/support/tolerances.h"

namespace hoplab::testing {
namespace {

using Of = SensitivityDirection::Of;

double ValueOf(const SimulationRequest& q, const SensitivityDirection& d) {
  switch (d.of) {
    case Of::kParameter:
      return Field(q.parameters, d.parameter);
    case Of::kInitialState:
      return q.initial[d.index];
    case Of::kEffect:
      return q.effects[d.index].values[d.component];
    case Of::kInput:
      return d.component == 0 ? q.inputs[d.index].delay : q.inputs[d.index].scale;
    case Of::kTouchdownAngle:
      return q.touchdown_angles[d.index];
    case Of::kClock:
      return q.clock_offsets[d.index];
  }
  return 0.0;
}

// A change of this size is a moderate one.
double SizeOf(const SimulationRequest& q, const SensitivityDirection& d) {
  if (d.of == Of::kEffect) return q.effects[d.index].effect->info.parameters[d.component].typical;
  const bool is_time = d.of == Of::kClock || (d.of == Of::kInput && d.component == 0);
  if (is_time) return 1e-3;  // s
  const double value = std::abs(ValueOf(q, d));
  if (value > 0.0) return value;
  return d.of == Of::kParameter && d.parameter == ParameterId::kThetaTd ? 0.2 : 1.0;
}

// Below its bound a parameter may mean nothing.
bool AtLowerBound(const SimulationRequest& q, const SensitivityDirection& d) {
  return d.of == Of::kEffect &&
         ValueOf(q, d) <= q.effects[d.index].effect->info.parameters[d.component].lower;
}

struct Run {
  std::vector<double> all;  // samples | final state | event times
  std::string sequence;
};
Run RunAt(SimulationRequest q, const SensitivityDirection& d, double value) {
  std::vector<EffectSetting> effects(q.effects.begin(), q.effects.end());
  std::vector<DrivenInput> inputs(q.inputs.begin(), q.inputs.end());
  std::vector<double> angles(q.touchdown_angles.begin(), q.touchdown_angles.end());
  std::vector<double> offsets(q.clock_offsets.begin(), q.clock_offsets.end());
  switch (d.of) {
    case Of::kParameter:
      Field(q.parameters, d.parameter) = value;
      break;
    case Of::kInitialState:
      q.initial[d.index] = value;
      break;
    case Of::kEffect:
      effects[d.index].values[d.component] = value;
      break;
    case Of::kInput:
      (d.component == 0 ? inputs[d.index].delay : inputs[d.index].scale) = value;
      break;
    case Of::kTouchdownAngle:
      angles[d.index] = value;
      break;
    case Of::kClock:
      offsets[d.index] = value;
      break;
  }
  q.inputs = inputs;
  q.touchdown_angles = angles;
  q.clock_offsets = offsets;
  q.effects = effects;
  // An effect at its null acts only while it is differentiated; its events are wanted too.
  const bool at_null = d.of == Of::kEffect && effects[d.index].IsNull();
  q.directions = at_null ? std::span(&d, 1) : std::span<const SensitivityDirection>{};
  const Trajectory t = Simulate(q);
  Run run;
  run.all = t.samples;
  run.all.insert(run.all.end(), t.final_state.begin(), t.final_state.end());
  for (const Event& e : t.events) {
    run.all.push_back(e.time);
    run.sequence += hoplab::NameOf(e.kind);
    run.sequence += static_cast<char>('0' + e.leg);
    run.sequence += ' ';
  }
  return run;
}

double Norm(const std::vector<double>& v, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += v[i] * v[i];
  return std::sqrt(sum);
}

}  // namespace

std::string NameOf(const SimulationRequest& q, const SensitivityDirection& d) {
  static constexpr const char* kStates[] = {"x", "y", "vx", "vy"};
  switch (d.of) {
    case Of::kParameter:
      return std::string(InfoOf(d.parameter).name);
    case Of::kInitialState:
      return (d.index < static_cast<int>(std::size(kStates)) ? std::string(kStates[d.index])
                                                             : "state " + std::to_string(d.index)) +
             "(0)";
    case Of::kEffect:
      return std::string(q.effects[d.index].effect->info.name) + "." +
             std::string(q.effects[d.index].effect->info.parameters[d.component].name);
    case Of::kInput:
      return std::string(InfoOf(q.inputs[d.index].kind).name) +
             (d.component == 0 ? ".delay" : ".scale");
    case Of::kTouchdownAngle:
      return "touchdown_angle." + std::to_string(d.index + 1);
    case Of::kClock:
      return "clock." + std::to_string(d.index);
  }
  return "";
}

std::vector<ColumnCheck> CheckGradient(const SimulationRequest& request,
                                       const Trajectory& analytic) {
  const std::size_t width = request.directions.size();
  std::vector<ColumnCheck> checks;
  for (std::size_t k = 0; k < width; ++k) {
    const SensitivityDirection& d = request.directions[k];
    const Run base = RunAt(request, d, ValueOf(request, d));
    bool changed = false;
    const auto f = [&](double value) {
      const Run run = RunAt(request, d, value);
      changed = changed || run.sequence != base.sequence;
      return run.all;
    };
    std::vector<double> column;
    const auto append = [&](const std::vector<double>& from) {
      for (std::size_t i = k; i < from.size(); i += width) column.push_back(from[i]);
    };
    append(analytic.sensitivities);
    // Perturbed runs that end at an event end at another time: derivatives along that event.
    for (std::size_t i = 0; i < analytic.final_state.size(); ++i) {
      double along = analytic.final_sensitivities[i * width + k];
      if (analytic.outcome != Outcome::kCompleted)
        along += analytic.final_rate[i] *
                 analytic.event_time_sensitivities[(analytic.events.size() - 1) * width + k];
      column.push_back(along);
    }
    append(analytic.event_time_sensitivities);

    // First a step that moves the results by about 1 % (if that is a moderate change of the
    // parameter), then shorter ones. A step that meets another
    // event sequence is of no use.
    const double size = SizeOf(request, d);
    const double slope = Norm(column, 0, column.size());
    const double values = Norm(base.all, 0, base.all.size());
    double h = 0.01 * values / slope;
    if (!(h < 0.4 * size) && (ValueOf(request, d) != 0.0 || !std::isfinite(h))) h = 0.4 * size;
    std::vector<DifferenceColumn> tables;  // of the lengths that met no other sequence
    // Usually five lengths; more where no step was short enough yet (three hops of an unstable
    // gait carry a millimetre to a fall).
    for (int attempt = 0; attempt < 5 || (attempt < 10 && tables.empty()); ++attempt, h *= 0.25) {
      changed = false;
      const DifferenceColumn found = AtLowerBound(request, d)
                                         ? RichardsonForward(f, ValueOf(request, d), h)
                                         : RichardsonDerivative(f, ValueOf(request, d), h);
      if (!changed && found.value.size() == column.size()) tables.push_back(found);
    }

    const std::size_t samples = analytic.samples.size(), finals = analytic.final_state.size();
    const std::size_t bounds[] = {0, samples, samples + finals,
                                  samples + finals + analytic.events.size()};
    static constexpr const char* kParts[] = {"samples", "final state", "event times"};
    for (int part = 0; part < 3; ++part) {
      const std::size_t begin = bounds[part], end = bounds[part + 1];
      if (begin == end) continue;
      ColumnCheck check;
      check.what = std::string(kParts[part]) + " d/d" + NameOf(request, d);
      check.sequence_changed = tables.empty();
      if (!check.sequence_changed) {
        // Of each part the best differences: what suits the samples need not suit event times.
        const DifferenceColumn& oracle =
            *std::min_element(tables.begin(), tables.end(), [&](const auto& a, const auto& b) {
              return Norm(a.error, begin, end) < Norm(b.error, begin, end);
            });
        std::vector<double> difference(column.size());
        for (std::size_t i = 0; i < column.size(); ++i) difference[i] = column[i] - oracle.value[i];
        const double norm = Norm(oracle.value, begin, end);
        const double zero = 1e-9 * Norm(base.all, begin, end) / size;
        check.nothing_to_see = norm < zero && Norm(column, begin, end) < zero;
        check.error = Norm(difference, begin, end) / norm;
        check.oracle_error = Norm(oracle.error, begin, end) / norm;
      }
      checks.push_back(check);
    }
  }
  return checks;
}

std::vector<ColumnCheck> CheckGradient(const SimulationRequest& request) {
  return CheckGradient(request, Simulate(request));
}

std::string Complaint(const ColumnCheck& check) {
  std::ostringstream text;
  if (check.sequence_changed) {
    text << check.what << ": the differences meet another event sequence";
  } else if (check.nothing_to_see) {
    return "";
  } else if (!(check.error <= kGradient)) {
    text << check.what << ": off by " << check.error << " of its norm (differences good to "
         << check.oracle_error << ")";
  } else if (!(check.oracle_error <= kGradientOracle)) {
    text << check.what << ": differences only good to " << check.oracle_error;
  }
  return text.str();
}

}  // namespace hoplab::testing
