// How the cost of a fit and of a diagnosis grows with the data: copies of datasets/rig-drops under
// other file names. What is timed are the commands as a user gives them, reading and writing
// included.
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "datasets/read_dataset.h"
#include "datasets/write_dataset.h"

namespace hoplab::bench {
namespace {

namespace fs = std::filesystem;

struct Cost {
  double wall_s = 0.0, cpu_s = 0.0, memory_mb = 0.0;
  double modulus = 0.0;  // Pa, to see that the work was done
};

// A dataset of so many trials in `folder`.
void WriteCopies(int trials, const fs::path& folder) {
  const Dataset once = ReadDataset(HOPLAB_SOURCE_DIR "/datasets/rig-drops");
  Dataset all = once;
  for (int copy = 1; static_cast<int>(all.trials.size()) < trials; ++copy) {
    for (Trial t : once.trials) {
      t.file = "copy-" + std::to_string(copy) + "-" + t.file;
      all.trials.push_back(std::move(t));
    }
  }
  WriteDataset(all, folder, {});
}

double ModulusIn(const fs::path& run) {
  std::ifstream file(run / "run.json");
  const nlohmann::json record = nlohmann::json::parse(file);
  const char* of = record.contains("parameters")      ? "parameters"
                   : record.at("extension").is_null() ? "/null/parameters"
                                                      : "/extension/parameters";
  const nlohmann::json& parameters =
      of[0] == '/' ? record.at(nlohmann::json::json_pointer(of)) : record.at(of);
  for (const nlohmann::json& p : parameters)
    if (p.at("name") == "E") return p.at("value");
  return std::nan("");
}

// A command of the program, in a process of its own; nothing if it failed.
std::optional<Cost> Measured(const std::string& what, const fs::path& dataset,
                             const std::string& law, const fs::path& run) {
  const std::vector<std::string> words = {
      HOPLAB_BINARY, what, dataset.string(), "--law",      law,
      "--jobs",      "2",  "--out",          run.string(), "--quiet"};
  std::vector<char*> arguments;
  for (const std::string& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
  arguments.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stdout) != nullptr) execv(HOPLAB_BINARY, arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0) return std::nullopt;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  Cost cost;
  cost.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  cost.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  cost.memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  cost.modulus = ModulusIn(run);
  return cost;
}

// Of the last size against the first of at least 60 trials: below that fixed costs weigh.
void PrintExponents(const std::string& what, const std::vector<int>& trials,
                    const std::vector<Cost>& costs) {
  std::size_t first = 0;
  while (first + 1 < costs.size() && trials[first] < 60) ++first;
  if (first + 1 >= costs.size()) return;
  const double size = std::log(static_cast<double>(trials[costs.size() - 1]) / trials[first]);
  fmt::print("{}: from {} to {} trials CPU time grows with exponent {:.2f}, memory with {:.2f}\n",
             what, trials[first], trials[costs.size() - 1],
             std::log(costs.back().cpu_s / costs[first].cpu_s) / size,
             std::log(costs.back().memory_mb / costs[first].memory_mb) / size);
}

int Main(int argc, char** argv) {
  CLI::App app{"How the cost of a fit and of a diagnosis grows with the number of trials"};
  std::vector<int> trials = {6, 60, 180, 600};
  std::string law = "elastica";
  bool fit_only = false;
  app.add_option("--trials", trials, "numbers of trials, multiples of 6")->delimiter(',');
  app.add_option("--law", law, "the leg's law");
  app.add_flag("--fit", fit_only, "no diagnosis");
  CLI11_PARSE(app, argc, argv);
  fmt::print("{:<10} {:>6} {:>9} {:>9} {:>10} {:>9}\n", "command", "trials", "wall s", "CPU s",
             "memory MB", "E GPa");
  const fs::path scratch =
      fs::temp_directory_path() / ("hoplab-scaling-" + std::to_string(getpid()));
  fs::create_directories(scratch);
  bool failed = false;
  for (const bool diagnose : {false, true}) {
    if (diagnose && fit_only) continue;
    const std::string what = diagnose ? "diagnose" : "fit";
    std::vector<Cost> costs;
    for (const int n : trials) {
      const fs::path dataset = scratch / ("trials-" + std::to_string(n));
      if (!fs::exists(dataset)) WriteCopies(n, dataset);
      const std::optional<Cost> cost =
          Measured(what, dataset, law, scratch / (what + "-" + std::to_string(n)));
      if (!cost) {
        fmt::print("{:<10} {:>6} did not end\n", what, n);
        failed = true;
        break;
      }
      fmt::print("{:<10} {:>6} {:>9.2f} {:>9.2f} {:>10.0f} {:>9.3f}\n", what, n, cost->wall_s,
                 cost->cpu_s, cost->memory_mb, 1e-9 * cost->modulus);
      std::fflush(stdout);
      costs.push_back(*cost);
    }
    PrintExponents(what, trials, costs);
  }
  fs::remove_all(scratch);
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace hoplab::bench

int main(int argc, char** argv) {
  try {
    return hoplab::bench::Main(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "hoplab_scaling: {}\n", e.what());
    return 70;
  }
}
