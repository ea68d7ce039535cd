#include "fitting/problem.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/input_error.h"
#include "base/text.h"
#include "fitting/driven_trial.h"
#include "fitting/model_of_spec.h"
#include "fitting/noise.h"
#include "fitting/robot_problem.h"
#include "model/leg_compliance.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Sizes of a change of start that matter where no prior tells one: [m], [m], [m/s], [m/s].
constexpr std::array<double, 4> kStartScale = {0.01, 0.01, 0.05, 0.05};
constexpr std::array<const char*, 4> kStartNames = {"x0", "y0", "vx0", "vy0"};
// Priors tighter than this pin a component: the optimiser still sees a well-scaled variable.
constexpr double kTightest = 1e-9;

std::vector<ParameterId> ParametersOf(const FitProblem& problem) {
  const auto of = hoplab::ParametersOf(MechanismOf(problem.law));
  std::vector<ParameterId> ids(of.begin(), of.end());
  if (problem.leg_mass() == LegMass::kAtToe) {
    const auto toe = ToeParameters();
    ids.insert(ids.end(), toe.begin(), toe.end());
  }
  return ids;
}

// Damping at which a leg of this stiffness loses a few percent of its energy: the size of a change
// of d that matters when its nominal value is zero.
double TypicalDamping(const Parameters<double>& p, MechanismKind mechanism) {
  const double stiffness =
      mechanism == MechanismKind::kStraightLeg ? p.k : 1.0 / LegCompliance<double>(p).Chord(2.5);
  return 0.04 * std::sqrt(stiffness * p.m);
}

struct ParameterName {
  std::string whole, effect, parameter;  // effect empty for a parameter of the mechanism
};
ParameterName SplitName(const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return {name, "", name};
  return {name, name.substr(0, dot), name.substr(dot + 1)};
}

class Builder {
 public:
  Builder(const Dataset& dataset, const ProblemOptions& options)
      : dataset_(dataset), options_(options), mechanism_(MechanismOfSpec(dataset.mechanism)) {}

  FitProblem Build() {
    problem_.law = ResolveLaw(options_.law, mechanism_, "--law");
    problem_.integrator = options_.integrator;
    problem_.clocks = ClocksOf(dataset_);
    AddFormulas();
    problem_.known = KnownCauses(dataset_.known, problem_.formulas);
    if (const std::string known = problem_.known.Text(); !known.empty())
      problem_.notes.push_back("known of the set-up: " + known);
    AddTrials();
    AddChannels();
    FillTrials();
    ChooseModuli(options_, problem_);
    FixValues();
    AddShared();
    return std::move(problem_);
  }

 private:
  void AddTrials() {
    for (const Trial& trial : dataset_.trials) {
      TrialProblem t;
      t.file = t.recording = trial.file;
      t.role = trial.role;
      t.parameters = ParametersOfSpec(trial.mechanism, trial.controller, trial.touchdown_angle_rad);
      CheckVariant(trial.mechanism.variant, problem_.law, dataset_.origin.place);
      t.liftoff = LiftoffOfSpec(trial.mechanism);
      const std::vector<double>& time = trial.trace.time_s;
      t.begin_s = time.front();
      t.row_times.reserve(time.size());
      for (double s : time) t.row_times.push_back(s - time.front());
      problem_.trials.push_back(std::move(t));
    }
  }

  void AddChannels() {
    for (const ChannelSpec& spec : dataset_.channels) {
      if (spec.id == ChannelId::kContact) {
        problem_.uses_contact = true;
        continue;
      }
      if (IsContact(spec.id)) {
        problem_.notes.push_back(std::string(ChannelName(spec.id)) + " is not compared");
        continue;
      }
      ChannelProblem c{ChannelOfSpec(spec.id), spec.sigma.value_or(kNaN), !spec.sigma};
      for (std::size_t i = 0; i < problem_.clocks.size(); ++i)
        if (problem_.clocks[i].name == spec.clock) c.clock = static_cast<int>(i);
      if (!spec.sigma) {
        std::vector<SampledColumn> columns;
        for (const Trial& trial : dataset_.trials) {
          if (const std::vector<double>* values = trial.trace.Find(spec.id))
            columns.push_back({trial.trace.time_s, *values});
        }
        c.sigma = EstimateNoise(columns);
        if (!(c.sigma > 0.0)) {
          throw InputError({spec.origin.place,
                            std::string(ChannelName(spec.id)) + ": {sigma: estimate}",
                            "the noise cannot be estimated from so few (or constant) samples",
                            "State sigma, one standard deviation in the channel's unit."});
        }
        problem_.notes.push_back("noise of " + std::string(ChannelName(spec.id)) +
                                 " estimated from the traces: " + Rounded(c.sigma));
      }
      problem_.channels.push_back(c);
    }
    if (problem_.channels.empty() && !problem_.uses_contact) {
      throw InputError({dataset_.origin.place, "channels", "names nothing to compare", ""});
    }
  }

