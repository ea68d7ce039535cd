#include "experiments/identification/identification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "experiments/identification/findings.h"
#include "experiments/identification/fit_ranking.h"

namespace hoplab {
namespace {

using Fits = std::vector<StudyFit>;
using Units = std::vector<StudyUnit>;

// Shares of the budget of a unit over steady hops; a set of tables takes twenty times as long.
constexpr double kNearbyShare = 0.5, kTablesShare = 0.1, kRefineShare = 0.2, kFrontShare = 0.1;
// A leg with a toe mass vibrates: its runs take thirty times as long. Of the evaluations over
// steady hops of such a leg, those over all tables.
constexpr double kToeShare = 0.08, kToeTables = 0.25;
// A search by one reading of the times, how many of these are tried of a reading of the law, and
// how many of what they find are polished.
constexpr double kTimesShare = 0.15;
constexpr int kLikelyTimes = 4, kPolishedTimes = 3;
constexpr int kEnergyMost = 300;    // evaluations: table 6.5 has no more to say
constexpr int kToeEnergyTimes = 4;  // with a mass at the toe, one constant more and vibrating
// Half-width of a search about the best of another reading, in logarithms.
constexpr double kNearby = 0.3;
constexpr double kToeBox = 0.6;  // of the other constants once there is a toe mass
constexpr double kFirstToeMass = 0.01, kFirstRate = 30.0, kFirstDamping = 0.5;
constexpr double kEmphasis = 10.0;
constexpr std::array kBothSigns = {ThesisReading::TorqueSign::kNormal,
                                   ThesisReading::TorqueSign::kPrinted};

class Identifier {
 public:
  Identifier(const IdentificationRequest& request, const FitUnits& fit_units)
      : request_(request), fit_units_(fit_units) {}

  IdentificationResult Run() {
    FitEnergy();
    FitSteady();
    FitTables();
    FitTimes();
    FitToeMass();
    Refine();
    SortByMisfit(all_);
    Score();
    if (request_.with_front) FindFront();
    AddFindings(request_, result_);
    result_.interrupted = request_.context.stop && *request_.context.stop;
    return std::move(result_);
  }

 private:
  // The fits of a stage, best first.
  Fits Fit(const std::string& stage, const Units& units) {
    Fits fits = fit_units_(stage, units);
    for (const StudyFit& fit : fits) result_.evaluations += fit.evaluations;
    return fits;
  }
  StudyUnit UnitOf(StudyUnit::Runs runs, const StudyReading& reading, double share) const {
    StudyUnit unit;
    unit.runs = runs;
    unit.reading = reading;
    unit.free = request_.free;
    unit.constants = request_.fixed;
    unit.seed = request_.seed;
    unit.budget = std::max(20, static_cast<int>(share * request_.budget));
    return unit;
  }
  bool HasTables() const {
    return !request_.context.data.modulus.empty() || !request_.context.data.initial_states.empty();
  }

  void FitEnergy() {
    if (request_.context.data.energy.empty()) return;
    Units units;
    for (const StudyReading& reading : request_.readings) {
      StudyUnit unit = UnitOf(StudyUnit::Runs::kEnergy, reading, kNearbyShare);
      unit.budget = std::min(unit.budget, kEnergyMost);
      unit.weights = kEnergyAlone;
      std::erase_if(unit.free, [](StudyConstant c) { return !IsInEnergy(c); });
      unit.box = kWholeBox;
      units.push_back(unit);
    }
    result_.by_energy = Fit("table 6.5", units);
    SortByMisfit(result_.by_energy);
  }

  // Each reading with both signs of the torque: from scratch, and with the constants that 6.5 has
  // found for it, the others being searched; then all of them about the best of these, since a
  // search that finds no steady hop undamped has nothing to follow.
  void FitSteady() {
    if (!HasTables()) return;
    result_.by_steady = Fit("steady hops", SteadyUnits());
    SortByMisfit(result_.by_steady);
    if (result_.by_steady.empty() || std::isnan(result_.by_steady.front().misfit)) return;
    Units units;
    for (const StudyReading& reading : KeptReadings()) {
      StudyUnit unit = UnitOf(StudyUnit::Runs::kSteady, reading, kNearbyShare);
      unit.constants = result_.by_steady.front().constants;
      unit.box = kNearby;
      AddWithBothSigns(unit, units);
    }
    const Fits nearby = Fit("steady hops about the best", units);
    result_.by_steady.insert(result_.by_steady.end(), nearby.begin(), nearby.end());
    SortByMisfit(result_.by_steady);
  }
  Units SteadyUnits() const {
    Units units;
    for (const StudyReading& reading : KeptReadings()) {
      StudyUnit unit = UnitOf(StudyUnit::Runs::kSteady, reading, 1.0);
      unit.box = kWholeBox;
      AddWithBothSigns(unit, units);
    }
    for (const StudyFit& fit : Best(result_.by_energy, request_.keep_readings)) {
      if (std::isnan(fit.misfit)) continue;
      StudyUnit unit = UnitOf(StudyUnit::Runs::kSteady, fit.reading, kNearbyShare);
      unit.constants = fit.constants;
      std::erase_if(unit.free, [](StudyConstant c) { return IsInEnergy(c); });
      unit.box = kWholeBox;
      if (!unit.free.empty()) AddWithBothSigns(unit, units);
    }
    return units;
  }
  static void AddWithBothSigns(const StudyUnit& unit, Units& units) {
    for (const auto sign : kBothSigns) {
      units.push_back(unit);
      units.back().reading.law.torque_sign = sign;
    }
  }

