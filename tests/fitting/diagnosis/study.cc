#include "tests/fitting/diagnosis/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <thread>

#include "base/parallel.h"
#include "base/random.h"
#include "datasets/read_dataset.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {
namespace {

double ThreadSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Chance under noise of what is left of a planted effect beside the accepted extension.
double LeftP(const Diagnosis& d, const std::string& name) {
  const FittedModel& best = d.naming.best;
  const Candidate planted{FindEffect(name)};
  for (const Candidate& member : best.members) {
    if (member.effect == planted.effect) return 1.0;
  }
  const std::array tested = {planted};
  const FitProblem problem = Extend(best.problem, tested);
  Eigen::VectorXd shared(problem.shared_count());
  shared << best.shared, NullValues(tested);
  const Linearisation at =
      Linearise(problem, best.problem.shared_count(), TrialsOf(d.problem, TrialRole::kTrain),
                shared, best.initial_states, 1);
  return ScoreOf(at, HypothesesOf(tested).front()).p_value;
}

void ReadVerdict(const Diagnosis& d, Outcome& out) {
  out.verdict = d.verdict;
  out.global_p = d.detection.p_value;
  if (d.verdict == Verdict::kNamed || d.verdict == Verdict::kConfounded) {
    for (const std::vector<int>& group : d.naming.groups) {
      std::vector<std::string>& names = out.groups.emplace_back();
      for (int i : group)
        names.push_back(d.naming.candidates[static_cast<std::size_t>(i)].candidate.Name());
    }
    if (const auto cause = d.Cause())
      out.first = d.naming.candidates[static_cast<std::size_t>(*cause)].candidate.Name();
  }
  if (d.extension) {
    const HeldOutGain& gain = d.extension->gain;
    if (!std::isnan(gain.nats_per_sample)) out.gain = gain.nats_per_sample;
    out.claims_gain = gain.IsClaim();
    out.in_doubt = d.extension->InDoubt();
  }
}

bool IsPlanted(const Truth& truth, const Candidate& c) {
  return std::any_of(truth.effects.begin(), truth.effects.end(), [&](const PlantedEffect& e) {
    return e.name == c.effect->info.name &&
           (c.in_all() || truth.own_sizes || c.only_recordings == Recordings{truth.only_recording});
  });
}

void ReadCauses(const Diagnosis& d, Outcome& out) {
  out.unlisted_probability = d.UnlistedProbability();
  out.left_share = d.left.share;
  out.at_bound = d.extension && d.extension->at_bound;
  const auto see = [&](const auto& c, const std::vector<int>& group) -> Outcome::Seen& {
    Outcome::Seen& seen = out.seen.emplace_back();
    seen.name = c.cause.Name();
    seen.each_trial = c.cause.each_trial;
    seen.probability = c.probability;
    seen.group_probability = c.group_probability;
    seen.evidence = c.evidence_probability;
    seen.features = c.features;
    seen.right = IsPlanted(out.truth, c.cause);
    seen.group_right = std::any_of(group.begin(), group.end(), [&](int i) {
      return IsPlanted(out.truth, d.naming.candidates[static_cast<std::size_t>(i)].candidate);
    });
    return seen;
  };
  // What is set aside has a probability, too.
  for (const SetAside& s : d.set_aside) see(s, s.group);
  if (!d.extension) return;
  for (const CauseReport& c : d.extension->causes)
    see(c, d.naming.GroupOf(c.candidate)).main = c.main;
}

// Pairs by name: the trap first (drag with a bias looks like a height offset), then pairs that act
// on different and on like places. Those whose files are not in the catalogue are left out.
constexpr std::array<std::array<const char*, 2>, kPairCount> kPairs = {{
    {"air_drag", "touchdown_angle_bias"},
    {"gravity_scale", "touchdown_loss"},
    {"leg_material_damping", "touchdown_angle_bias"},
    {"leg_hardening", "air_drag"},
    {"sensor_scale_y", "torque_gain"},
    {"ground_compliance", "sensor_offset_x"},
    {"camera_roll", "leg_hysteresis"},
    {"clock_scale", "touchdown_angle_speed"},
    {"ground_slope", "hip_viscous_friction"},
    {"guide_coulomb_friction", "stiffness_drift"},
}};

}  // namespace

