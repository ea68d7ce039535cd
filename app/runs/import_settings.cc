#include "app/runs/import_settings.h"

#include <algorithm>
#include <cmath>

#include "app/terminal/help_text.h"
#include "app/terminal/usage_error.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/decimal.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

// "FILE=WHAT" of an option that may be given for one of several files; without "FILE=" all of them.
struct ForFile {
  std::string file, what;
};
ForFile SplitForFile(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) return {"", text};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

// The logs an option means, by their path or by their name alone.
std::vector<LogRequest*> LogsOf(std::vector<LogRequest>& logs, const std::string& file,
                                const std::string& option) {
  std::vector<LogRequest*> meant;
  std::vector<std::string> known;
  for (LogRequest& log : logs) {
    known.push_back(log.file.filename().string());
    if (file.empty() || log.file == file || log.file.filename() == file) meant.push_back(&log);
  }
  if (meant.empty())
    throw InputError(
        {option, Printable(file), "is none of the files to import", DidYouMean(file, known)});
  return meant;
}

// "0.4:1.9"; either end may be empty.
LogCut ParseCut(const std::string& span, const std::string& option) {
  const std::size_t colon = std::min(span.find(':'), span.size());
  const std::string ends[] = {span.substr(0, colon),
                              colon < span.size() ? span.substr(colon + 1) : "?"};
  LogCut cut;
  for (const auto& [text, end] : {std::pair(ends[0], &cut.from_s), std::pair(ends[1], &cut.to_s)}) {
    if (Trim(text).empty()) continue;
    *end = ParseDouble(text);
    if (!*end)
      throw UsageError("--cut: " + Printable(option) + "; must be FROM:TO in seconds, as 0.4:1.9");
  }
  if (cut.from_s && cut.to_s && !(*cut.from_s < *cut.to_s))
    throw UsageError("--cut: " + Printable(option) + "; must end after it begins");
  return cut;
}

std::vector<LogRequest> LogsOf(const ImportSettings& settings) {
  std::vector<LogRequest> logs;
  for (const std::string& file : settings.logs) logs.push_back({file});
  for (const std::string& text : settings.role) {
    const auto [file, role] = SplitForFile(text);
    if (file.empty() || (role != "train" && role != "test"))
      throw UsageError("--role: " + Printable(text) + "; must be FILE=train or FILE=test");
    for (LogRequest* log : LogsOf(logs, file, "--role"))
      log->role = role == "test" ? TrialRole::kTest : TrialRole::kTrain;
  }
  for (const std::string& text : settings.cut) {
    const auto [file, span] = SplitForFile(text);
    const LogCut cut = ParseCut(span, text);
    for (LogRequest* log : LogsOf(logs, file, "--cut")) log->cuts.push_back(cut);
  }
  return logs;
}

// CHANNEL=NUMBER[:UNIT]
void AddShift(const std::string& text, TraceOptions* options) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw UsageError("--shift: " + Printable(text) + "; must be CHANNEL=NUMBER:UNIT, as y=-35:mm");
  const ColumnTarget target = TargetOfWord(text.substr(0, equals), "--shift");
  const std::string amount = text.substr(equals + 1);
  const std::size_t colon = std::min(amount.find(':'), amount.size());
  const std::string number(Trim(std::string_view(amount).substr(0, colon)));
  const std::optional<double> value = ParseDouble(number);
  if (!value || !std::isfinite(*value))
    throw UsageError("--shift: " + Printable(text) + "; must be CHANNEL=NUMBER:UNIT, as y=-35:mm");
  const Dimension dimension = TargetDimension(target);
  const std::optional<LogUnit> unit = colon < amount.size()
                                          ? FindUnit(amount.substr(colon + 1))
                                          : FindUnit(UnitNames(dimension).front());
  if (!unit || unit->dimension != dimension)
    throw InputError({"--shift", Printable(text),
                      TargetName(target) + " is " + DimensionName(dimension),
                      "Units: " + Join(UnitNames(dimension)) + "."});
  if (!options->shifts.emplace(target, ToSi(number, *unit)).second)
    throw InputError({"--shift", TargetName(target), "is given twice", "Remove one of the two."});
}

std::vector<std::string> TypeNames() {
  std::vector<std::string> names;
  for (const MechanismKind type : kMechanisms) names.emplace_back(NameOf(type));
  return names;
}