  // All readings, or those that do best on 6.5.
  std::vector<StudyReading> KeptReadings() const {
    if (result_.by_energy.empty()) return request_.readings;
    std::vector<StudyReading> kept;
    for (const StudyFit& fit : Best(result_.by_energy, request_.keep_readings))
      kept.push_back(fit.reading);
    return kept;
  }

  void FitTables() {
    if (!HasTables()) {
      all_ = result_.by_energy;
      return;
    }
    Units units;
    for (const StudyFit& fit : BestReadings(result_.by_steady, request_.keep)) {
      StudyUnit unit = UnitOf(StudyUnit::Runs::kTables, fit.reading, kTablesShare);
      unit.constants = fit.constants;
      units.push_back(unit);
    }
    all_ = Fit("all tables", units);
    SortByMisfit(all_);
  }

  // The best readings of the law, and those that do best on 6.5, by each of the likely readings of
  // the times, within all bounds of what 6.5 does not tell: a search that may take any reading
  // stays with the one that fits where it begins, and a linear map tells slow times badly.
  void FitTimes() {
    if (!HasTables() || all_.empty() || result_.by_energy.empty()) return;
    Units units;
    for (const StudyFit& fit : BestReadings(all_, request_.refine))
      AddByTimes(fit, std::array{fit.reading.law.torque_sign}, units);
    for (StudyFit fit : Best(result_.by_energy, request_.refine)) {
      for (const StudyConstant c : request_.free)
        if (!IsInEnergy(c)) At(fit.constants, c) = At(all_.front().constants, c);
      AddByTimes(fit, kBothSigns, units);
    }
    Fits found = Fit("readings of the times", units);
    SortByMisfit(found);
    units.clear();
    for (const StudyFit& fit : Best(found, kPolishedTimes)) {
      if (std::isnan(fit.misfit)) continue;
      units.push_back(From(fit, kTablesShare));
    }
    const Fits polished = Fit("readings of the times, polished", units);
    all_.insert(all_.end(), polished.begin(), polished.end());
    SortByMisfit(all_);
  }

  void AddByTimes(const StudyFit& fit, std::span<const ThesisReading::TorqueSign> signs,
                  Units& units) const {
    const bool stopped = request_.context.stop && *request_.context.stop;
    if (std::isnan(fit.misfit) || stopped) return;
    StudyUnit unit = UnitOf(StudyUnit::Runs::kTables, fit.reading, kTimesShare);
    unit.constants = fit.constants;
    unit.box = kWholeBox;
    std::erase_if(unit.free, IsInEnergy);
    if (unit.free.empty()) return;
    for (const auto sign : signs) {
      unit.reading.law.torque_sign = sign;
      for (const int times : LikelyTimes(request_.context, unit, kLikelyTimes)) {
        unit.times = times;
        units.push_back(unit);
      }
    }
  }

