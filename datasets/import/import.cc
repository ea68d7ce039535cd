#include "datasets/import/import.h"

#include <algorithm>
#include <set>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/dataset_text.h"
#include "datasets/read_dataset.h"
#include "datasets/yaml_tree.h"

namespace hoplab {
namespace {

// "run 17.mot" gives "run-17.csv", its second part "run-17-2.csv".
std::string TrialFileName(const std::filesystem::path& log, const std::string& part) {
  std::string name = log.stem().string();
  for (char& c : name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       c == '.' || c == '_' || c == '-';
    if (!plain) c = '-';
  }
  if (name.empty() || name.front() == '.' || name.front() == '-') name.insert(0, "trial");
  return name + part + ".csv";
}

// The map of the first log as entries for the others.
std::vector<MapEntry> EntriesOf(const Table& table, const ColumnMap& map) {
  std::vector<MapEntry> entries;
  for (const MappedColumn& mapped : map.columns) {
    // Positions stand for names that are not unique.
    const std::string& name = table.columns[mapped.column].name;
    const auto alike = std::count_if(table.columns.begin(), table.columns.end(),
                                     [&](const SourceColumn& c) { return c.name == name; });
    entries.push_back({mapped.target, alike == 1 ? name : "#" + std::to_string(mapped.column + 1),
                       mapped.negate,
                       mapped.unit.dimension == Dimension::kNone ? "" : mapped.unit.name});
  }
  return entries;
}

// How many legs the robot has, by its columns or as it is said.
int LegsOf(const ColumnMap& map, const std::optional<int>& said) {
  int legs = 0;
  std::set<int> driven;
  for (const MappedColumn& mapped : map.columns) {
    legs = std::max(legs, mapped.target.Leg() + 1);
    if (mapped.target.input) driven.insert(mapped.target.Leg());
  }
  if (legs == 0 && !said)
    throw InputError({"--legs", "", "how many legs the robot has is not told by its columns",
                      "Say it, as --legs 2, or name a leg's column, as --map leg_angle_1=q1:deg."});
  if (said && *said < legs)
    throw InputError({"--legs", std::to_string(*said),
                      "there are columns of leg " + std::to_string(legs),
                      "Leave --legs out, or map the columns of fewer legs."});
  legs = said.value_or(legs);
  for (int leg = 0; leg < legs && !driven.empty(); ++leg) {
    if (driven.count(leg) > 0) continue;
    const std::string motor = std::to_string(leg + 1);
    throw InputError({"--map", "reference_" + motor,
                      "is absent, and a log drives other motors: all follow one, or none",
                      "Add --map reference_" + motor + "=COLUMN or --map told_torque_" + motor +
                          "=COLUMN, or leave out those of the others."});
  }
  return legs;
}

// A shift of what no column is taken for would be lost.
void CheckShifts(const TraceOptions& options, const ColumnMap& map) {
  for (const auto& shift : options.shifts) {
    const ColumnTarget& target = shift.first;
    const bool mapped = std::any_of(map.columns.begin(), map.columns.end(),
                                    [&](const MappedColumn& m) { return m.target == target; });
    if (mapped) continue;
    std::vector<std::string> known;
    for (const MappedColumn& m : map.columns) known.push_back(WordOf(m.target));
    throw InputError({"--shift", WordOf(target), "no column is taken for it",
                      "There are: " + Join(known) + "."});
  }
}

class Importer {
 public:
  explicit Importer(const ImportRequest& request) : request_(request), entries_(request.map) {}

  ImportResult Import() {
    for (const LogRequest& log : request_.logs) AddLog(log);
    CheckSamples();
    WriteYaml();
    return std::move(result_);
  }

 private:
  void AddLog(const LogRequest& log) {
    Table table = ReadLog(log.file, request_.format.value_or(FormatOfFile(log.file)));
    for (const LogUnit& unit : request_.units) table.units.emplace(unit.dimension, unit.name);
    const bool first = result_.logs.empty();
    const ColumnMap map =
        ResolveColumns(table, entries_, request_.options.rate_hz.has_value(), request_.type);
    if (first) {
      CheckShifts(request_.options, map);
      Describe(table, map);
      FindMechanism(map);
      entries_ = EntriesOf(table, map);
    }
    for (const std::string& note : table.notes) result_.notes.push_back(table.file + ": " + note);
    for (const std::string& warning : map.warnings) result_.notes.push_back(warning);

    const std::vector<LogCut> cuts = log.cuts.empty() ? std::vector<LogCut>(1) : log.cuts;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const std::string part = cuts.size() > 1 ? "-" + std::to_string(i + 1) : "";
      AddTrial(table, map, log, cuts[i], TrialFileName(log.file, part));
    }
  }

