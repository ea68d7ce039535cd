// What is shipped of the identification, against the program as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "base/text.h"
#include "experiments/identification/study_unit.h"

namespace hoplab {
namespace {

std::string TextOfFile(const std::string& name) {
  std::ifstream in(std::string(HOPLAB_SOURCE_DIR) + "/experiments/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The fit to all tables, all parts alike, that does best in the journal.
std::optional<StudyFit> BestOfJournal() {
  const std::string journal = TextOfFile("identified/fits.txt");
  std::optional<StudyFit> best;
  for (std::size_t at = 0; at < journal.size();) {
    const std::size_t end = std::min(journal.find('\n', at), journal.size());
    const std::string line = journal.substr(at, end - at);
    at = end + 1;
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos) continue;
    const auto unit = UnitOfText(line.substr(0, tab));
    const auto fit = FitOfText(line.substr(tab + 1));
    if (!unit || !fit || unit->runs != StudyUnit::Runs::kTables || unit->weights != kAllParts)
      continue;
    if (!best || fit->misfit < best->misfit) best = fit;
  }
  return best;
}

TEST(Identified, ConstantsAreTheBestOfTheJournal) {
  const std::optional<StudyFit> best = BestOfJournal();
  ASSERT_TRUE(best.has_value());
  const std::string scenario = TextOfFile("published.yaml");
  const StudyConstants& c = best->constants;
  for (const auto& [key, value] :
       {std::pair("body_mass_kg: ", At(c, StudyConstant::kMass)),
        std::pair("rest_radius_m: ", At(c, StudyConstant::kRadius)),
        std::pair("kp_N_s: ", At(c, StudyConstant::kGain)),
        std::pair("vx_m_per_s: ", At(c, StudyConstant::kStartSpeed)),
        std::pair("touchdown_angle_deg: ", 40.0 * At(c, StudyConstant::kPlacedShare))})
    EXPECT_NE(scenario.find(key + FormatDouble(value)), std::string::npos) << key;
}

TEST(Identified, TheTablesComeOutAsTheJournalSays) {
  const std::optional<StudyFit> best = BestOfJournal();
  ASSERT_TRUE(best.has_value());
  UnitContext context;
  context.data = PublishedStudyData();
  context.convergence = {ConvergenceReading()};
  context.integrator.relative_tolerance = 1e-7;
  const StudyMisfit misfit = MisfitOf({best->reading, best->constants, context.integrator}, context,
                                      StudyUnit::Runs::kTables, kAllParts);
  for (std::size_t i = 0; i < misfit.parts.size(); ++i)
    EXPECT_NEAR(misfit.parts[i], best->parts.parts[i], 1e-3 * (1.0 + best->parts.parts[i]))
        << NameOf(static_cast<StudyPart>(i));
}

}  // namespace
}  // namespace hoplab
