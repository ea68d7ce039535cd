// hoplab against its peers on the same stance, and against its own bounds. One command prints it
// all: build/release/bench/hoplab_compare.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "base/atomic_file.h"
#include "bench/counted_calls.h"
#include "bench/odeint_stance.h"
#include "bench/peer_process.h"
#include "bench/problems.h"
#include "bench/report.h"
#include "bench/rig_fit.h"
#include "bench/robot_comparison.h"
#include "bench/study_cell.h"
#include "model/mechanisms/leg.h"
#include "tests/support/formulas.h"

namespace hoplab::bench {
namespace {

/// Lift-off times of two solvers of one problem differ by less than this [s]: what a dozen steps at
/// a relative tolerance of 1e-9 may add up to, the state being of size one.
constexpr double kAgreement = 1e-8;
/// Bounds of the smoke test: far enough off that no load of the machine reaches them.
constexpr double kSmokeOdeintRatio = 3.0;

struct Size {
  int laps;  // peers of their own process run once a lap
  int rounds_per_lap;
  int peer_repetitions;  // in each process
  double batch_s;
};
constexpr Size kFull = {3, 20, 5, 2e-3};
constexpr Size kQuick = {1, 3, 1, 2e-4};

class Comparison {
 public:
  explicit Comparison(const Size& size)
      : size_(size),
        timer_(size.batch_s),
        report_(NewReport()),
        scratch_(std::filesystem::temp_directory_path() /
                 ("hoplab-bench-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(scratch_);
  }
  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;
  ~Comparison() {
    std::error_code ignored;
    std::filesystem::remove_all(scratch_, ignored);
  }

  Report Run() {
    AddProblems();
    AddSimulations();
    AddFormulas();
    robot_ = std::make_unique<RobotComparison>(timer_);
    fit_ = timer_.Add("fit", [this] { fit_ok_ = fit_ok_ && FitRigDrops().ok; });
    cell_ = timer_.Add("cell", [this] { cell_ok_ = cell_ok_ && RunStudyCell(); });
    const std::vector<PeerProgram> programs = {FindScipy(), FindOctave()};
    for (const PeerProgram& p : programs) {
      if (p.interpreter.empty()) Note("Left out, not installed: " + p.name + ".");
    }
    for (int lap = 0; lap < size_.laps; ++lap) {
      for (int round = 0; round < size_.rounds_per_lap; ++round) timer_.Round();
      robot_->Lap();
      for (const PeerProgram& p : programs) {
        if (p.interpreter.empty()) continue;
        for (Problem& problem : problems_)
          RunPeer(p, problem.law, size_.peer_repetitions, scratch_, problem.programs[p.name]);
      }
    }
    report_.rounds = size_.laps * size_.rounds_per_lap;
    Collect();
    return report_;
  }
  /// Something did not run, or two solvers of one problem disagreed.
  bool failed() const { return failed_; }

 private:
  // One stance, its exact lift-off, who solved it.
  struct Problem {
    Law law;
    double reference = 0.0;  // lift-off [s], by another integrator at 1e-13
    double ours = 0.0;
    CallCounts calls;
    PeerStance odeint;
    int our_timing = 0, odeint_timing = 0;
    std::map<std::string, PeerRun> programs;
  };
  struct FormulaPair {
    std::string effect;
    int code, formula;
  };
  struct Simulation {
    SimulationRow row;
    int timing;
  };

  void AddProblems() {
    problems_.push_back(MakeProblem(Law::kLargeDeflection));
    problems_.push_back(MakeProblem(Law::kStraightLeg));
  }

  Problem MakeProblem(Law law) {
    Problem problem{law};
    const SimulationRequest request = StanceRequest(law);
    SimulationRequest strict = request;
    strict.integrator = {IntegratorKind::kErkStep, 1e-13, 1e-15};
    problem.reference = LiftoffTime(Simulate(strict));
    problem.ours = LiftoffTime(Simulate(request));
    problem.calls = CountCalls(request);
    problem.our_timing = AddRun(request);
    const auto mechanism = std::make_shared<SystemStorage<double>>();
    LegLawOf(law).body.Make<double>({law, LegParameters(law), {}, {}}, *mechanism);
    const std::array<double, 4> body = TouchdownState(law);
    problem.odeint = OdeintStance(**mechanism, body, IntegratorOptions{});
    problem.odeint_timing = timer_.Add(
        "odeint", [mechanism, body] { OdeintStance(**mechanism, body, IntegratorOptions{}); });
    return problem;
  }

  // The trajectory is kept from call to call, as a fit keeps it.
  int AddRun(const SimulationRequest& request) {
    const auto out = std::make_shared<Trajectory>();
    const int timing = timer_.Add("run", [request, out] { Simulate(request, *out); });
    if (out->outcome != Outcome::kHopLimit)
      Fail(fmt::format("A benchmark did not run: {}", SentenceOf(out->outcome)));
    return timing;
  }

  void AddSimulation(const std::string& what, const SimulationRequest& request) {
    simulations_.push_back({{std::string(NameOf(request.law)),
                             std::string(NameOf(request.integrator.kind)),
                             what,
                             static_cast<int>(request.directions.size()),
                             {}},
                            AddRun(request)});
  }

  void AddSimulations() {
    for (const Law law : {Law::kLargeDeflection, Law::kConsistent}) {
      for (const int n : {0, 4, 16}) AddSimulation("one stance", StanceRequest(law, n));
      for (const int n : {0, 4, 16}) AddSimulation("one hop", HopRequest(law, n));
      for (const int n : {0, 4, 16}) AddSimulation("ten hops", TenHopRequest(law, n));
    }
    for (const IntegratorKind kind : {IntegratorKind::kErkStep, IntegratorKind::kCvodes}) {
      for (const int n : {0, 4, 16}) {
        SimulationRequest request = StanceRequest(Law::kLargeDeflection, n);
        request.integrator.kind = kind;
        AddSimulation("one stance", request);
      }
    }
  }

  // Effects of the catalogue, and the same written as formulas.
  void AddFormulas() {
    const Law law = Law::kLargeDeflection;
    const Parameters<double> leg = LegParameters(law);
    for (const testing::WrittenEffect& e : testing::WrittenEffects(leg.m * leg.g)) {
      const Effect& compiled = *FindEffect(e.catalogue);
      if (!AppliesTo(compiled, law) || !testing::IsWrittenUnder(e.catalogue, law)) continue;
      const auto timed = [&](const Effect& effect) {
        effects_.push_back(std::make_unique<EffectSetting>(EffectSetting::Null(effect)));
        effects_.back()->values[0] = compiled.info.parameters[0].typical;
        SimulationRequest request = HopRequest(law, 4);
        request.effects = {effects_.back().get(), 1};
        return AddRun(request);
      };
      const int as_code = timed(compiled);
      formulas_.push_back({e.catalogue, as_code, timed(FormulaEffect(e.formula))});
    }
  }

  void CollectFormulas() {
    double worst = 0.0;
    std::string which;
    for (const FormulaPair& f : formulas_) {
      const double ratio = timer_.timing(f.formula).Min() / timer_.timing(f.code).Min();
      Note(fmt::format("One hop with 4 sensitivities, {} as a formula / compiled: {:.2f} x.",
                       f.effect, ratio));
      if (ratio > worst) which = f.effect;
      worst = std::max(worst, ratio);
    }
    AddBound(fmt::format("formula / compiled, worst of {} effects ({})", formulas_.size(), which),
             worst, 2.0, true, "x");
  }

  void Collect() {
    CollectFormulas();
    for (const Problem& problem : problems_) CollectProblem(problem);
    for (const Simulation& s : simulations_) {
      report_.simulations.push_back(s.row);
      report_.simulations.back().timing = timer_.timing(s.timing);
    }
    failed_ = !robot_->Collect(report_) || failed_;
    for (const Law law : {Law::kLargeDeflection, Law::kConsistent}) {
      AddBound(fmt::format("stance with 4 sensitivities / without, {}", NameOf(law)),
               StanceTime(law, 4) / StanceTime(law, 0), 3.0, true, "x");
    }
    report_.fit = timer_.timing(fit_);
    AddBound("fit of rig-drops, one start, E and d", report_.fit.Median(), 2.0, true, "s");
    AddBound("a cell of table 6.1, 15 s of hopping", 1e3 * timer_.timing(cell_).Median(), 10.0,
             true, "ms");
    if (!fit_ok_) Fail("The fit of rig-drops did not end at an optimum.");
    if (!cell_ok_) Fail("A cell of table 6.1 did not hop for its 15 s.");
  }

  void CollectProblem(const Problem& problem) {
    const std::string law(NameOf(problem.law));
    const Timing& ours = timer_.timing(problem.our_timing);
    const Timing& odeint = timer_.timing(problem.odeint_timing);
    const double our_error = problem.ours - problem.reference;
    report_.stances.push_back({law, "hoplab dop853", ours, problem.calls.derivatives,
                               problem.calls.guards, our_error, our_error});
    const double odeint_error = problem.odeint.liftoff_time - problem.reference;
    if (Agrees(law, "Boost.Odeint", problem.odeint.liftoff_time, problem.ours)) {
      report_.stances.push_back({law, "Boost.Odeint dopri5, dense output", odeint,
                                 problem.odeint.rhs_calls, problem.odeint.guard_calls, odeint_error,
                                 odeint_error});
      AddBound("stance, hoplab / Boost.Odeint, " + law, ours.Min() / odeint.Min(), 1.0, true, "x");
    }
    for (const auto& [name, run] : problem.programs) {
      if (!run.ran) {
        Fail(name + " is installed, but its script did not run.");
        continue;
      }
      if (!Agrees(law, name, run.liftoff_time, problem.ours)) continue;
      report_.stances.push_back({law, name + " (" + run.version + ")", run.timing, run.rhs_calls, 0,
                                 run.liftoff_time - problem.reference,
                                 run.own_liftoff_time - problem.reference});
      const double ratio = run.timing.Min() / ours.Min();
      if (name.starts_with("scipy")) {
        AddBound("stance, " + name + " / hoplab, " + law, ratio, 50.0, false, "x");
      } else {
        Note(fmt::format("Stance, {} / hoplab, {}: {:.0f} x.", name, law, ratio));
      }
    }
  }

  double StanceTime(Law law, int directions) const {
    for (const Simulation& s : simulations_) {
      if (s.row.what == "one stance" && s.row.law == NameOf(law) &&
          s.row.solver == NameOf(IntegratorKind::kDop853) && s.row.directions == directions)
        return timer_.timing(s.timing).Min();
    }
    return std::nan("");
  }

  // Whether a peer solved the same problem; a comparison with one that did not is not shown.
  bool Agrees(const std::string& law, const std::string& peer, double theirs, double ours) {
    const double difference = std::abs(theirs - ours);
    const std::string text =
        fmt::format("{}, {}: lift-off times differ by {:.1e} s", law, peer, difference);
    if (difference < kAgreement) {
      Note(text + ".");
      return true;
    }
    Fail(text + fmt::format(", more than {:g} s: not compared.", kAgreement));
    return false;
  }
  void AddBound(std::string claim, double value, double bound, bool at_most, std::string unit) {
    report_.bounds.push_back({std::move(claim), value, bound, at_most, std::move(unit)});
  }
  void Note(std::string text) { report_.notes.push_back(std::move(text)); }
  void Fail(std::string text) {
    failed_ = true;
    Note("FAILED: " + std::move(text));
  }

  Size size_;
  RoundRobin timer_;
  Report report_;
  std::filesystem::path scratch_;
  std::vector<Problem> problems_;
  std::vector<Simulation> simulations_;
  std::vector<std::unique_ptr<EffectSetting>> effects_;  // what requests point at
  std::vector<FormulaPair> formulas_;
  std::unique_ptr<RobotComparison> robot_;
  int fit_ = 0, cell_ = 0;
  bool fit_ok_ = true, cell_ok_ = true, failed_ = false;
};

/// Puts `text` between the two marker lines of `file`.
void ReplaceResults(const std::filesystem::path& file, const std::string& text) {
  const std::string begin = "<!-- results: begin -->\n", end = "<!-- results: end -->";
  std::ifstream in(file);
  std::ostringstream whole;
  whole << in.rdbuf();
  std::string content = whole.str();
  const std::size_t from = content.find(begin), to = content.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from)
    throw std::runtime_error(file.string() + " has no lines " + begin + end);
  content.replace(from + begin.size(), to - from - begin.size(), "\n" + text + "\n");
  WriteFileAtomically(file, content, {.force = true});
}

int Main(int argc, char** argv) {
  CLI::App app{"hoplab against its peers on the same stance, and against its own bounds"};
  bool quick = false, markdown = false;
  std::string json_file, readme;
  app.add_flag("--quick", quick, "few repetitions: shows that everything runs and agrees");
  app.add_flag("--markdown", markdown, "print the tables as Markdown");
  app.add_option("--json", json_file, "also write everything to this file");
  app.add_option("--readme", readme, "also put the tables between the result lines of this file");
  CLI11_PARSE(app, argc, argv);

  Comparison comparison(quick ? kQuick : kFull);
  const Report report = comparison.Run();
  fmt::print("{}", markdown ? AsMarkdown(report) : AsText(report));
  if (!json_file.empty())
    WriteFileAtomically(json_file, AsJson(report).dump(2) + "\n", {.force = true});
  if (!readme.empty()) ReplaceResults(readme, AsMarkdown(report));
  if (comparison.failed()) return 1;
  if (!quick) return 0;
  for (const BoundRow& b : report.bounds) {
    if (b.claim.find("Odeint") != std::string::npos && !(b.value < kSmokeOdeintRatio)) {
      fmt::print("A stance takes {:.1f} x the time of Odeint's.\n", b.value);
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace hoplab::bench

int main(int argc, char** argv) {
  try {
    return hoplab::bench::Main(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "hoplab_compare: {}\n", e.what());
    return 70;
  }
}
