#pragma once

#include <string>
#include <vector>

#include "app/records/json_at.h"
#include "app/reports/headline.h"

namespace hoplab {

// What headlines are made of, and those of each kind of run: each fills in the sentence and the
// figures from the record.

inline constexpr const char* kNotComputed = "not computed";

/// A key as part of a pointer.
std::string PointerKey(const std::string& key);
/// The number at a pointer in a readable unit.
HeadlineFigure Figure(const Json& record, const std::string& label, const std::string& pointer,
                      const std::string& unit, int digits = 4);
HeadlineFigure CountFigure(const std::string& label, const std::string& value,
                           const std::string& pointer);
/// The channel that is furthest off, in units of its noise; empty if no error was computed.
std::string WorstChannel(const Json& record, const std::string& errors);
/// The error of the channel that is furthest off, here or in `worst_in`.
HeadlineFigure ErrorFigure(const Json& record, const std::string& what, const std::string& errors,
                           const std::string& worst_in = "");

void CheckHeadline(const Json& record, Headline& out);
void FitHeadline(const Json& record, Headline& out);
void DiagnosisHeadline(const Json& record, Headline& out);
void DiscoveryHeadline(const Json& record, Headline& out);
void DesignHeadline(const Json& record, Headline& out);
void GaitHeadline(const Json& record, Headline& out);
void OptimizeHeadline(const Json& record, Headline& out);
void SweepHeadline(const Json& record, Headline& out);
void SimulationHeadline(const Json& record, Headline& out);
void ComparisonHeadline(const Json& record, Headline& out);
void ReproductionHeadline(const Json& record, Headline& out);

}  // namespace hoplab
