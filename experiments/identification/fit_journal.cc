#include "experiments/identification/fit_journal.h"

#include <utility>

#include "experiments/fingerprint.h"

namespace hoplab {
namespace {

constexpr char kSeparator = '\t';

std::string HeaderOf(const UnitContext& context, const std::string& version) {
  Fingerprint hash;
  for (const EnergyCell& c : context.data.energy) {
    for (const double value : {c.touchdown_angle_rad, c.damping_N_s_per_m, c.percent})
      hash.Add(value);
  }
  for (const ModulusRow& r : context.data.modulus) {
    for (const double value : {r.modulus_Pa, r.damping_N_s_per_m, r.convergence_time_s,
                               r.k_min_N_per_m, r.k_max_N_per_m})
      hash.Add(value);
  }
  for (const StartCell& c : context.data.initial_states) {
    for (const double value :
         {c.speed_m_per_s, c.height_m, c.damping_N_s_per_m, c.convergence_time_s})
      hash.Add(value);
  }
  for (const ConvergenceReading& reading : context.convergence) hash.Add(NameOf(reading));
  hash.Add(NameOf(context.integrator.kind));
  hash.Add(context.integrator.relative_tolerance);
  hash.Add(context.integrator.absolute_tolerance);
  return "hoplab-study-fits/1 " + version + " " + hash.Text();
}

}  // namespace

FitJournal::FitJournal(std::filesystem::path file, const UnitContext& context,
                       const std::string& version, bool discard)
    : lines_(std::move(file), HeaderOf(context, version), discard,
             {"identification",
              "holds fits to other tables, with other tolerances or of another version of hoplab",
              "Finish that identification, remove the file, give another --out, or --force."},
             [this](std::string_view line) { Keep(line); }) {}

void FitJournal::Keep(std::string_view line) {
  const std::size_t at = line.find(kSeparator);
  if (at == line.npos) return;
  const std::optional<StudyUnit> unit = UnitOfText(line.substr(0, at));
  const std::optional<StudyFit> fit = FitOfText(line.substr(at + 1));
  if (unit && fit) fits_.insert_or_assign(std::string(line.substr(0, at)), *fit);
}

std::optional<StudyFit> FitJournal::Find(const StudyUnit& unit) const {
  const auto found = fits_.find(TextOf(unit));
  if (found == fits_.end()) return std::nullopt;
  return found->second;
}

void FitJournal::Add(const StudyUnit& unit, const StudyFit& fit) {
  const std::string line = TextOf(unit) + kSeparator + TextOf(fit);
  lines_.Add(line);
  Keep(line);
}

}  // namespace hoplab
