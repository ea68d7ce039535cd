#include "tests/support/diagnosis_cases.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/random.h"
#include "datasets/read_dataset.h"
#include "datasets/write_dataset.h"

namespace hoplab::testing {
namespace {

constexpr double kSigma = 0.0007;  // m
constexpr StateSpec kStartSigma = {0.002, 0.002, 0.02, 0.02};

struct TrialPlan {
  double angle_deg, height, speed, kp = 0.0, v_des = 0.0;
};

// Starts that run to their last hop under the four laws of a C-leg, the lossiest (thesis) included.
constexpr std::array kCLegPlans = {
    TrialPlan{18, 0.40, 1.31},         TrialPlan{22, 0.29, 1.1, 2.5, 1.5},
    TrialPlan{28, 0.34, 1.8},          TrialPlan{33, 0.38, 2.0, 1.0, 1.6},
    TrialPlan{40, 0.35, 2.3},          TrialPlan{25, 0.30, 1.5},
    TrialPlan{36, 0.42, 1.2, 2.0, 1.6}};
constexpr std::array kStraightPlans = {
    TrialPlan{12, 0.30, 1.2},           TrialPlan{15, 0.36, 1.4},
    TrialPlan{17, 0.40, 1.8, 0.6, 1.5}, TrialPlan{20, 0.34, 2.1, 1.5, 1.7},
    TrialPlan{21, 0.28, 2.2},           TrialPlan{18, 0.28, 1.5},
    TrialPlan{16, 0.33, 1.2, 1.2, 1.6}};
constexpr std::array kBallPlans = {
    TrialPlan{0, 0.25, 0.4}, TrialPlan{0, 0.6, 1.5}, TrialPlan{0, 1.2, 3.0}, TrialPlan{0, 2.0, 5.0},
    TrialPlan{0, 0.4, 4.0},  TrialPlan{0, 0.9, 2.2}, TrialPlan{0, 1.6, 1.0}};
constexpr std::size_t kTrainTrials = 5;

MechanismSpec TrueMechanism(Law law) {
  MechanismSpec m;
  m.body_mass_kg = 1.0;
  m.gravity_m_per_s2 = 9.81;
  switch (MechanismOf(law)) {
    case MechanismKind::kCLeg:
      m.type = MechanismKind::kCLeg;
      m.c_leg.rest_radius_m = 0.09;
      m.c_leg.E_Pa = 22e9;
      m.c_leg.G_Pa = 4e9;
      m.c_leg.second_moment_m4 = 0.03 * 0.0038 * 0.0038 * 0.0038 / 12.0;
      m.c_leg.area_m2 = 0.03 * 0.0038;
      m.c_leg.damping_N_s_per_m = 3.0;
      break;
    case MechanismKind::kStraightLeg:
      m.type = MechanismKind::kStraightLeg;
      m.straight_leg = {0.18, 2500.0, 3.0};
      break;
    case MechanismKind::kBall:
      m.type = MechanismKind::kBall;
      m.body_mass_kg = 0.0027;
      m.ball = {0.02, 0.85, 0.1};
      break;
    case MechanismKind::kRobot:
      break;  // has cases of its own
  }
  return m;
}

// Where a fit begins: near the truth, not at it.
MechanismSpec Nominal(MechanismSpec m) {
  m.c_leg.E_Pa *= 0.92;
  m.c_leg.damping_N_s_per_m = 2.0;
  m.straight_leg.stiffness_N_per_m *= 0.93;
  m.straight_leg.damping_N_s_per_m = 2.0;
  m.ball.restitution = 0.8;
  m.ball.tangential_loss = 0.05;
  return m;
}

EffectSpec SpecOf(const PlantedEffect& planted) {
  const Effect* effect = FindEffect(planted.name);
  if (!effect) throw std::runtime_error("no effect " + planted.name);
  EffectSpec spec{planted.name, {}, {"a planted effect"}};
  for (std::size_t i = 0; i < planted.values.size(); ++i) {
    spec.parameters.push_back(
        {std::string(effect->info.parameters[i].name), planted.values[i], {"a planted effect"}});
  }
  return spec;
}

// In one trial, as Truth::own_sizes says.
std::vector<PlantedEffect> EffectsIn(const Truth& truth, std::size_t trial) {
  constexpr std::uint64_t kStream = 200'000;
  RandomStream random(truth.seed, kStream + trial);
  std::vector<PlantedEffect> effects = truth.effects;
  for (PlantedEffect& planted : effects) {
    const EffectInfo& info = FindEffect(planted.name)->info;
    const double draw = random.Normal();
    for (std::size_t i = 0; i < planted.values.size(); ++i) {
      const EffectParameter& p = info.parameters[i];
      const bool has_one_sign = p.lower >= p.null || p.upper <= p.null;
      const double factor = has_one_sign ? std::abs(draw) : draw;
      planted.values[i] = p.null + factor * (planted.values[i] - p.null);
    }
  }
  return effects;
}

Dataset Exact(Law law, const std::vector<PlantedEffect>& effects, std::uint64_t seed,
              std::vector<std::string>* notes) {
  Scenario scenario = DiagnosisScenario(law);
  for (const PlantedEffect& e : effects) scenario.effects.push_back(SpecOf(e));
  GenerateOptions options;
  options.seed = seed;
  options.noise = 0.0;
  GeneratedDataset made = GenerateDataset(scenario, options);
  if (notes) notes->insert(notes->end(), made.notes.begin(), made.notes.end());
  return std::move(made.dataset);
}

// Unit-variance noise of one channel of one trial.
class Noise {
 public:
  Noise(const NoiseModel& model, std::uint64_t seed, std::uint64_t stream)
      : model_(model), random_(seed, stream), last_(random_.Normal()) {}