  void FindMechanism(const ColumnMap& map) {
    const bool robot = map.IsRobots();
    result_.type = request_.type.value_or(robot ? MechanismKind::kRobot : MechanismKind::kCLeg);
    if (result_.type == MechanismKind::kRobot) {
      result_.legs = LegsOf(map, request_.legs);
    } else if (robot || request_.legs) {
      throw InputError({request_.legs ? "--legs" : "--type", NameOf(result_.type),
                        "only a robot has a pitch and several legs", "Say --type robot."});
    }
  }

  // The trial's trace, checked: should it be refused after all, its message is the format's own.
  void AddTrial(const Table& table, const ColumnMap& map, const LogRequest& log, const LogCut& cut,
                const std::string& file) {
    ImportedLog imported;
    imported.source = table.file;
    imported.file = file;
    imported.format = table.format;
    imported.role = log.role;
    TraceOptions options = request_.options;
    options.from_s = cut.from_s;
    options.to_s = cut.to_s;
    imported.trace = TraceOfTable(table, map, options);
    if (imported.trace.mended.any())
      result_.notes.push_back(table.file + ": " + imported.trace.mended.Text());
    const Trace trace = ParseTraceCsv(imported.trace.csv, imported.file);
    if (result_.legs > 0) initial_states_.push_back(StartOfTrace(trace, result_.legs));
    if (!result_.files.emplace(imported.file, std::move(imported.trace.csv)).second)
      throw InputError({table.file, imported.file, "is the trial of an earlier file already",
                        "Rename one of the two files."});
    result_.logs.push_back(std::move(imported));
  }

  void Describe(const Table& table, const ColumnMap& map) {
    result_.map = map;
    std::vector<bool> used(table.columns.size(), false);
    for (const MappedColumn& mapped : map.columns) {
      result_.columns.push_back(table.columns[mapped.column].name);
      result_.map_texts.push_back(MapText(table, mapped));
      used[mapped.column] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i]) result_.unused.push_back(table.columns[i].name);
  }

  // A channel may be missing in some logs, not in all.
  void CheckSamples() const {
    for (std::size_t i = 0; i < result_.columns.size(); ++i) {
      const ColumnTarget& target = result_.map.columns[i].target;
      if (target.IsTime()) continue;
      const bool found =
          std::any_of(result_.logs.begin(), result_.logs.end(), [&](const ImportedLog& log) {
            const auto missing = log.trace.missing.find(target);
            return missing == log.trace.missing.end() || missing->second < log.trace.rows;
          });
      if (!found)
        throw InputError({result_.logs.front().source, "column " + Printable(result_.columns[i]),
                          "has no sample at all",
                          "Map another column to " + TargetName(target) + " or leave it out."});
    }
  }

  void WriteYaml() {
    DatasetText text;
    text.name = request_.name;
    text.type = result_.type;
    text.legs = result_.legs;
    text.values = request_.values;
    for (std::size_t i = 0; i < result_.columns.size(); ++i) {
      const MappedColumn& mapped = result_.map.columns[i];
      text.note += (i == 0 ? "imported: " : ", ") + TargetName(mapped.target) + " = " +
                   (mapped.negate ? "-" : "") + Printable(result_.columns[i], 200) +
                   (mapped.unit.dimension == Dimension::kNone ? "" : " in " + mapped.unit.name);
      if (mapped.target.channel) text.channels.push_back(*mapped.target.channel);
      if (mapped.target.input) text.inputs.push_back(*mapped.target.input);
    }
    for (const ImportedLog& log : result_.logs)
      if (log.trace.mended.any())
        text.note += "; stamps of " + log.file + " mended: " + log.trace.mended.Text();
    std::sort(text.channels.begin(), text.channels.end());
    std::sort(text.inputs.begin(), text.inputs.end());
    for (std::size_t i = 0; i < result_.logs.size(); ++i)
      text.trials.push_back({result_.logs[i].file, result_.logs[i].role,
                             initial_states_.empty() ? RobotTrial{} : initial_states_[i]});
    // With samples in the blanks it must be a dataset like any other.
    ReadDatasetText(FormatDatasetText(text, Blanks::kSamples), result_.files, request_.name);
    std::string yaml = FormatDatasetText(text, Blanks::kBlank);
    result_.blanks = FindBlankValues(ParseYaml(yaml, "dataset.yaml"));
    result_.files["dataset.yaml"] = std::move(yaml);
  }

  const ImportRequest& request_;
  std::vector<MapEntry> entries_;
  std::vector<RobotTrial> initial_states_;  // of a robot's logs
  ImportResult result_;
};

}  // namespace

ImportResult ImportLogs(const ImportRequest& request) { return Importer(request).Import(); }

}  // namespace hoplab
