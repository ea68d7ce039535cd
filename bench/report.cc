#include "bench/report.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

namespace hoplab::bench {
namespace {

using Cells = std::vector<std::string>;

std::string CpuKind() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

std::string Microseconds(double seconds) {
  const double us = 1e6 * seconds;
  return us < 100.0 ? fmt::format("{:.1f}", us) : fmt::format("{:.0f}", us);
}
std::string CallsOf(long count) { return count == 0 ? "" : std::to_string(count); }

// The tables, as cells; the first row is the head.
std::vector<Cells> StanceCells(const Report& report) {
  std::vector<Cells> out = {
      {"law", "solver", "min us", "median us", "RHS calls", "guard calls", "lift-off error [s]"}};
  for (const StanceRow& r : report.stances) {
    std::string error = fmt::format("{:.1e}", std::abs(r.liftoff_error));
    if (r.own_event_error != r.liftoff_error)
      error += fmt::format(" (its own event: {:.1e})", std::abs(r.own_event_error));
    out.push_back({r.law, r.solver, Microseconds(r.timing.Min()), Microseconds(r.timing.Median()),
                   CallsOf(r.rhs_calls), CallsOf(r.guard_calls), error});
  }
  return out;
}
std::vector<Cells> SimulationCells(const Report& report) {
  std::vector<Cells> out = {{"law", "run", "solver", "sensitivities", "min us", "median us"}};
  for (const SimulationRow& r : report.simulations) {
    out.push_back({r.law, r.what, r.solver, std::to_string(r.directions),
                   Microseconds(r.timing.Min()), Microseconds(r.timing.Median())});
  }
  return out;
}
std::vector<Cells> BoundCells(const Report& report) {
  std::vector<Cells> out = {{"claim", "measured", "bound", ""}};
  for (const BoundRow& b : report.bounds) {
    out.push_back({b.claim, fmt::format("{:.3g} {}", b.value, b.unit),
                   fmt::format("{} {:g} {}", b.at_most ? "<=" : ">=", b.bound, b.unit),
                   b.met() ? "met" : "NOT met"});
  }
  return out;
}

std::string Aligned(const std::vector<Cells>& rows) {
  std::vector<std::size_t> width(rows[0].size(), 0);
  for (const Cells& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  }
  std::string out;
  for (const Cells& row : rows) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c) line += fmt::format(" {:{}} ", row[c], width[c]);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}
std::string Piped(const std::vector<Cells>& rows) {
  std::string out;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    out += "|";
    for (const std::string& cell : rows[r]) out += " " + cell + " |";
    out += "\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < rows[0].size(); ++c) out += "|---";
    out += "|\n";
  }
  return out;
}

std::string Sections(const Report& report, std::string (*table)(const std::vector<Cells>&),
                     const std::string& mark) {
  std::string out = fmt::format(
      "{}, {} ({} threads), {}, {}. Best and median of {} rounds in turn; ratios of the best.\n\n",
      report.date, report.cpu, report.threads, report.compiler, report.build, report.rounds);
  out += mark + "One stance from touch-down to lift-off, relative tolerance 1e-9\n\n";
  out += table(StanceCells(report)) + "\n";
  out += mark + "Our simulations and their sensitivities\n\n";
  out += table(SimulationCells(report)) + "\n";
  out += mark + "Claims\n\n" + table(BoundCells(report));
  if (!report.notes.empty()) out += "\n";
  for (const std::string& note : report.notes) out += "- " + note + "\n";
  return out;
}

nlohmann::json TimingJson(const Timing& t) {
  return {{"min_s", t.Min()}, {"median_s", t.Median()}, {"samples", t.seconds.size()}};
}

}  // namespace

Report NewReport() {
  Report report;
  report.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
  report.cpu = CpuKind();
  report.threads = static_cast<int>(std::thread::hardware_concurrency());
#if defined(__clang__)
  report.compiler = "Clang " __clang_version__;
#else
  report.compiler = "GCC " __VERSION__;
#endif
  report.build = HOPLAB_BUILD_TYPE;
  return report;
}

std::string AsText(const Report& report) { return Sections(report, Aligned, ""); }
std::string AsMarkdown(const Report& report) { return Sections(report, Piped, "### "); }

nlohmann::json AsJson(const Report& report) {
  nlohmann::json out = {{"date", report.date},
                        {"machine", {{"cpu", report.cpu}, {"threads", report.threads}}},
                        {"compiler", report.compiler},
                        {"build", report.build},
                        {"rounds", report.rounds},
                        {"fit", TimingJson(report.fit)},
                        {"notes", report.notes}};
  for (const StanceRow& r : report.stances) {
    out["stances"].push_back({{"law", r.law},
                              {"solver", r.solver},
                              {"time", TimingJson(r.timing)},
                              {"rhs_calls", r.rhs_calls},
                              {"guard_calls", r.guard_calls},
                              {"liftoff_error_s", r.liftoff_error},
                              {"own_event_error_s", r.own_event_error}});
  }
  for (const SimulationRow& r : report.simulations) {
    out["simulations"].push_back({{"law", r.law},
                                  {"run", r.what},
                                  {"solver", r.solver},
                                  {"sensitivities", r.directions},
                                  {"time", TimingJson(r.timing)}});
  }
  for (const BoundRow& b : report.bounds) {
    out["bounds"].push_back({{"claim", b.claim},
                             {"value", b.value},
                             {"bound", b.bound},
                             {"kind", b.at_most ? "at most" : "at least"},
                             {"unit", b.unit},
                             {"met", b.met()}});
  }
  return out;
}

}  // namespace hoplab::bench
