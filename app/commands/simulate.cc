#include <fmt/format.h>

#include <chrono>
#include <ostream>

#include "app/records/simulation_record.h"
#include "app/records/solver_record.h"
#include "app/records/trajectory_tables.h"
#include "app/reports/run_folder.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "app/runs/sensitivity_direction.h"
#include "app/terminal/command.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"
#include "fitting/generate.h"
#include "fitting/model_of_spec.h"

namespace hoplab {
namespace {

constexpr double kTrajectoryRate = 1000.0;  // Hz

struct SimulateSettings : RunSettings {
  ScenarioSettings scenario;
  SolverSettings solver;
  std::vector<std::string> sensitivities;
};

// Nothing was simulated that could be looked at.
bool IsUseless(Outcome outcome) {
  return outcome == Outcome::kStartsInGround || outcome == Outcome::kIntegrationFailed ||
         outcome == Outcome::kStepLimit;
}

std::string Report(const Scenario& scenario, const SimulationRequest& request,
                   const Trajectory& run, bool colours) {
  using enum TextTable::Align;
  std::string text = Styled(scenario.name, Emphasis::kBold, colours) +
                     fmt::format("  law {}: {} at {} s, {} hop{}\n\n", NameOf(request.law),
                                 SentenceOf(run.outcome), Fixed(run.end_time, 4), run.hops,
                                 run.hops == 1 ? "" : "s");
  TextTable table({kRight, kLeft, kLeft, kRight, kRight, kRight, kRight, kRight});
  table.AddRow({"time s", "event", "to", "x m", "y m", "vx m/s", "vy m/s", "energy J"});
  const std::vector<std::pair<double, double>> energies = ApexEnergies(request, run);
  const auto row = [&](double time, std::string_view event, std::string_view to, double x, double y,
                       double vx, double vy, const std::string& energy) {
    table.AddRow({Fixed(time, 4), std::string(event), std::string(to), Fixed(x, 4), Fixed(y, 4),
                  Fixed(vx, 4), Fixed(vy, 4), energy});
  };
  const auto& s = request.initial;
  const auto energy = [&energies](std::size_t apex) {
    return apex < energies.size() ? Fixed(energies[apex].second, 6) : "";
  };
  const bool robot = request.law == Law::kRobot;
  row(0.0, "start", robot ? "" : "flight", s[0], s[1], s[2], s[3], energy(0));
  std::size_t apex = 1;
  for (const Event& e : run.events) {
    const bool is_apex = e.kind == EventKind::kApex;
    std::string name(NameOf(e.kind));
    if (robot && !is_apex) name += fmt::format(" {}", e.leg + 1);
    row(e.time, name, NameOf(e.mode_after), e.x, e.y, e.vx_after, e.vy_after,
        is_apex ? energy(apex++) : "");
  }
  if (run.final_state.size() >= 4) {
    const std::vector<double>& f = run.final_state;
    row(run.end_time, "end", NameOf(run.final_mode), f[0], f[1], f[2], f[3], "");
  }
  const std::vector<std::string> lines = table.Lines();
  text += Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  if (request.law == Law::kLargeDeflection && run.max_flexure > kMaxFlexure)
    text += fmt::format("  the leg bends to F C/l0 = {}; beyond {} this law is not to be trusted\n",
                        Significant(run.max_flexure, 2), kMaxFlexure);
  return text;
}

std::string SensitivityReport(const std::vector<std::string>& names, const Trajectory& run) {
  using enum TextTable::Align;
  TextTable table({kLeft, kRight, kRight, kRight, kRight});
  table.AddRow({"d end / d", "x", "y", "vx", "vy"});
  for (std::size_t d = 0; d < names.size(); ++d) {
    std::vector<std::string> cells = {names[d]};
    for (std::size_t i = 0; i < 4; ++i)
      cells.push_back(fmt::format("{:.6e}", run.final_sensitivities[i * names.size() + d]));
    table.AddRow(cells);
  }
  std::string text = "\n";
  for (const std::string& line : table.Lines()) text += line + "\n";
  return text;
}

Json NewSimulationRecord(const SimulateSettings& settings, const Scenario& scenario, Law law) {
  RecordHeader header;
  header.command = "simulate";
  header.law = std::string(NameOf(law));
  header.variant = scenario.mechanism.variant;
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with},
                    {"sensitivities", settings.sensitivities}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = scenario.name;
  return record;
}

ExitCode RunSimulate(const SimulateSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  const Scenario scenario = ReadScenarioOf(settings.scenario);
  const RunFolder folder(RunFolderOptionsOf(settings), scenario.name, "simulate");
  const MechanismKind mechanism = MechanismOfSpec(scenario.mechanism);
  const Law law = ResolveLaw(scenario.law.value_or(""), mechanism, scenario.law_origin.place);
  const std::vector<DrivenInput> inputs = DrivenInputsOf(scenario);
  const std::vector<EffectSetting> effects =
      ResolveEffects(scenario.effects, law, LegMassOfSpec(scenario.mechanism), KindsOf(inputs),
                     RobotLegsOfSpec(scenario.mechanism));
  SimulationRequest request = RequestOfScenario(scenario, effects, inputs);
  request.integrator = IntegratorOptionsOf(settings.solver);
  std::vector<SensitivityDirection> directions;
  for (const std::string& name : settings.sensitivities)
    directions.push_back(
        ResolveDirection(name, mechanism, LegMassOfSpec(scenario.mechanism), effects));
  request.directions = directions;
  const Trajectory run = Simulate(request);
  CheckAngleEach(scenario.touchdown_angles_rad, run, scenario.origin.place);

  Json record = NewSimulationRecord(settings, scenario, request.law);
  AddSimulation(request, run, settings.sensitivities, record);
  record["mechanism"] = MechanismRecord(request);
  const bool useless = IsUseless(run.outcome);
  if (useless) SetFailed(record, std::string(SentenceOf(run.outcome)));
  const int legs = RobotLegsOf(request.parameters);
  CsvText trajectory(TrajectoryHeader({}, legs)), events(EventHeader({}, legs));
  AddTrajectoryRows(request, kTrajectoryRate, {}, 0.0, trajectory);
  AddEventRows(run, {}, 0.0, events, legs);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  const std::filesystem::path written = folder.Write({{"run.json", TextOf(record)},
                                                      {"trajectory.csv", trajectory.text()},
                                                      {"events.csv", events.text()}});
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << Report(scenario, request, run, console.out_colours);
    if (!directions.empty()) console.out << SensitivityReport(settings.sensitivities, run);
    console.out << "\n  run folder  " << written.string() << '\n';
  }
  if (useless) console.err << "hoplab simulate: " << SentenceOf(run.outcome) << '\n';
  return useless ? ExitCode::kNoResult : ExitCode::kDone;
}

void AddSimulate(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<SimulateSettings>();
  AddScenarioOptions(sub, settings->scenario);
  AddSolverOptions(sub, settings->solver);
  sub.add_option("--sensitivities", settings->sensitivities,
                 "Derivatives of the end and of event times, as E,d,x0,air_drag.c_drag")
      ->delimiter(',')
      ->option_text("NAME,...")
      ->allow_extra_args(false);
  AddRunFolderOptions(sub, *settings, "Run folder (default runs/<scenario>-simulate-NNN)");
  OnParsed(sub, invocation, settings, RunSimulate);
}

}  // namespace

namespace commands {
extern constexpr Command simulate = {
    .place = 130,
    .name = "simulate",
    .what = "Run a scenario: events, energy, trajectory",
    .footer =
        "Examples:\n"
        "  hoplab simulate experiments/controlled-hopping.yaml\n"
        "  hoplab simulate hopping.yaml --set controller.kp_N_s=4 --law consistent\n"
        "  hoplab simulate hopping.yaml --sensitivities E,d --json",
    .add = AddSimulate};
}  // namespace commands
}  // namespace hoplab
