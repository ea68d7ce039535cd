#include "datasets/import/import.h"

#include <algorithm>
#include <chrono>
#include <ostream>

#include "app/records/run_record.h"
#include "app/terminal/command.h"
#include "app/terminal/help_text.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "app/terminal/usage_error.h"
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/decimal.h"
#include "datasets/read_spec.h"

namespace hoplab {
namespace {

struct ImportSettings {
  std::vector<std::string> logs, map, cut, role, shift, set;
  std::string out, name, format;
  std::string type = "c_leg";
  std::optional<double> rate_hz;
  bool accept_guesses = false, zero_time = false, mend_times = false, force = false, json = false;
};

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
  const std::optional<ChannelId> channel = ChannelOfWord(text.substr(0, equals), "--shift");
  const std::string amount = text.substr(equals + 1);
  const std::size_t colon = std::min(amount.find(':'), amount.size());
  const std::string number(Trim(std::string_view(amount).substr(0, colon)));
  const std::optional<double> value = ParseDouble(number);
  if (!value || !std::isfinite(*value))
    throw UsageError("--shift: " + Printable(text) + "; must be CHANNEL=NUMBER:UNIT, as y=-35:mm");
  const Dimension dimension = TargetDimension(channel);
  const std::optional<Unit> unit = colon < amount.size() ? FindUnit(amount.substr(colon + 1))
                                                         : FindUnit(UnitNames(dimension).front());
  if (!unit || unit->dimension != dimension)
    throw InputError({"--shift", Printable(text),
                      TargetName(channel) + " is " + DimensionName(dimension),
                      "Units: " + Join(UnitNames(dimension)) + "."});
  options->shifts[channel] = ToSi(number, *unit);
}

MechanismType TypeOf(const std::string& word) {
  return word == "ball"           ? MechanismType::kBall
         : word == "straight_leg" ? MechanismType::kStraightLeg
                                  : MechanismType::kCLeg;
}

ImportRequest RequestOf(const ImportSettings& settings) {
  ImportRequest request;
  request.logs = LogsOf(settings);
  request.type = TypeOf(settings.type);
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

std::vector<std::string> MapTable(const ImportResult& made) {
  using enum TextTable::Align;
  TextTable table({kLeft, kLeft, kLeft, kLeft, kLeft});
  table.AddRow({"channel", "column", "in", "", "why"});
  for (std::size_t i = 0; i < made.columns.size(); ++i) {
    const MappedColumn& mapped = made.map.columns[i];
    table.AddRow({TargetName(mapped.channel),
                  (mapped.negate ? "-" : "") + Printable(made.columns[i]), mapped.unit.name,
                  mapped.guessed ? "guessed" : "", mapped.guessed ? mapped.why : ""});
  }
  return table.Lines();
}

// One word of a command line, in quotes where it has to be.
std::string ShellWord(const std::string& text) {
  const bool plain = text.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                         "0123456789._-=:/,+@%") == std::string::npos;
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// Shows the guesses and ends the command: nothing is made of what nobody has looked at.
[[noreturn]] void AskForConsent(const ImportResult& made, const Console& console) {
  for (const std::string& line : MapTable(made)) console.err << line << '\n';
  if (!made.unused.empty())
    console.err << "  not used: " << Printable(Join(made.unused), 400) << '\n';
  console.err << "  in words:";
  for (const std::string& text : made.map_texts) console.err << " --map " << ShellWord(text);
  console.err << '\n';
  throw UsageError(
      "columns or units are guessed, so nothing was written. Add --accept-guesses if they are "
      "right, or say them by --map.");
}

Json RecordOf(const ImportRequest& request, const ImportSettings& settings,
              const ImportResult& made) {
  RecordHeader header;
  header.command = "import";
  header.dataset = request.name;
  header.options = {{"files", settings.logs},
                    {"map", made.map_texts},
                    {"cut", settings.cut},
                    {"shift", settings.shift},
                    {"zero_time", settings.zero_time},
                    {"mend_times", settings.mend_times},
                    {"rate_hz", NumberOrNull(settings.rate_hz)},
                    {"type", settings.type},
                    {"set", settings.set}};
  Json record = NewRecord(header);
  record["notes"] = made.notes;
  record["columns"] = Json::array();
  for (std::size_t i = 0; i < made.columns.size(); ++i) {
    const MappedColumn& mapped = made.map.columns[i];
    record["columns"].push_back({{"channel", TargetName(mapped.channel)},
                                 {"column", made.columns[i]},
                                 {"unit", mapped.unit.name},
                                 {"negated", mapped.negate},
                                 {"guessed", mapped.guessed},
                                 {"why", mapped.why}});
  }
  record["unused"] = made.unused;
  record["trials"] = Json::array();
  for (const ImportedLog& log : made.logs) {
    Json missing = Json::object();
    for (const auto& [channel, count] : log.trace.missing) missing[ChannelName(channel)] = count;
    record["trials"].push_back({{"file", log.file},
                                {"source", log.source},
                                {"format", log.format},
                                {"role", RoleName(log.role)},
                                {"rows", log.trace.rows},
                                {"missing", missing},
                                {"mended",
                                 {{"swapped", log.trace.mended.swapped},
                                  {"dropped", log.trace.mended.dropped},
                                  {"spread", log.trace.mended.spread}}}});
  }
  record["blank"] = Json::array();
  for (const BlankValue& blank : made.blanks) record["blank"].push_back(blank.key);
  return record;
}

void Print(const ImportRequest& request, const std::string& out, const ImportResult& made,
           const Console& console) {
  using enum TextTable::Align;
  console.out << Styled(request.name, Emphasis::kBold, console.out_colours) << "\n\n";
  console.out << WithHeader(MapTable(made), console.out_colours) << '\n';
  TextTable trials({kLeft, kLeft, kLeft, kRight, kRight, kLeft});
  trials.AddRow({"trial", "role", "from", "rows", "seconds", "missing samples"});
  for (const ImportedLog& log : made.logs) {
    std::string missing;
    for (const auto& [channel, count] : log.trace.missing)
      missing += (missing.empty() ? "" : ", ") + std::to_string(count) + " of " +
                 WithoutUnit(ChannelName(channel));
    trials.AddRow({log.file, RoleName(log.role), log.format, std::to_string(log.trace.rows),
                   Fixed(log.trace.last_s - log.trace.first_s, 3), missing});
  }
  console.out << WithHeader(trials.Lines(), console.out_colours) << '\n';
  console.out << "  dataset     " << out << '\n';
  if (made.blanks.empty()) return;
  console.out << "  to fill in  " << made.blanks.size() << " values in "
              << (std::filesystem::path(out) / "dataset.yaml").string() << ": hoplab check "
              << ShellWord(out) << " lists them\n";
}

ExitCode RunImport(const ImportSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  const ImportRequest request = RequestOf(settings);
  const OverwriteOptions overwrite{settings.force, "dataset.yaml"};
  CheckFolderIsFree(settings.out, overwrite);
  const ImportResult made = ImportLogs(request);
  for (const std::string& note : made.notes) console.err << "note: " << note << '\n';
  if (made.map.HasGuesses() && !settings.accept_guesses) AskForConsent(made, console);
  WriteFolderAtomically(
      settings.out,
      [&](const std::filesystem::path& staged) {
        for (const auto& [name, text] : made.files) WriteFileAtomically(staged / name, text);
      },
      overwrite);
  if (settings.json) {
    Json record = RecordOf(request, settings, made);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    record["seconds"] = took.count();
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  Print(request, settings.out, made, console);
  return ExitCode::kDone;
}

void AddImport(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ImportSettings>();
  const auto list = [&](const char* name, std::vector<std::string>& to, const char* what,
                        const char* text) {
    sub.add_option(name, to, what)->option_text(text)->allow_extra_args(false);
  };
  sub.add_option("FILE", settings->logs, "Recordings, one a trial")->required();
  list("--map", settings->map, "A channel's column, sign and unit, as y=-Z:mm; repeatable",
       "CHANNEL=[-]COLUMN[:UNIT]");
  sub.add_flag("--accept-guesses", settings->accept_guesses,
               "Take what --map does not say as guessed; without it the guesses are shown");
  sub.add_option("--rate", settings->rate_hz, "Samples a second, where the file has no times")
      ->check(CLI::PositiveNumber)
      ->option_text("HZ");
  list("--cut", settings->cut,
       "Keep these seconds of the log's clock; each repetition makes a trial", "[FILE=]FROM:TO");
  list("--shift", settings->shift, "Add to a channel, as y=-35:mm", "CHANNEL=NUMBER[:UNIT]");
  sub.add_flag("--zero-time", settings->zero_time, "Let time begin at the first row kept");
  list("--role", settings->role, "train (default) or test", "FILE=ROLE");
  sub.add_option("--type", settings->type, "c_leg (default), straight_leg or ball")
      ->check(OneOf({"c_leg", "straight_leg", "ball"}))
      ->option_text("MECHANISM");
  list("--set", settings->set, "A value a fit needs, as mechanism.body_mass_kg=1.01", "KEY=VALUE");
  sub.add_option("--format", settings->format,
                 "csv, motive, trc, sto, mat or hdf5 (default: by the file)")
      ->check(OneOf(LogFormatNames()))
      ->option_text("NAME");
  sub.add_option("--name", settings->name, "Of the dataset (default: its folder's)")
      ->option_text("TEXT");
  sub.add_option("--out", settings->out, "Folder of the new dataset")
      ->required()
      ->option_text("DATASET");
  sub.add_flag("--force", settings->force, "Replace the dataset that stands there");
  OnParsed(sub, invocation, settings, RunImport);
}

}  // namespace

namespace commands {
extern constexpr Command import = {
    .place = 10,
    .name = "import",
    .what = "Make a dataset of recordings: CSV, Motive, OpenSim, MATLAB, HDF5",
    .footer =
        "Channels: t x y vx vy ax ay leg_angle leg_length fx fy torque contact, ..\n"
        "Without --accept-guesses it shows what it would take for what.\n"
        "Examples:\n"
        "  hoplab import docs/tutorial/run-1.csv --accept-guesses --out mine\n"
        "  hoplab import run17.csv run18.csv --map t=Time:ms --map y=z:mm --out mine",
    .add = AddImport};
}  // namespace commands
}  // namespace hoplab
