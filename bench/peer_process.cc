#include "bench/peer_process.h"

#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/problems.h"

namespace hoplab::bench {
namespace {

// Standard output of a shell command; nothing if it fails.
std::optional<std::string> OutputOf(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  if (pclose(pipe) != 0) return std::nullopt;
  return text;
}

std::string Quoted(const std::string& word) { return "'" + word + "'"; }

std::string ProblemText(Law law) {
  const Parameters<double> p = LegParameters(law);
  nlohmann::json parameters = {{"m", p.m}, {"g", p.g}, {"d", p.d}, {"theta_td", p.theta_td}};
  if (law == Law::kStraightLeg) {
    parameters.update({{"k", p.k}, {"l0", p.l0}});
  } else {
    parameters.update(
        {{"r", p.r}, {"E", p.E}, {"G", p.G}, {"I", p.I}, {"A", p.A}, {"kappa", p.kappa}});
  }
  const IntegratorOptions tolerances;
  return nlohmann::json{{"law", std::string(NameOf(law))},
                        {"state", TouchdownState(law)},
                        {"parameters", parameters},
                        {"relative_tolerance", tolerances.relative_tolerance},
                        {"absolute_tolerance", tolerances.absolute_tolerance}}
      .dump();
}

constexpr const char* kPeers = HOPLAB_SOURCE_DIR "/bench/peers/";

}  // namespace

PeerProgram FindScipy() {
  PeerProgram peer{"scipy solve_ivp DOP853", "", std::string(kPeers) + "scipy_stance.py"};
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    if (!OutputOf(std::string(python) + " -c 'import scipy.integrate'")) continue;
    peer.interpreter = python;
    break;
  }
  return peer;
}

PeerProgram FindOctave() {
  PeerProgram peer{"Octave ode45", "", std::string(kPeers) + "octave_stance.m"};
  if (OutputOf("octave-cli --version")) peer.interpreter = "octave-cli --quiet --norc";
  return peer;
}

void RunPeer(const PeerProgram& peer, Law law, int repetitions,
             const std::filesystem::path& scratch_folder, PeerRun& run) {
  const std::filesystem::path problem = scratch_folder / (std::string(NameOf(law)) + ".json");
  std::ofstream(problem) << ProblemText(law);
  const std::optional<std::string> text =
      OutputOf(peer.interpreter + " " + Quoted(peer.script) + " " + Quoted(problem.string()) + " " +
               std::to_string(repetitions));
  const nlohmann::json answer = nlohmann::json::parse(text.value_or(""), nullptr, false);
  run.ran = answer.is_object();
  if (!run.ran) return;
  run.version = answer.at("version");
  run.liftoff_time = answer.at("liftoff_time_s");
  run.own_liftoff_time = answer.value("own_liftoff_time_s", run.liftoff_time);
  run.rhs_calls = answer.at("rhs_calls");
  for (const double s : answer.at("seconds")) run.timing.seconds.push_back(s);
}

}  // namespace hoplab::bench
