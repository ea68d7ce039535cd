#include "app/runs/identify_work.h"

#include <cmath>
#include <mutex>
#include <ostream>

#include "app/terminal/exit_code.h"
#include "base/check.h"
#include "base/input_error.h"
#include "base/parallel.h"

namespace hoplab {
namespace {

// A unit a line.
std::string TextOfUnits(const std::vector<StudyUnit>& units) {
  std::string text;
  for (const StudyUnit& unit : units) text += TextOf(unit) + '\n';
  return text;
}

std::vector<StudyUnit> UnitsOfText(const std::string& text) {
  std::vector<StudyUnit> units;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const auto unit = UnitOfText(std::string_view(text).substr(at, end - at));
    HOPLAB_CHECK(unit.has_value());
    units.push_back(*unit);
    at = end + 1;
  }
  return units;
}

}  // namespace

IdentifyWork::IdentifyWork(const UnitContext& context, FitJournal& journal, const Means& means,
                           Progress& progress, Console& console)
    : context_(context), journal_(journal), means_(means), progress_(progress), console_(console) {}

IdentifyWork::~IdentifyWork() {
  if (means_.job) means_.job->Share("");
}

FitUnits IdentifyWork::Fits() {
  return [this](const std::string& stage, const std::vector<StudyUnit>& units) {
    return Fit(stage, units);
  };
}

std::vector<StudyFit> IdentifyWork::Fit(const std::string& stage,
                                        const std::vector<StudyUnit>& units) {
  std::vector<StudyFit> fits(units.size());
  std::vector<int> missing;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto known = journal_.Find(units[i]);
    if (known)
      fits[i] = *known;
    else
      missing.push_back(static_cast<int>(i));
    if (!known) {
      fits[i].reading = units[i].reading;
      fits[i].constants = units[i].constants;
      fits[i].misfit = std::nan("");
    }
  }
  stage_ = stage;
  of_ = static_cast<int>(units.size());
  done_ = of_ - static_cast<int>(missing.size());
  progress_.Stage(stage + ": " + std::to_string(of_) + " searches" +
                      (done_ > 0 ? ", " + std::to_string(done_) + " stand in the journal" : ""),
                  done_);
  if (missing.empty()) return fits;
  if (means_.job)
    OnRanks(units, missing, fits);
  else
    OnThreads(units, missing, fits);
  return fits;
}

void IdentifyWork::Accept(const StudyUnit& unit, const StudyFit& fit) {
  if (Stopped()) return;  // it may have been cut short
  journal_.Add(unit, fit);
  ++done_;
  progress_.Step(stage_ + ": " + std::to_string(done_) + " of " + std::to_string(of_), done_, of_);
}

void IdentifyWork::OnThreads(const std::vector<StudyUnit>& units, const std::vector<int>& missing,
                             std::vector<StudyFit>& fits) {
  std::mutex mutex;
  ParallelFor(static_cast<int>(missing.size()), means_.jobs, [&](int i) {
    const auto at = static_cast<std::size_t>(missing[static_cast<std::size_t>(i)]);
    if (Stopped()) return;
    fits[at] = FitUnit(context_, units[at]);
    const std::lock_guard lock(mutex);
    Accept(units[at], fits[at]);
  });
}

void IdentifyWork::OnRanks(const std::vector<StudyUnit>& units, const std::vector<int>& missing,
                           std::vector<StudyFit>& fits) {
  means_.job->Share(TextOfUnits(units));
  const auto compute = [&](int i) {
    return TextOf(FitUnit(context_, units[static_cast<std::size_t>(i)]));
  };
  const auto accept = [&](int i, const std::string& text) {
    const auto at = static_cast<std::size_t>(i);
    const auto fit = FitOfText(text);
    HOPLAB_CHECK(fit.has_value());
    fits[at] = *fit;
    Accept(units[at], fits[at]);
  };
  try {
    if (!means_.job->Serve(missing, compute, accept, means_.stop).stopped) return;
  } catch (const InputError& error) {  // the journal cannot be written
    progress_.Clear();
    console_.err << "hoplab identify: " << error.what() << std::endl;
    means_.job->Abort(static_cast<int>(ExitCode::kBadInput));
  }
  progress_.Clear();
  console_.err << "hoplab identify: stopped, as when a rank is lost; " << journal_.size()
               << " fits are kept in " << journal_.lines().file().string()
               << "; the same command computes the others" << std::endl;
  means_.job->Abort(static_cast<int>(ExitCode::kInterrupted));
}

void FollowIdentification(const UnitContext& context, MpiJob& job) {
  for (std::string text = job.Share(""); !text.empty(); text = job.Share("")) {
    const std::vector<StudyUnit> units = UnitsOfText(text);
    job.Work([&](int i) { return TextOf(FitUnit(context, units[static_cast<std::size_t>(i)])); });
  }
}

}  // namespace hoplab