bool Outcome::Holds(std::string_view name) const {
  return std::any_of(groups.begin(), groups.end(), [&](const std::vector<std::string>& group) {
    return std::find(group.begin(), group.end(), name) != group.end();
  });
}

bool Outcome::HoldsAll() const {
  return std::all_of(truth.effects.begin(), truth.effects.end(), [&](const PlantedEffect& e) {
    return Holds(truth.only_recording.empty() ? e.name : e.name + " in " + truth.only_recording);
  });
}

bool Outcome::NamesWrongly() const {
  if (verdict != Verdict::kNamed) return false;
  return std::none_of(truth.effects.begin(), truth.effects.end(), [&](const PlantedEffect& e) {
    return Holds(truth.only_recording.empty() ? e.name : e.name + " in " + truth.only_recording);
  });
}

int Outcome::SetSize() const {
  std::size_t size = 0;
  for (const auto& group : groups) size += group.size();
  return static_cast<int>(size);
}

Outcome RunSealed(const Truth& planted, std::vector<std::string> without) {
  const TempFolder temp;
  const SealedCase sealed(temp.path() / "case", planted);
  const double begin = ThreadSeconds();
  const Dataset dataset = ReadDataset(sealed.dataset());
  DiagnosisOptions options;
  options.problem.law = std::string(NameOf(planted.told_law.value_or(planted.law)));
  options.candidates.without = std::move(without);
  options.fit.jobs = 1;
  const Diagnosis d = Diagnose(dataset, options);

  Outcome out;
  out.cpu_seconds = ThreadSeconds() - begin;
  out.truth = sealed.Open();
  out.refusal = d.refusal;
  if (!d.refusal.empty()) return out;
  ReadVerdict(d, out);
  ReadCauses(d, out);
  const double truth = TrueStiffness(out.truth.law);
  out.error_before = std::abs(d.null.shared[0] - truth);
  out.error_after = std::abs(d.naming.best.shared[0] - truth);
  out.std_error = d.uncertainty.parameters[0].std_error.value_or(0.0);
  for (const PlantedEffect& e : out.truth.effects) out.left_p.push_back(LeftP(d, e.name));
  return out;
}

std::vector<Outcome> RunAll(const std::vector<Truth>& truths,
                            const std::function<std::vector<std::string>(const Truth&)>& without) {
  std::vector<Outcome> outcomes(truths.size());
  ParallelFor(static_cast<int>(truths.size()),
              static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
                const Truth& truth = truths[static_cast<std::size_t>(i)];
                Outcome& out = outcomes[static_cast<std::size_t>(i)];
                try {
                  out = RunSealed(truth, without ? without(truth) : std::vector<std::string>{});
                } catch (const std::exception& e) {
                  ADD_FAILURE() << NameOf(truth.law) << " seed " << truth.seed << ": " << e.what();
                  out.truth = truth;
                  out.refusal = e.what();
                }
              });
  return outcomes;
}

std::uint64_t NoiseSeed(Table table, int number) {
  return static_cast<std::uint64_t>(table) * 1'000'000 + static_cast<std::uint64_t>(number);
}

int EveryNth() { return IsQuick() ? 9 : 1; }

std::vector<Truth> PlantEach(Table table, double size, int seeds) {
  // Laws each effect can be planted under.
  std::vector<Truth> truths;
  const int number = static_cast<int>(1000 * size);
  int place = 0;
  for (const Effect* effect : AllEffects()) {
    if (place++ % EveryNth() != 0) continue;
    std::vector<const EffectCase*> laws;
    for (const EffectCase& e : AllEffectCases()) {
      if (e.effect == effect && !e.At(size).empty()) laws.push_back(&e);
    }
    // Streams by the effect's name: a new file in the catalogue leaves the others' draws alone.
    std::uint64_t name = 0;
    for (char c : effect->info.name) name = 131 * name + static_cast<unsigned char>(c);
    for (int i = 0; i < seeds && !laws.empty(); ++i) {
      RandomStream random(kSuiteSeed + static_cast<std::uint64_t>(table),
                          name * 1000 + static_cast<std::uint64_t>(number + i));
      // Every law comes up in turn, from one drawn for the effect.
      const EffectCase& e = *laws[(name + static_cast<std::size_t>(i)) % laws.size()];
      const auto directions = e.At(size);
      const auto pick = static_cast<std::size_t>(random.Uniform(0.0, 1.0) *
                                                 static_cast<double>(directions.size()));
      truths.push_back(
          {.law = e.law,
           .effects = {{std::string(effect->info.name), directions[pick]->Values(*effect, size)}},
           .size = size,
           .seed = NoiseSeed(table, static_cast<int>(random.Uniform(0.0, 1e6)))});
    }
  }
  return truths;
}

