#pragma once

#include "app/records/record_parts.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Names of the effects of a model's members.
Json MembersRecord(const std::vector<Candidate>& members);
/// What cannot be told apart: one array a member, each name with how far its model is behind.
Json GroupsRecord(const Diagnosis& diagnosis);
/// The causes of the extension, main ones first, the largest share first.
Json CausesRecord(const Diagnosis& diagnosis);
/// Corrections the data are told without, as their names are most likely wrong.
Json SetAsideRecord(const Diagnosis& diagnosis);
/// The models visited with their posterior weights, the best first.
Json PosteriorRecord(const Diagnosis& diagnosis);

}  // namespace hoplab