  // The best readings again with a toe mass, by a part of the runs: from the constants and the toe
  // mass that 6.5 finds, and in a box about the best without one; then by all runs.
  void FitToeMass() {
    if (request_.toe_free.empty() || !HasTables()) return;
    Units units = ToeUnitsFromEnergy();
    for (const StudyFit& fit : BestLaws(all_, request_.keep_toe)) {
      units.push_back(ToeUnit(fit));
      units.back().box = kToeBox;
      if (request_.toe_budget == 0) continue;
      StudyUnit from_scratch = units.back();
      from_scratch.box = kWholeBox;
      AddWithBothSigns(from_scratch, units);
    }
    Fits found = Fit("toe mass", units);
    SortByMisfit(found);
    units.clear();
    for (const StudyFit& fit : Best(found, request_.keep_toe)) {
      units.push_back(ToeUnit(fit));
      units.back().runs = StudyUnit::Runs::kTables;
      units.back().constants = fit.constants;
      units.back().budget = ToeEvaluations(kToeTables);
    }
    const Fits polished = Fit("toe mass, all tables", units);
    all_.insert(all_.end(), polished.begin(), polished.end());
    SortByMisfit(all_);
  }
  Units ToeUnitsFromEnergy() {
    constexpr int kReadings = 4;  // times those that go on
    Units units;
    for (const StudyFit& fit : BestLaws(result_.by_steady, kReadings * request_.keep_toe)) {
      StudyUnit unit = ToeUnit(fit);
      unit.runs = StudyUnit::Runs::kEnergy;
      unit.weights = kEnergyAlone;
      std::erase_if(unit.free, [](StudyConstant c) {
        return !IsInEnergy(c) || c == StudyConstant::kPlacementRate ||
               c == StudyConstant::kPlacementDamping;
      });
      unit.box = kWholeBox;
      unit.budget = std::min(request_.budget, kEnergyMost * kToeEnergyTimes);
      units.push_back(unit);
    }
    if (request_.context.data.energy.empty()) return {};
    Fits fits = Fit("table 6.5, toe mass", units);
    SortByMisfit(fits);
    units.clear();
    for (const StudyFit& fit : Best(fits, request_.keep_toe)) {
      StudyUnit unit = ToeUnit(fit);
      unit.constants = fit.constants;
      std::erase_if(unit.free,
                    [](StudyConstant c) { return c == StudyConstant::kToeMass || IsInEnergy(c); });
      unit.box = kWholeBox;
      if (!unit.free.empty()) units.push_back(unit);
    }
    return units;
  }
  // A share of what a search with a toe mass is allowed.
  int ToeEvaluations(double share) const {
    const double all = request_.toe_budget > 0 ? request_.toe_budget : kToeShare * request_.budget;
    return std::max(20, static_cast<int>(share * all));
  }
  // A search over steady hops with a toe mass, from a fit without one.
  StudyUnit ToeUnit(const StudyFit& fit) const {
    StudyUnit unit = UnitOf(StudyUnit::Runs::kSteady, fit.reading, 1.0);
    unit.budget = ToeEvaluations(1.0);
    unit.reading.liftoff = LiftoffRule::kZeroForce;
    unit.free.insert(unit.free.end(), request_.toe_free.begin(), request_.toe_free.end());
    unit.constants = fit.constants;
    At(unit.constants, StudyConstant::kToeMass) = kFirstToeMass;
    At(unit.constants, StudyConstant::kPlacementRate) = kFirstRate;
    At(unit.constants, StudyConstant::kPlacementDamping) = kFirstDamping;
    return unit;
  }

  void Refine() {
    if (!HasTables()) return;
    Units units;
    for (const StudyFit& fit : Best(all_, request_.refine)) {
      if (std::isnan(fit.misfit)) continue;
      units.push_back(From(fit, kRefineShare));
    }
    const Fits refined = Fit("refined", units);
    all_.insert(all_.end(), refined.begin(), refined.end());
  }

  void FindFront() {
    if (!HasTables() || all_.empty() || std::isnan(all_.front().misfit)) return;
    Units units;
    std::vector<std::string> names;
    for (int i = 0; i < kStudyPartCount; ++i) {
      const std::string part(NameOf(static_cast<StudyPart>(i)));
      for (const double weight : {kEmphasis, 0.0}) {
        StudyUnit unit = From(all_.front(), kFrontShare);
        unit.weights[static_cast<std::size_t>(i)] = weight;
        units.push_back(unit);
        names.push_back(weight == 0.0 ? "without " + part : part + " x 10");
      }
    }
    const Fits fits = Fit("front", units);
    result_.front.push_back({"all", result_.by_all.front()});
    for (std::size_t i = 0; i < fits.size(); ++i) {
      if (!std::isnan(fits[i].misfit))
        result_.front.push_back({names[i], Scored(fits[i], request_.context)});
    }
  }

  // A local search on all tables from a fit, of what is free in it.
  StudyUnit From(const StudyFit& fit, double share) const {
    const bool has_toe = At(fit.constants, StudyConstant::kToeMass) > 0.0;
    StudyUnit unit = UnitOf(StudyUnit::Runs::kTables, fit.reading, share);
    if (has_toe) unit.budget = ToeEvaluations(kToeTables * share);
    unit.constants = fit.constants;
    if (has_toe)
      unit.free.insert(unit.free.end(), request_.toe_free.begin(), request_.toe_free.end());
    return unit;
  }

  void Score() {
    if (!result_.by_energy.empty())
      result_.best_by_energy = Scored(result_.by_energy.front(), request_.context);
    for (const StudyFit& fit : all_) result_.by_all.push_back(Scored(fit, request_.context));
  }

  const IdentificationRequest& request_;
  const FitUnits& fit_units_;
  IdentificationResult result_;
  Fits all_;  // fits to all tables
};

}  // namespace

IdentificationResult Identify(const IdentificationRequest& request, const FitUnits& fit_units) {
  return Identifier(request, fit_units).Run();
}

}  // namespace hoplab