  double Read(double value) {
    switch (model_.kind) {
      case NoiseModel::Kind::kWhite:
        return value + kSigma * random_.Normal();
      case NoiseModel::Kind::kAutoregressive:
        last_ = 0.5 * last_ + std::sqrt(0.75) * random_.Normal();
        return value + kSigma * last_;
      case NoiseModel::Kind::kStudent: {
        double square = 0.0;
        for (int i = 0; i < 3; ++i) square += std::pow(random_.Normal(), 2);
        return value + kSigma * random_.Normal() / std::sqrt(square);  // t3 over its sqrt(3)
      }
      case NoiseModel::Kind::kQuantised:
        return kSigma * std::round(value / kSigma + random_.Normal());
    }
    return value;
  }
  bool Drops() { return model_.dropped > 0.0 && random_.Uniform(0.0, 1.0) < model_.dropped; }

 private:
  NoiseModel model_;
  RandomStream random_;
  double last_;
};

void AddNoise(const Truth& truth, Dataset& dataset) {
  for (ChannelSpec& c : dataset.channels) c.sigma = kSigma * truth.noise.stated;
  for (std::size_t i = 0; i < dataset.trials.size(); ++i) {
    Trace& trace = dataset.trials[i].trace;
    for (std::size_t c = 0; c < trace.columns.size(); ++c) {
      Noise noise(truth.noise, truth.seed, 100'000 + 100 * i + c);
      for (double& value : trace.columns[c].values) {
        value = noise.Read(value);
        if (noise.Drops()) value = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
}

// 2 clean - affected, row by row.
void Mirror(const Dataset& clean, Dataset& affected) {
  for (std::size_t i = 0; i < affected.trials.size(); ++i) {
    Trace& trace = affected.trials[i].trace;
    const Trace& about = clean.trials[i].trace;
    const std::size_t rows = std::min(trace.time_s.size(), about.time_s.size());
    trace.time_s.resize(rows);
    for (std::size_t c = 0; c < trace.columns.size(); ++c) {
      std::vector<double>& values = trace.columns[c].values;
      values.resize(rows);
      for (std::size_t row = 0; row < rows; ++row)
        values[row] = 2.0 * about.columns[c].values[row] - values[row];
    }
  }
}

}  // namespace

Scenario DiagnosisScenario(Law law) {
  Scenario s;
  s.name = "sealed";
  s.law = std::string(NameOf(law));
  s.mechanism = TrueMechanism(law);
  s.stop.time_s = 10.0;
  const MechanismKind kind = MechanismOf(law);
  s.stop.hops = kind == MechanismKind::kCLeg ? 2 : kind == MechanismKind::kBall ? 3 : 2;
  GenerateSpec& d = s.dataset.emplace();
  d.sample_rate_hz = 100.0;
  d.channels = {{Channel::kBodyX, kSigma}, {Channel::kBodyY, kSigma}};
  d.initial_sigma = kStartSigma;
  const auto& plans = kind == MechanismKind::kCLeg          ? kCLegPlans
                      : kind == MechanismKind::kStraightLeg ? kStraightPlans
                                                            : kBallPlans;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const TrialPlan& plan = plans[i];
    GenerateTrial t;
    t.role = i < kTrainTrials ? TrialRole::kTrain : TrialRole::kTest;
    t.file = (i < kTrainTrials ? "train-" : "test-") + std::to_string(i + 1) + ".csv";
    t.touchdown_angle_rad = plan.angle_deg * std::numbers::pi / 180.0;
    t.initial = StateSpec{0.0, plan.height, plan.speed, 0.0};
    if (plan.kp > 0.0) t.controller = ControllerSpec{plan.kp, plan.v_des, std::nullopt};
    t.mechanism = s.mechanism;
    d.trials.push_back(t);
  }
  return s;
}

double TrueStiffness(Law law) {
  const MechanismSpec m = TrueMechanism(law);
  switch (MechanismOf(law)) {
    case MechanismKind::kCLeg:
      return m.c_leg.E_Pa;
    case MechanismKind::kStraightLeg:
      return m.straight_leg.stiffness_N_per_m;
    case MechanismKind::kBall:
    case MechanismKind::kRobot:
      break;
  }
  return m.ball.restitution;
}

Dataset MakeDataset(const Truth& truth, std::vector<std::string>* notes) {
  Dataset dataset = Exact(truth.law, truth.effects, truth.seed, notes);
  if (!truth.only_recording.empty() || truth.mirrored) {
    const Dataset clean = Exact(truth.law, {}, truth.seed, notes);
    if (truth.mirrored) Mirror(clean, dataset);
    for (std::size_t i = 0; i < dataset.trials.size(); ++i) {
      if (!truth.only_recording.empty() && dataset.trials[i].file != truth.only_recording)
        dataset.trials[i].trace = clean.trials[i].trace;
    }
  }
  if (truth.own_sizes) {
    for (std::size_t i = 0; i < dataset.trials.size(); ++i)
      dataset.trials[i].trace =
          Exact(truth.law, EffectsIn(truth, i), truth.seed, notes).trials[i].trace;
  }
  AddNoise(truth, dataset);
  dataset.mechanism = Nominal(dataset.mechanism);
  for (Trial& t : dataset.trials) t.mechanism = Nominal(t.mechanism);
  return dataset;
}

Dataset MakeExactDataset(Law law) {
  Scenario scenario = DiagnosisScenario(law);
  scenario.dataset->initial_sigma.reset();
  GenerateOptions options;
  options.noise = 0.0;
  Dataset dataset = GenerateDataset(scenario, options).dataset;
  for (ChannelSpec& c : dataset.channels) c.sigma = kSigma;
  for (Trial& t : dataset.trials) t.initial_sigma = kStartSigma;
  return dataset;
}

// ---- the seal

SealedCase::SealedCase(const std::filesystem::path& folder, const Truth& truth) : folder_(folder) {
  std::vector<std::string> notes;
  const Dataset made = MakeDataset(truth, &notes);
  if (!notes.empty()) {
    const std::string what = truth.effects.empty() ? "no effect" : truth.effects.front().name;
    throw std::runtime_error("a sealed case does not run: " + what + ", " +
                             std::string(NameOf(truth.law)) + ": " + notes.front());
  }
  std::filesystem::create_directories(folder_);
  WriteDataset(made, dataset());
  std::ofstream seal(folder_ / "sealed.txt");
  seal.precision(17);
  seal << NameOf(truth.law) << ' ' << truth.size << ' ' << truth.seed << ' ' << truth.own_sizes
       << ' ' << truth.mirrored << ' ' << static_cast<int>(truth.noise.kind) << ' '
       << truth.noise.dropped << ' ' << truth.noise.stated << ' '
       << (truth.only_recording.empty() ? "-" : truth.only_recording) << '\n';
  for (const PlantedEffect& e : truth.effects) {
    seal << e.name << ' ' << e.values.size();
    for (double value : e.values) seal << ' ' << value;
    seal << '\n';
  }
}

Truth SealedCase::Open() const {
  std::ifstream seal(folder_ / "sealed.txt");
  Truth truth;
  std::string law;
  int kind = 0;
  seal >> law >> truth.size >> truth.seed >> truth.own_sizes >> truth.mirrored >> kind >>
      truth.noise.dropped >> truth.noise.stated >> truth.only_recording;
  const auto found = FindLaw(law);
  if (!seal || !found) throw std::runtime_error("the seal is broken");
  truth.law = *found;
  truth.noise.kind = static_cast<NoiseModel::Kind>(kind);
  if (truth.only_recording == "-") truth.only_recording.clear();
  PlantedEffect e;
  for (std::size_t count = 0; seal >> e.name >> count;) {
    e.values.resize(count);
    for (double& value : e.values) seal >> value;
    truth.effects.push_back(e);
  }
  return truth;
}

}  // namespace hoplab::testing
