#include "app/runs/run_settings.h"

#include <fmt/format.h>

#include <thread>

#include "app/terminal/help_text.h"

namespace hoplab {
namespace {

// "1e-9": C's exponents have two digits.
std::string PowerText(double value) {
  std::string text = fmt::format("{:g}", value);
  if (const std::size_t zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
  return text;
}

}  // namespace

void AddRunFolderOptions(CLI::App& sub, RunSettings& settings, const std::string& out,
                         const std::string& force) {
  sub.add_option("--out", settings.out, out)->option_text("DIR");
  sub.add_flag("--force", settings.force, force);
}

RunFolderOptions RunFolderOptionsOf(const RunSettings& settings) {
  RunFolderOptions options{std::nullopt, settings.force};
  if (!settings.out.empty()) options.out = settings.out;
  return options;
}

void AddSolverOptions(CLI::App& sub, SolverSettings& settings) {
  sub.add_option("--integrator", settings.integrator, "dop853 (default), erkstep or cvodes")
      ->check(OneOf({"dop853", "erkstep", "cvodes"}))
      ->option_text("NAME");
  sub.add_option("--tolerance", settings.tolerance,
                 "Relative tolerance of a step (default " + PowerText(settings.tolerance) + ")")
      ->check(NumberIn(1e-14, 1e-3))
      ->option_text("NUMBER");
}

IntegratorOptions IntegratorOptionsOf(const SolverSettings& settings) {
  return {*FindIntegrator(settings.integrator), settings.tolerance, 0.1 * settings.tolerance};
}

void AddJobsOption(CLI::App& sub, int& jobs, const std::string& remark) {
  sub.add_option("--jobs", jobs,
                 "Threads (default: all cores" + remark + "); never changes a result")
      ->check(CLI::Range(1, 1024))
      ->option_text("N");
}

int JobsOf(int jobs) {
  if (jobs > 0) return jobs;
  const unsigned cores = std::thread::hardware_concurrency();
  return cores > 0 ? static_cast<int>(cores) : 1;
}

void AddSeedOption(CLI::App& sub, std::uint64_t& seed, const std::string& of) {
  sub.add_option("--seed", seed, fmt::format("{} (default {})", of, seed))
      ->check(WholeNumber())
      ->option_text("N");
}

}  // namespace hoplab
