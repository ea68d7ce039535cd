#include "app/reports/exclusion_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/records/diagnosis_words.h"
#include "app/terminal/report_text.h"
#include "base/text.h"

namespace hoplab {
namespace {

// What is listed for a reader; the rest stands in the CSVs.
constexpr std::size_t kMostListed = 12;

std::string Capped(std::vector<std::string> items) {
  if (items.size() <= kMostListed) return Join(items);
  const std::size_t more = items.size() - kMostListed;
  items.resize(kMostListed);
  return Join(items) + fmt::format(" and {} more (candidates.csv)", more);
}

// The bound of each parameter: "air_drag 0.012 N s^2/m^2"; empty where none could be told.
std::string BoundText(const CandidateResult& c) {
  std::vector<std::string> parts;
  for (int k = 0;
       k < std::min<int>(c.candidate.parameter_count(), static_cast<int>(c.bound95.size())); ++k) {
    if (c.candidate.Parameter(k).is_of_first) continue;
    if (!std::isfinite(c.bound95[k])) return "";
    parts.push_back(SizeText(c.bound95[k], std::string(c.candidate.Parameter(k).unit)));
  }
  return parts.empty() ? "" : c.candidate.Name() + " " + Join(parts, " and ");
}

// The bound in typical sizes, the loosest of its parameters.
double RelativeBound(const CandidateResult& c) {
  double most = 0.0;
  for (int k = 0; k < static_cast<int>(c.bound95.size()); ++k)
    most = std::max(most, c.bound95[k] / std::abs(c.candidate.Parameter(k).typical));
  return most;
}

bool IsSetAside(const Diagnosis& d, const Candidate& candidate) {
  return std::any_of(d.set_aside.begin(), d.set_aside.end(),
                     [&](const SetAside& s) { return s.cause == candidate; });
}

}  // namespace

std::string ExclusionLines(const Diagnosis& d, bool colours) {
  std::vector<const CandidateResult*> excluded;
  std::vector<std::string> unneeded, unseen, untried, unsought;
  for (const CandidateResult& c : d.naming.candidates) {
    if (!c.candidate.in_all()) continue;  // the same effect, more narrowly
    if (c.status == CandidateStatus::kExcluded || c.status == CandidateStatus::kNotNeeded) {
      if (IsSetAside(d, c.candidate)) continue;
      if (BoundText(c).empty())
        unneeded.push_back(c.candidate.Name());
      else
        excluded.push_back(&c);
    } else if (c.candidate.effect->info.slow && c.status == CandidateStatus::kNotTested) {
      unsought.push_back(c.candidate.Name());
    } else if (c.candidate.effect->info.has_threshold && c.status == CandidateStatus::kNotTested) {
      untried.push_back(c.candidate.Name());
    } else if (c.status == CandidateStatus::kNotTested) {
      std::vector<std::string> sizes;
      for (const OpenParameter& p : c.candidate.parameters)
        if (!p.info.is_of_first)
          sizes.push_back(SizeText(p.info.typical, std::string(p.info.unit)));
      unseen.push_back(c.candidate.Name() + " " + Join(sizes, " and "));
    }
  }
  std::stable_sort(excluded.begin(), excluded.end(), [](const auto* a, const auto* b) {
    return RelativeBound(*a) < RelativeBound(*b);
  });
  std::vector<std::string> bounds;
  for (const CandidateResult* c : excluded) bounds.push_back(BoundText(*c));
  std::string text;
  if (!bounds.empty()) text += Labelled("excluded", "beyond " + Capped(bounds), colours);
  if (!unneeded.empty())
    text += Labelled("not needed", (d.extension ? "beside the above: " : "") + Capped(unneeded),
                     colours);
  if (!unseen.empty())
    text += Labelled("never shown", "at typical sizes: " + Capped(unseen), colours);
  if (!untried.empty())
    text += Labelled("not tried",
                     Capped(untried) + ": small sizes change nothing, and " +
                         (d.naming.refits > 0 ? "no simulation ran at larger ones"
                                              : "nothing is seen that asks for larger ones"),
                     colours);
  if (!unsought.empty())
    text += Labelled("not sought",
                     Capped(unsought) +
                         ": runs with them are slow, so they are tried where the "
                         "causes found leave more than a detail to see",
                     colours);
  return text;
}

}  // namespace hoplab
