#pragma once

#include <string>
#include <vector>

#include "datasets/import/mat_objects.h"
#include "datasets/import/table.h"

namespace hoplab {

/// Adds the columns of a MATLAB table or timetable: `name`.z, `name`.pos(:,2), the times of a
/// timetable as `name`.Time in ms. Units are those of VariableUnits, else those in a column's name.
/// Columns that are no numbers are told in the table's notes. Returns why there is nothing to read
/// (several tables, a form that is not known, a single row); empty otherwise. Throws InputError
/// where the object is damaged.
std::string AddMatTable(const MatObjects& objects, const MatReference& reference, Table* table);

}  // namespace hoplab
