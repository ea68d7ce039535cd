#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "app/run_folder.h"
#include "model/simulate.h"

namespace hoplab {

// Settings and options that commands share. A command's settings derive from RunSettings if it
// writes a run folder.

/// Where the outcome goes, and what is said.
struct RunSettings {
  std::string out;  // empty: the next free folder
  bool force = false, json = false, quiet = false;
};

/// `--out` and `--force`; `--json` and `--quiet` are added for every command. `out` and `force`
/// describe the two where a command has more to say of them.
void AddRunFolderOptions(
    CLI::App& sub, RunSettings& settings, const std::string& out,
    const std::string& force = "Replace the run that stands in the run folder");
RunFolderOptions RunFolderOptionsOf(const RunSettings& settings);

/// How motions are integrated.
struct SolverSettings {
  std::string integrator = "dop853";
  double tolerance = 1e-9;  // relative, of a step
};

/// `--integrator` and `--tolerance`; what `settings` holds is told as the default.
void AddSolverOptions(CLI::App& sub, SolverSettings& settings);
IntegratorOptions IntegratorOptionsOf(const SolverSettings& settings);
/// What a record's options say of it.
void RecordSolver(const SolverSettings& settings, Json& options);

/// `--jobs`, 0 for all cores; `remark` after the default.
void AddJobsOption(CLI::App& sub, int& jobs, const std::string& remark = "");
int JobsOf(int jobs);

/// `--seed`; `of` says what it is the seed of, as "Of the noise".
void AddSeedOption(CLI::App& sub, std::uint64_t& seed, const std::string& of);

}  // namespace hoplab