std::vector<Truth> PlantOwnSizes(double size, int seeds) {
  std::vector<Truth> truths = PlantEach(Table::kOwnSizes, size, seeds);
  std::erase_if(truths, [](Truth& t) {
    const EffectInfo& info = FindEffect(t.effects.front().name)->info;
    if (info.parameters.size() != 1 || info.has_threshold) return true;
    t.own_sizes = true;
    std::vector<std::string> notes;
    try {
      MakeDataset(t, &notes);
    } catch (const std::exception&) {
      return true;  // a size drawn is one that the effect cannot have
    }
    return !notes.empty();
  });
  return truths;
}

const EffectCase* CaseOf(Law law, std::string_view name) {
  for (const EffectCase& e : AllEffectCases()) {
    if (e.law == law && e.effect->info.name == name) return &e;
  }
  return nullptr;
}

std::string PairName(int pair) {
  const auto& [a, b] = kPairs[static_cast<std::size_t>(pair)];
  return std::string(a) + " + " + b;
}

namespace {

struct Wanted {
  const char* name;
  double size;
};

// Effects at their sizes under a drawn law that carries them all.
std::optional<Truth> PlantTogether(const std::vector<Wanted>& wanted, int number, double size) {
  RandomStream random(kSuiteSeed + static_cast<std::uint64_t>(Table::kTwoEffects),
                      static_cast<std::uint64_t>(number));
  const auto pick = [&](std::size_t n) {
    return static_cast<std::size_t>(random.Uniform(0.0, 1.0) * static_cast<double>(n));
  };
  for (int attempt = 0; attempt < 50; ++attempt) {
    Truth truth{.law = kAllLaws[pick(kAllLaws.size())], .size = size};
    for (const Wanted& w : wanted) {
      const EffectCase* e = CaseOf(truth.law, w.name);
      if (!e || e->At(w.size).empty()) break;
      const auto directions = e->At(w.size);
      truth.effects.push_back(
          {w.name, directions[pick(directions.size())]->Values(*e->effect, w.size)});
    }
    truth.seed = NoiseSeed(Table::kTwoEffects, static_cast<int>(random.Uniform(0.0, 1e6)));
    if (truth.effects.size() < wanted.size()) continue;
    std::vector<std::string> notes;
    MakeDataset(truth, &notes);
    if (notes.empty()) return truth;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Truth> PlantPair(int pair, int seed, double size) {
  const auto& names = kPairs[static_cast<std::size_t>(pair)];
  return PlantTogether({{names[0], size}, {names[1], size}}, 1000 * pair + seed, size);
}

std::vector<Truth> PlantPairs(double size, int seeds) {
  std::vector<Truth> truths;
  for (int pair = 0; pair < kPairCount; ++pair) {
    if (pair % EveryNth() != 0) continue;
    for (int seed = 0; seed < seeds; ++seed) {
      if (std::optional<Truth> truth = PlantPair(pair, seed, size)) truths.push_back(*truth);
    }
  }
  return truths;
}

std::vector<Truth> PlantTriples(double size, double third, int seeds) {
  std::vector<Truth> truths;
  for (int pair = 0; pair < kPairCount; ++pair) {
    if (pair % EveryNth() != 0) continue;
    for (int seed = 0; seed < seeds; ++seed) {
      const auto& names = kPairs[static_cast<std::size_t>(pair)];
      // The third comes from another pair with each seed.
      const auto& other = kPairs[static_cast<std::size_t>((pair + 3 + seed) % kPairCount)];
      const char* last = other[static_cast<std::size_t>(seed % 2)];
      if (std::string(last) == names[0] || std::string(last) == names[1]) continue;
      if (auto truth = PlantTogether({{names[0], size}, {names[1], size}, {last, third}},
                                     100'000 + 1000 * pair + seed, size))
        truths.push_back(*truth);
    }
  }
  return truths;
}

}  // namespace hoplab::testing