// One a kind: "deg", "mm", "N m".
std::vector<LogUnit> UnitsOf(const ImportSettings& settings) {
  std::vector<LogUnit> units;
  for (const std::string& text : settings.unit) {
    const std::optional<LogUnit> unit = FindUnit(text);
    if (!unit || unit->dimension == Dimension::kNone)
      throw InputError({"--unit", Printable(text), "is no unit that is known",
                        "As --unit deg, --unit mm or --unit 'N m'."});
    for (const LogUnit& other : units)
      if (other.dimension == unit->dimension)
        throw InputError(
            {"--unit", Printable(text),
             std::string("is ") + DimensionName(unit->dimension) + ", and so is " + other.name,
             "Say one for all, and the others by --map."});
    units.push_back(*unit);
  }
  return units;
}

}  // namespace

void AddImportOptions(CLI::App& sub, ImportSettings& settings) {
  const auto list = [&](const char* name, std::vector<std::string>& to, const char* what,
                        const char* text) {
    sub.add_option(name, to, what)->option_text(text)->allow_extra_args(false);
  };
  sub.add_option("FILE", settings.logs, "Recordings, one a trial")->required();
  list("--map", settings.map, "A channel's column, sign and unit, as y=-Z:mm; repeatable",
       "CHANNEL=[-]COLUMN[:UNIT]");
  sub.add_flag("--accept-guesses", settings.accept_guesses,
               "Take what --map does not say as guessed; without it the guesses are shown");
  sub.add_option("--rate", settings.rate_hz, "Samples a second, where the file has no times")
      ->check(NumberAbove0(1e6, 1e-6))
      ->option_text("HZ");
  list("--cut", settings.cut,
       "Keep these seconds of the log's clock; each repetition makes a trial", "[FILE=]FROM:TO");
  list("--shift", settings.shift, "Add to a channel, as y=-35:mm", "CHANNEL=NUMBER[:UNIT]");
  sub.add_flag("--zero-time", settings.zero_time, "Let time begin at the first row kept");
  sub.add_flag("--mend-times", settings.mend_times, "Mend repeated and swapped stamps");
  list("--role", settings.role, "train (default) or test", "FILE=ROLE");
  list("--unit", settings.unit, "Of columns whose unit stands nowhere: deg, mm, 'N m'", "UNIT");
  sub.add_option("--type", settings.type,
                 "c_leg, straight_leg, ball or robot (default: robot or c_leg, by the columns)")
      ->check(OneOf(TypeNames()))
      ->option_text("MECHANISM");
  sub.add_option("--legs", settings.legs, "Of a robot (default: as many as have columns)")
      ->check(CLI::Range(1, 4))
      ->option_text("N");
  list("--set", settings.set, "A value a fit needs, as mechanism.body_mass_kg=1.01", "KEY=VALUE");
  sub.add_option("--format", settings.format,
                 "csv, motive, trc, sto, mat or hdf5 (default: by the file)")
      ->check(OneOf(LogFormatNames()))
      ->option_text("NAME");
  sub.add_option("--name", settings.name, "Of the dataset (default: its folder's)")
      ->option_text("TEXT");
  sub.add_option("--out", settings.out, "Folder of the new dataset")
      ->required()
      ->option_text("DATASET");
  sub.add_flag("--force", settings.force, "Replace the dataset that stands there");
}

ImportRequest ImportRequestOf(const ImportSettings& settings) {
  ImportRequest request;
  request.logs = LogsOf(settings);
  for (const MechanismKind type : kMechanisms)
    if (settings.type == NameOf(type)) request.type = type;
  request.legs = settings.legs;
  request.units = UnitsOf(settings);
  request.name = settings.name;
  if (request.name.empty()) {
    std::filesystem::path folder(settings.out);
    if (!folder.has_filename()) folder = folder.parent_path();
    request.name = folder.filename().string();
  }
  if (!settings.format.empty()) {
    const std::vector<std::string> names = LogFormatNames();
    request.format = static_cast<LogFormat>(std::find(names.begin(), names.end(), settings.format) -
                                            names.begin());
  }
  for (const std::string& text : settings.map) {
    const std::optional<MapEntry> entry = ParseMapEntry(text);
    if (!entry)
      throw UsageError("--map: " + Printable(text) +
                       "; must be CHANNEL=COLUMN:UNIT, as y=z:mm or x=-Z:mm");
    request.map.push_back(*entry);
  }
  request.options.rate_hz = settings.rate_hz;
  request.options.zero_time = settings.zero_time;
  request.options.mend_times = settings.mend_times;
  for (const std::string& text : settings.shift) AddShift(text, &request.options);
  for (const std::string& text : settings.set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--set: " + Printable(text) +
                       "; must be key=value, as mechanism.body_mass_kg=1.01");
    request.values.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return request;
}

}  // namespace hoplab
