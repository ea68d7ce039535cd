#pragma once

#include "tests/datasets/matlab_objects.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {

/// How a MAT-file is saved: -v6, the same by a machine of the other byte order, -v7, -v7.3.
enum class MatlabVersion { k6, k6Big, k7, k73 };
inline constexpr MatlabVersion kMatlabVersions[] = {MatlabVersion::k6, MatlabVersion::k6Big,
                                                    MatlabVersion::k7, MatlabVersion::k73};

/// The properties of a table.
inline MatlabFields TableOf(const std::vector<std::pair<std::string, MatlabValue>>& columns,
                            const std::vector<std::string>& units = {}) {
  std::vector<MatlabValue> data;
  std::vector<std::string> names;
  for (const auto& [name, value] : columns) {
    names.push_back(name);
    data.push_back(value);
  }
  const double rows = static_cast<double>(columns.front().second.size[0]);
  return {{"data", MatlabCells(data)},
          {"ndims", MatlabNumber(2)},
          {"nrows", MatlabNumber(rows)},
          {"rownames", MatlabCells({})},
          {"nvars", MatlabNumber(static_cast<double>(columns.size()))},
          {"varnames", MatlabTexts(names)},
          {"props", MatlabStruct({{"Description", MatlabText("")},
                                  {"VariableUnits", MatlabTexts(units)},
                                  {"versionSavedFrom", MatlabNumber(4)}})}};
}

/// The property of a timetable, which its class saves in a form of its own.
inline MatlabFields TimetableOf(const MatlabValue& times, std::size_t rows,
                                const std::vector<std::pair<std::string, MatlabValue>>& columns,
                                const std::vector<std::string>& units) {
  std::vector<MatlabValue> data;
  std::vector<std::string> names;
  for (const auto& [name, value] : columns) {
    names.push_back(name);
    data.push_back(value);
  }
  return {{"any", MatlabStruct({{"data", MatlabCells(data)},
                                {"dimNames", MatlabTexts({"Time", "Variables"})},
                                {"varNames", MatlabTexts(names)},
                                {"numDims", MatlabNumber(2)},
                                {"numRows", MatlabNumber(static_cast<double>(rows))},
                                {"numVars", MatlabNumber(static_cast<double>(columns.size()))},
                                {"rowTimes", times},
                                {"varUnits", MatlabTexts(units)},
                                {"versionSavedFrom", MatlabNumber(6)}})}};
}

/// Writes the variables; gives `file`.
inline std::filesystem::path WriteMatlab(const std::filesystem::path& file,
                                         const MatlabVariables& variables,
                                         const MatlabObjects& objects, MatlabVersion version) {
  std::filesystem::remove(file);
  if (version == MatlabVersion::k73) {
    WriteMat73(file, variables, objects);
  } else {
    WriteText(file, Level5Bytes(variables, objects, version == MatlabVersion::k7,
                                version == MatlabVersion::k6Big));
  }
  return file;
}

}  // namespace hoplab::testing
