#include "experiments/study/reproduction.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <variant>

#include "base/input_error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "experiments/study/kinematics_items.h"
#include "experiments/study/study_claims.h"
#include "experiments/study/study_figures.h"
#include "experiments/study/study_tables.h"

namespace hoplab {
namespace {

using Result = std::variant<std::monostate, StudyTable, StudyFigure, StudyClaim>;
using Names = std::vector<std::string>;

const Names& TableNames() {
  static const Names names = {"table-6.1", "table-6.2", "table-6.3", "table-6.4", "table-6.5"};
  return names;
}

bool Contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Names Joined(Names first, const Names& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

Names ItemsOfGroup(const std::string& group) {
  if (group == "all") return StudyItemNames();
  if (group == "tables") return TableNames();
  if (group == "figures") return Joined(KinematicsFigureNames(), StudyFigureNames());
  if (group == "kinematics") return Joined(KinematicsFigureNames(), KinematicsClaimNames());
  if (group == "claims") return Joined(StudyClaimNames(), KinematicsClaimNames());
  return {};
}

StudyTable RunTable(const std::string& name, const Study& study) {
  if (name == "table-6.1") return StartTable(name, study, 0.0);
  if (name == "table-6.2") return StartTable(name, study, 6.0);
  if (name == "table-6.3") return ModulusTable(name, study, 0.0);
  if (name == "table-6.4") return ModulusTable(name, study, 6.0);
  return EnergyTable(study);
}

// Items run side by side, so that each is one thread's.
Result RunItem(const std::string& name, const ReproductionRequest& request) {
  constexpr int kOneThread = 1;
  if (Contains(TableNames(), name)) return RunTable(name, request.study);
  if (Contains(KinematicsFigureNames(), name))
    return RunKinematicsFigure(name, request.legs, kOneThread);
  if (Contains(KinematicsClaimNames(), name))
    return RunKinematicsClaim(name, request.legs, kOneThread);
  if (Contains(StudyClaimNames(), name)) return RunStudyClaim(name, request.study);
  return RunStudyFigure(name, request.study);
}

}  // namespace

std::vector<std::string> StudyItemNames() {
  return Joined(Joined(TableNames(), Joined(StudyClaimNames(), KinematicsClaimNames())),
                Joined(KinematicsFigureNames(), StudyFigureNames()));
}

std::vector<std::string> StudyGroupNames() {
  return {"all", "tables", "figures", "kinematics", "claims"};
}

std::vector<std::string> ResolveStudyItems(const std::vector<std::string>& wanted) {
  const Names items = StudyItemNames(), groups = StudyGroupNames();
  Names chosen;
  for (const std::string& name : wanted) {
    if (Contains(groups, name)) {
      chosen = Joined(std::move(chosen), ItemsOfGroup(name));
    } else if (Contains(items, name)) {
      chosen.push_back(name);
    } else {
      const auto nearest = NearestWord(name, Joined(groups, items));
      throw InputError({"reproduce", Printable(name), "is no table, figure or claim of the study",
                        (nearest ? "Did you mean " + *nearest + "? " : std::string()) +
                            "There are table-6.1 to 6.5, figure-3.5 to 3.7, 4.5, 4.6 and 6.5 to "
                            "6.34, claim-a to claim-h, claim-level, claim-sign; and " +
                            Join(groups) + "."});
    }
  }
  Names ordered;
  for (const std::string& name : items) {
    if (Contains(chosen, name)) ordered.push_back(name);
  }
  return ordered;
}

Reproduction Reproduce(const ReproductionRequest& request) {
  const auto count = static_cast<int>(request.items.size());
  std::vector<Result> results(request.items.size());
  std::mutex mutex;
  int done = 0;
  ParallelFor(count, request.jobs, [&](int i) {
    if (request.stop && *request.stop) return;
    results[i] = RunItem(request.items[i], request);
    const std::lock_guard lock(mutex);
    ++done;
    if (request.progress) request.progress(done, request.items[i]);
  });
  Reproduction reproduction;
  for (int i = 0; i < count; ++i) {
    if (auto* table = std::get_if<StudyTable>(&results[i]))
      reproduction.tables.push_back(std::move(*table));
    else if (auto* figure = std::get_if<StudyFigure>(&results[i]))
      reproduction.figures.push_back(std::move(*figure));
    else if (auto* claim = std::get_if<StudyClaim>(&results[i]))
      reproduction.claims.push_back(std::move(*claim));
    else
      reproduction.left_out.push_back(request.items[i]);
  }
  return reproduction;
}

}  // namespace hoplab
