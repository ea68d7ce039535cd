#include "app/records/identify_record.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include "app/records/solver_record.h"

namespace hoplab {
namespace {

Json ReadingRecord(const StudyReading& reading) {
  return {{"variant", ThesisReadingRecord(reading.law)}, {"liftoff", NameOf(reading.liftoff)}};
}

Json ConstantsRecord(const StudyConstants& constants) {
  Json record = Json::object();
  for (int i = 0; i < kStudyConstantCount; ++i) {
    const StudyConstantInfo& info = InfoOf(static_cast<StudyConstant>(i));
    const std::string unit(info.unit);
    record[std::string(info.name)] = {
        {"value", NumberOrNull(constants[static_cast<std::size_t>(i)])}, {"unit", unit}};
  }
  return record;
}

Json ScoresRecord(const StudyScores& s) {
  Json record = {{"table_6_5_rms_points", NumberOrNull(s.energy_rms)},
                 {"table_6_5_worst_points", NumberOrNull(s.energy_worst)},
                 {"stiffness_rms", NumberOrNull(s.stiffness_rms)},
                 {"stiffness_worst", NumberOrNull(s.stiffness_worst)},
                 {"table_6_4_tau", NumberOrNull(s.modulus_trend)},
                 {"convergence_rms_s", NumberOrNull(s.convergence_rms)}};
  for (std::size_t i = 0; i < s.times.size(); ++i) {
    const std::string table = "table_6_" + std::to_string(i + 1);
    record[table + "_converged"] = s.times[i].converged;
    record[table + "_time_rms_s"] = NumberOrNull(s.times[i].rms_s);
    record[table + "_rank_correlation"] = NumberOrNull(s.times[i].rank_correlation);
  }
  return record;
}

Json PartsRecord(const StudyMisfit& misfit) {
  Json record = Json::object();
  for (int i = 0; i < kStudyPartCount; ++i)
    record[std::string(NameOf(static_cast<StudyPart>(i)))] =
        NumberOrNull(misfit.parts[static_cast<std::size_t>(i)]);
  return record;
}

Json FitRecord(const ScoredFit& scored) {
  return {{"reading", ReadingRecord(scored.fit.reading)},
          {"convergence", NameOf(scored.convergence)},
          {"constants", ConstantsRecord(scored.fit.constants)},
          {"misfit", NumberOrNull(scored.fit.misfit)},
          {"parts", PartsRecord(scored.fit.parts)},
          {"scores", ScoresRecord(scored.scores)}};
}

Json DirectionsRecord(const std::vector<StudyConstant>& free,
                      const std::vector<StudyDirection>& directions) {
  Json record = Json::array();
  for (const StudyDirection& d : directions) {
    Json loadings = Json::object();
    for (std::size_t i = 0; i < free.size(); ++i)
      loadings[std::string(InfoOf(free[i]).name)] = d.loadings[i];
    record.push_back({{"strength", NumberOrNull(d.strength)}, {"loadings", loadings}});
  }
  return record;
}

Json DecisionsRecord(const std::vector<PointDecision>& decisions) {
  Json record = Json::array();
  for (const PointDecision& decision : decisions) {
    Json words = Json::array();
    for (const PointDecision::Word& w : decision.words) {
      words.push_back({{"word", w.word},
                       {"table_6_5_misfit", NumberOrNull(w.energy_misfit)},
                       {"steady_misfit", NumberOrNull(w.steady_misfit)},
                       {"all_misfit", NumberOrNull(w.all_misfit)}});
    }
    record.push_back({{"point", decision.point}, {"words", words}});
  }
  return record;
}

Json NewIdentifyRecord(const IdentifySettings& settings) {
  RecordHeader header;
  header.command = "identify";
  header.law = std::string(NameOf(Law::kThesis));
  header.seed = settings.seed;
  header.options = {{"tables", settings.tables},
                    {"times", settings.times},
                    {"budget", settings.budget},
                    {"readings", settings.readings},
                    {"keep", settings.keep},
                    {"keep_toe", settings.keep_toe},
                    {"toe_budget", settings.toe_budget},
                    {"free_damping_scale", settings.free_damping_scale},
                    {"free_rolling_blend", settings.free_rolling_blend},
                    {"free_toe_mass", settings.free_toe_mass},
                    {"free_desired_speed", settings.free_desired_speed},
                    {"placed_as_printed", settings.placed_as_printed}};
  RecordSolver(settings.solver, header.options);
  return NewRecord(header);
}

std::string TextOfFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Json IdentifyRecord(const IdentifySettings& settings, const IdentificationRequest& request,
                    const IdentificationResult& result) {
  Json record = NewIdentifyRecord(settings);
  if (!result.by_all.empty()) record["best"] = FitRecord(result.by_all.front());
  record["best_on_table_6_5"] = FitRecord(result.best_by_energy);
  record["as_good"] = {{"count", result.as_good},
                       {"low", ConstantsRecord(result.low)},
                       {"high", ConstantsRecord(result.high)}};
  Json others = Json::array();
  for (const ScoredFit& scored : result.by_all) others.push_back(FitRecord(scored));
  record["readings"] = others;
  Json front = Json::array();
  for (const FrontPoint& point : result.front) {
    Json at = FitRecord(point.fit);
    at["name"] = point.name;
    front.push_back(at);
  }
  record["front"] = front;
  record["directions"] = {
      {"table_6_5", DirectionsRecord(request.free, result.energy_directions)},
      {"with_stiffness", DirectionsRecord(request.free, result.smooth_directions)}};
  record["decisions"] = DecisionsRecord(result.decisions);
  record["evaluations"] = result.evaluations;
  record["interrupted"] = result.interrupted;
  return record;
}

std::map<std::string, std::string> IdentifyFiles(const IdentifySettings& settings,
                                                 const IdentificationResult& result,
                                                 const Json& record, const FitJournal& journal) {
  std::map<std::string, std::string> files = IdentificationTables(result);
  files["run.json"] = TextOf(record);
  files["fits.txt"] = TextOfFile(journal.lines().file());
  if (!result.by_all.empty() && !std::isnan(result.by_all.front().fit.misfit))
    files["published.yaml"] =
        ScenarioText(result.by_all.front().fit, "published", OriginText(settings));
  if (!result.by_energy.empty() && !std::isnan(result.by_energy.front().misfit))
    files["published-energy.yaml"] =
        ScenarioText(result.by_energy.front(), "published-energy", OriginText(settings));
  return files;
}

}  // namespace hoplab
