#include "app/records/misfit_record.h"

namespace hoplab {
namespace {

Json TestsRecord(const Detection& detection) {
  Json tests = Json::array();
  for (const DetectionTest& t : detection.tests) {
    const bool seen = t.dof > 0;
    tests.push_back({{"name", t.name},
                     {"statistic", seen ? NumberOrNull(t.statistic) : Json(nullptr)},
                     {"p_value", seen ? NumberOrNull(t.p_value) : Json(nullptr)},
                     {"dof", t.dof}});
  }
  return tests;
}

std::string ChannelNameOf(const FitProblem& problem, int channel) {
  return std::string(NameOf(channel < 0
                                ? Channel::kContact
                                : problem.channels[static_cast<std::size_t>(channel)].channel));
}

}  // namespace

Json DetectionRecord(const Detection& detection) {
  if (detection.tests.empty()) {
    return {{"p_value", nullptr},
            {"tests", Json::array()},
            {"chi2", nullptr},
            {"degrees_of_freedom", nullptr}};
  }
  return {{"p_value", NumberOrNull(detection.p_value)},
          {"tests", TestsRecord(detection)},
          {"chi2", NumberOrNull(detection.chi2)},
          {"degrees_of_freedom", detection.degrees_of_freedom}};
}

Json PartsRecord(const std::vector<MisfitPart>& parts, const char* key,
                 const std::function<Json(int index)>& name) {
  Json out = Json::array();
  for (const MisfitPart& p : parts) {
    out.push_back({{key, name(p.index)},
                   {"share", NumberOrNull(p.share)},
                   {"rows", p.rows},
                   {"chi2", NumberOrNull(p.chi2)},
                   {"expected", NumberOrNull(p.expected)},
                   {"p_value", NumberOrNull(p.p_value)}});
  }
  return out;
}

Json LocalisationRecord(const Diagnosis& d) {
  Json out = Json::array();
  for (const MisfitCell& c : d.localisation.cells) {
    out.push_back({{"mode", NameOf(c.mode)},
                   {"phase", c.phase},
                   {"channel", ChannelNameOf(d.problem, c.channel)},
                   {"share", NumberOrNull(c.share)},
                   {"rows", c.rows},
                   {"chi2", NumberOrNull(c.chi2)},
                   {"expected", NumberOrNull(c.expected)},
                   {"p_value", NumberOrNull(c.p_value)}});
  }
  return out;
}

}  // namespace hoplab
