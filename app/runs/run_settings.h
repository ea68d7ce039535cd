#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "model/simulate.h"

namespace hoplab {

// Settings and options that commands share. A command's settings derive from RunSettings if it
// writes a run folder.

/// Where the outcome of a command goes.
struct RunFolderOptions {
  std::optional<std::filesystem::path> out;  // absent: runs/<name>-<command>-NNN, the next free one
  bool force = false;                        // replace a run that stands there
};

/// The same from the command line, and what is said.
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

/// `--jobs`, 0 for all cores; `remark` after the default.
void AddJobsOption(CLI::App& sub, int& jobs, const std::string& remark = "");
int JobsOf(int jobs);

/// `--seed`; `of` says what it is the seed of, as "Of the noise".
void AddSeedOption(CLI::App& sub, std::uint64_t& seed, const std::string& of);

}  // namespace hoplab