  static std::string Rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }

  bool Sees(Channel channel) const {
    return std::any_of(problem_.channels.begin(), problem_.channels.end(),
                       [&](const ChannelProblem& c) { return c.channel == channel; });
  }

  void FillTrials() {
    const std::size_t width = problem_.channels.size();
    for (std::size_t i = 0; i < problem_.trials.size(); ++i) {
      const Trial& trial = dataset_.trials[i];
      TrialProblem& t = problem_.trials[i];
      t.data.assign(t.row_times.size() * width, kNaN);
      for (std::size_t c = 0; c < width; ++c) {
        const std::vector<double>* values = trial.trace.Find(NameOf(problem_.channels[c].channel));
        if (!values) continue;
        for (std::size_t row = 0; row < values->size(); ++row) {
          t.data[row * width + c] = (*values)[row];
          if (!std::isnan((*values)[row])) ++t.sample_count;
        }
      }
      if (problem_.uses_contact) ReadContact(trial, t);
      SetStart(trial, t);
      AddDriven(trial, problem_, t);
    }
  }

  // Switching times of a contact column.
  static void ReadContact(const Trial& trial, TrialProblem& t) {
    const std::vector<double>* contact = trial.trace.Find(ChannelId::kContact);
    if (!contact) return;
    int last = -1;
    for (std::size_t row = 0; row < contact->size(); ++row) {
      if (std::isnan((*contact)[row])) continue;
      if (last >= 0 && (*contact)[row] != (*contact)[last]) {
        const double a = t.row_times[last], b = t.row_times[row];
        const bool down = (*contact)[row] > 0.5;
        (down ? t.contact.touchdown_s : t.contact.liftoff_s).push_back(0.5 * (a + b));
        (down ? t.contact.touchdown_sigma_s : t.contact.liftoff_sigma_s)
            .push_back((b - a) / std::sqrt(12.0));
        ++t.sample_count;
      }
      last = static_cast<int>(row);
    }
  }

  void SetStart(const Trial& trial, TrialProblem& t) {
    t.start = trial.initial ? OwnValues(StateOfSpec(*trial.initial)) : StartFromTrace(trial, t);
    for (int i = 0; i < 4; ++i) {
      t.own.push_back({.name = kStartNames[i],
                       .direction = SensitivityDirection::InitialState(i),
                       .scale = kStartScale[i],
                       .prior_mean = t.start[i]});
    }
    if (trial.initial && trial.initial_sigma) {
      const OwnValues sigma = StateOfSpec(*trial.initial_sigma);
      for (int i = 0; i < 4; ++i) {
        t.own[i].prior_sigma = std::max(sigma[i], kTightest);
        t.own[i].scale = std::min(t.own[i].scale, t.own[i].prior_sigma);
      }
    }
    if (problem_.law == Law::kRobot) AddPitch(trial, t);
    if (trial.initial && trial.initial->mode != StartMode::kFlight) SetContact(trial, t);
    // Without a channel that knows where the hopper is along the ground, x is a free choice.
    if (!Sees(Channel::kBodyX) && std::isinf(t.own[0].prior_sigma)) t.own[0].free = false;
  }

  // The contact of a record that begins in stance.
  static void SetContact(const Trial& trial, TrialProblem& t) {
    t.start_mode = ModeOfSpec(trial.initial->mode, trial.mechanism.type);
    const bool known = trial.initial_sigma && trial.initial_sigma->contact_x_m;
    OwnParameter contact{.name = "contact0",
                         .direction = SensitivityDirection::InitialState(4),
                         .scale = kStartScale[0],
                         .prior_mean = *trial.initial->contact_x_m};
    if (known) contact.prior_sigma = std::max(*trial.initial_sigma->contact_x_m, kTightest);
    contact.scale = std::min(contact.scale, contact.prior_sigma);
    t.start.conservativeResize(5);
    t.start[4] = contact.prior_mean;
    t.own.push_back(contact);
  }

  // Start of a trial that states none: a parabola through the first flight, line in x.
  OwnValues StartFromTrace(const Trial& trial, const TrialProblem& t) const {
    if (problem_.law == Law::kRobot) {
      throw InputError({trial.origin.place, "initial", "is absent, and a robot needs it",
                        "State initial: {x_m, y_m, vx_m_per_s, vy_m_per_s, pitch_rad, "
                        "pitch_rate_rad_per_s} of the first row."});
    }
    const double g = t.parameters.g;
    OwnValues start = Eigen::Vector4d(0.0, kNaN, 0.0, 0.0);
    const double touchdown = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
    const std::vector<double>* y = trial.trace.Find(ChannelId::kBodyY);
    std::size_t rows = t.row_times.size();
    if (y) {
      rows = 0;
      while (rows < y->size() && !((*y)[rows] < touchdown)) ++rows;
      LineFit(t, *y, rows, -0.5 * g, start[1], start[3]);
    }
    if (const std::vector<double>* x = trial.trace.Find(ChannelId::kBodyX))
      LineFit(t, *x, rows, 0.0, start[0], start[2]);
    if (const std::vector<double>* v = trial.trace.Find(ChannelId::kBodyVx);
        v && !std::isnan(v->front()))
      start[2] = v->front();
    if (const std::vector<double>* v = trial.trace.Find(ChannelId::kBodyVy);
        v && !std::isnan(v->front()))
      start[3] = v->front();
    if (!(start[1] >= touchdown)) {
      throw InputError({trial.origin.place, "initial",
                        "is absent, and the trace does not show where the first flight begins",
                        "State `initial: {x_m, y_m, vx_m_per_s, vy_m_per_s}` of the first row."});
    }
    return start;
  }

  // values = offset + slope t + curvature t^2 over the first rows, by least squares.
  static void LineFit(const TrialProblem& t, const std::vector<double>& values, std::size_t rows,
                      double curvature, double& offset, double& slope) {
    double n = 0, st = 0, stt = 0, sv = 0, stv = 0;
    for (std::size_t i = 0; i < std::min(rows, values.size()); ++i) {
      if (std::isnan(values[i])) continue;
      const double time = t.row_times[i], v = values[i] - curvature * time * time;
      n += 1;
      st += time;
      stt += time * time;
      sv += v;
      stv += time * v;
    }
    const double det = n * stt - st * st;
    if (n < 1) return;
    if (n < 3 || det <= 0) {
      offset = sv / n;
      return;
    }
    slope = (n * stv - st * sv) / det;
    offset = (sv - slope * st) / n;
  }

  // --fix name=value: a parameter of the mechanism in every trial, or an effect at that value.
  void FixValues() {
    for (const auto& [name, value] : options_.fix) {
      if (FixDriven(name, value, problem_)) continue;
      const ParameterName split = SplitName(name);
      if (split.effect.empty()) {
        const ParameterId id = KnownParameter(name, "--fix");
        CheckRange(name, value, InfoOf(id).lower, InfoOf(id).upper, InfoOf(id).unit, "--fix");
        for (TrialProblem& t : problem_.trials) Field(t.parameters, id) = value;
      } else {
        const auto [index, component] = EffectParameterOf(split, "--fix");
        const EffectParameter& info = problem_.effects[index].effect->info.parameters[component];
        CheckRange(name, value, info.lower, info.upper, info.unit, "--fix");
        problem_.known.CheckValue(*problem_.effects[index].effect, component, value, "--fix");
        problem_.effects[index].values[component] = value;
      }
    }
  }

  static void CheckRange(const std::string& name, double value, double lower, double upper,
                         std::string_view unit, const std::string& place) {
    if (value >= lower && value <= upper) return;
    throw InputError({place, name + " = " + FormatDouble(value),
                      "must be in [" + FormatDouble(lower) + ", " + FormatDouble(upper) + "] " +
                          std::string(unit),
                      "Values are in SI units."});
  }

  ParameterId KnownParameter(const std::string& name, const std::string& place) const {
    const std::optional<ParameterId> id = FindParameter(name);
    const std::vector<ParameterId> of = ParametersOf(problem_);
    if (id && std::find(of.begin(), of.end(), *id) != of.end()) {
      if (IsOfRobot(*id, problem_)) return *id;
      throw InputError({place, name,
                        *id == ParameterId::kE ? "is told of each leg by itself here"
                                               : "is of a leg this robot does not have",
                        *id == ParameterId::kE ? "Name E_1, E_2, ... or E alone."
                                               : "Legs are counted from the hindmost, 1."});
    }
    const auto toe = ToeParameters();
    if (id && mechanism_ != MechanismKind::kBall &&
        std::find(toe.begin(), toe.end(), *id) != toe.end()) {
      throw InputError({place, name, "belongs to a leg with a toe mass, and this one has none",
                        "Add toe_mass_kg to the mechanism."});
    }
    std::vector<std::string> names;
    for (ParameterId own : of) names.emplace_back(InfoOf(own).name);
    throw InputError({place, Printable(name),
                      "is not a parameter of the mechanism " + std::string(NameOf(mechanism_)),
                      DidYouMean(name, names)});
  }

  // Place of an effect's parameter, the effect joining the problem if it is new.
  std::pair<int, int> EffectParameterOf(const ParameterName& name, const std::string& place) {
    const Effect& effect = ResolveEffect(name.effect, place, problem_.formulas);
    const std::optional<int> component = effect.FindParameter(name.parameter);
    if (!component) {
      std::vector<std::string> known;
      for (const EffectParameter& p : effect.info.parameters)
        known.push_back(name.effect + "." + std::string(p.name));
      throw InputError({place, Printable(name.whole), "is not a parameter of this effect",
                        DidYouMean(name.whole, known)});
    }
    return {EffectIndex(effect, place), *component};
  }

  // The dataset's formulas, and those that --with names by their files.
  void AddFormulas() {
    for (const EffectFile& file : dataset_.effects)
      AddFormula(EffectOfFile(file), file.origin.place);
    for (const std::string& name : options_.with_effects)
      if (IsEffectFile(name)) AddFormula(ResolveEffect(name, "--with"), name);
  }
  void AddFormula(const Effect& effect, const std::string& place) {
    for (const Effect* other : problem_.formulas) {
      if (other == &effect) return;
      if (other->info.name == effect.info.name)
        throw InputError({place, "name = " + std::string(effect.info.name),
                          "is the name of another formula of this dataset",
                          "Call one of the two otherwise."});
    }
    problem_.formulas.push_back(&effect);
  }

  int EffectIndex(const Effect& effect, const std::string& place) {
    CheckApplies(effect, problem_.law, problem_.leg_mass(), place, problem_.inputs(),
                 problem_.robot_legs());
    for (std::size_t i = 0; i < problem_.effects.size(); ++i) {
      if (problem_.effects[i].effect == &effect) return static_cast<int>(i);
    }
    problem_.effects.push_back(EffectSetting::Null(effect));
    return static_cast<int>(problem_.effects.size()) - 1;
  }

  void AddShared() {
    std::vector<std::string> names = options_.free;
    const std::string place = names.empty() ? "fit" : "--free";
    if (names.empty()) names = FreeNames(problem_);
    for (const std::string& name : names) {
      // A default parameter that is fixed is simply not free.
      if (options_.free.empty() && options_.fix.count(name)) continue;
      if (options_.fix.count(name))
        throw InputError({"--free", name, "is also given to --fix", "Name it in one of the two."});
      AddSharedNamed(name, place);
    }
    for (const std::string& name : options_.with_effects) {
      const Effect& effect = ResolveEffect(name, "--with", problem_.formulas);
      problem_.known.CheckOpen(effect, "--with");
      for (const OpenParameter& p : problem_.known.OpenParameters(effect)) {
        const std::string whole = std::string(effect.info.name) + "." + std::string(p.info.name);
        if (!options_.fix.count(whole)) AddSharedNamed(whole, "--with");
      }
    }
    FreeWhatIsUncertain(dataset_, options_.fix, problem_);
    if (problem_.shared.empty())
      throw InputError({"--fix", "", "leaves nothing to fit", "Free at least one parameter."});
  }

  void AddSharedNamed(const std::string& name, const std::string& place) {
    for (const SharedParameter& s : problem_.shared) {
      if (s.name == name) throw InputError({place, name, "is named twice", ""});
    }
    if (const auto driven = DrivenParameter(problem_, name, place)) {
      problem_.shared.push_back(*driven);
      return;
    }
    const ParameterName split = SplitName(name);
    if (!split.effect.empty()) {
      const auto [index, component] = EffectParameterOf(split, place);
      const Effect& effect = *problem_.effects[index].effect;
      const std::optional<EffectParameter> info = problem_.known.Open(effect, component);
      if (!info)
        throw InputError({place, name,
                          "is known to be null: known of the set-up is " + problem_.known.Text(),
                          "Remove the line under `known` if it may be present after all."});
      problem_.shared.push_back({name,
                                 std::string(info->unit),
                                 SensitivityDirection::EffectParameter(index, component),
                                 info->lower,
                                 info->upper,
                                 problem_.effects[index].values[component],
                                 std::abs(info->typical),
                                 {},
                                 effect.info.has_threshold});
      return;
    }
    const ParameterId id = KnownParameter(name, place);
    const bool own_angles = std::any_of(
        problem_.trials.begin(), problem_.trials.end(),
        [](const TrialProblem& t) { return !t.touchdown_angles.empty() || !t.inputs.empty(); });
    if (id == ParameterId::kThetaTd && own_angles)
      throw InputError({place, name, "is each touch-down's own in this dataset",
                        "Say touchdown_angle_sigma_deg, or try the effect touchdown_angle_bias."});
    const Parameters<double>& p = problem_.trials.front().parameters;
    const double nominal = Field(p, id);
    for (const TrialProblem& t : problem_.trials) {
      if (Field(t.parameters, id) != nominal) {
        throw InputError({place, name,
                          "differs between the trials of this dataset, so it cannot be one shared "
                          "value",
                          "Fix it, or split the dataset."});
      }
    }
    const ParameterInfo& info = InfoOf(id);
    double scale = std::abs(nominal);
    if (id == ParameterId::kD) scale = std::max(scale, TypicalDamping(p, mechanism_));
    if (id == ParameterId::kLegDamping) scale = std::max(scale, 1e-4);
    if (id == ParameterId::kLegMass) scale = std::max(scale, 0.01);
    if (id == ParameterId::kComX || id == ParameterId::kComY) scale = std::max(scale, 0.01);
    if (id == ParameterId::kRestitution || id == ParameterId::kTangentialLoss)
      scale = std::max(scale, 0.1);
    if (scale == 0.0) scale = 1.0;
    problem_.shared.push_back({name, std::string(info.unit), SensitivityDirection::Parameter(id),
                               info.lower, info.upper, nominal, scale});
  }

  const Dataset& dataset_;
  const ProblemOptions& options_;
  MechanismKind mechanism_;
  FitProblem problem_;
};

}  // namespace

