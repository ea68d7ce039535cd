#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "datasets/blank_values.h"
#include "datasets/dataset.h"
#include "datasets/import/trace_of_table.h"

namespace hoplab {

/// A part of a log by its own clock, both ends included.
struct LogCut {
  std::optional<double> from_s, to_s;
};

/// One recording that becomes a trial, or as many as it has cuts.
struct LogRequest {
  std::filesystem::path file;
  TrialRole role = TrialRole::kTrain;
  std::vector<LogCut> cuts;  // none: all of it
};

struct ImportRequest {
  std::vector<LogRequest> logs;     // at least one
  std::optional<LogFormat> format;  // absent: by name and first bytes
  std::vector<MapEntry> map;        // empty: all is guessed
  TraceOptions options;             // but for the cuts, which are the logs'
  std::string name;                 // of the dataset
  /// Absent: a robot where columns are those of one, else a C-leg.
  std::optional<MechanismKind> type;
  std::optional<int> legs;     // of a robot; absent: as many as have columns
  std::vector<LogUnit> units;  // of columns whose unit stands nowhere, one a kind
  /// Values for keys that would be left blank: {"mechanism.body_mass_kg", "1.01"},
  /// {"trials.0.touchdown_angle_deg", "25"}.
  std::vector<std::pair<std::string, std::string>> values;
};

/// One trial.
struct ImportedLog {
  std::string source, file;  // "logs/run17.mat", "run17.csv"
  std::string format;        // "Motive CSV"
  TrialRole role = TrialRole::kTrain;
  ImportedTrace trace;  // its csv moved to `files`
};

struct ImportResult {
  std::map<std::string, std::string> files;  // the dataset's, by name
  MechanismKind type = MechanismKind::kCLeg;
  int legs = 0;  // of a robot
  std::vector<ImportedLog> logs;
  ColumnMap map;                       // of the first log, which the others follow
  std::vector<std::string> columns;    // names of the mapped columns, in the order of `map`
  std::vector<std::string> map_texts;  // --map options that say the same
  std::vector<std::string> unused;     // columns of the first log that became no channel
  std::vector<BlankValue> blanks;      // what a fit still needs
  std::vector<std::string> notes;
};

/// Reads the logs and makes a dataset of them; what is not known of the mechanism is left blank in
/// its dataset.yaml. All logs have the columns of the first. Throws InputError for whatever is
/// wrong with a log, the map or a value.
ImportResult ImportLogs(const ImportRequest& request);

}  // namespace hoplab