LegMass FitProblem::leg_mass() const {
  const bool any = std::any_of(trials.begin(), trials.end(),
                               [](const TrialProblem& t) { return t.parameters.m_toe > 0.0; });
  return any ? LegMass::kAtToe : LegMass::kNone;
}

ProblemOptions WithLegsAlike(ProblemOptions options) {
  options.legs_alike = true;
  return options;
}

int FitProblem::robot_legs() const {
  return trials.empty() || !trials.front().parameters.robot ? 0
                                                            : trials.front().parameters.robot->legs;
}

InputSet FitProblem::inputs() const {
  InputSet set = 0;
  for (const TrialProblem& t : trials)
    for (const DrivenColumn& column : t.inputs) set |= BitOf(column.kind);
  return set;
}

std::vector<std::string> FitProblem::shared_names() const {
  std::vector<std::string> names;
  for (const SharedParameter& s : shared) names.push_back(s.name);
  return names;
}

FitProblem MakeProblem(const Dataset& dataset, const ProblemOptions& options) {
  return Builder(dataset, options).Build();
}

Eigen::VectorXd InitialShared(const FitProblem& problem) {
  Eigen::VectorXd values(problem.shared_count());
  for (int i = 0; i < problem.shared_count(); ++i) {
    const SharedParameter& s = problem.shared[i];
    // A start on a bound has only one side to go to: begin a tenth of a typical size inside.
    const double room = std::min(0.1 * s.scale, 0.25 * (s.upper - s.lower));
    values[i] = std::clamp(s.initial, s.lower + room, s.upper - room);
  }
  return values;
}

}  // namespace hoplab
