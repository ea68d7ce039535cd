#include "datasets/read_dataset.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <system_error>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/blank_values.h"
#include "datasets/read_record.h"
#include "datasets/read_spec.h"
#include "datasets/text_file.h"
#include "datasets/yaml_cursor.h"
#include "datasets/yaml_tree.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatasetFormat = "hoplab-dataset/1";
constexpr const char* kYamlName = "dataset.yaml";
constexpr std::uint64_t kMaxCsvBytes = 64ull << 20;       // one trial, about a million rows
constexpr std::uint64_t kMaxDatasetBytes = 512ull << 20;  // all trials
constexpr std::size_t kMaxTrials = 10'000;

// Where the files of a dataset come from.
struct FileSource {
  // Bytes of a file whose name has been checked; throws at `file`'s place if there is none.
  std::function<std::string(const std::string& name, const YamlCursor& file)> read;
  std::string place;  // what stands before a file's name in messages, "/" included
};

[[noreturn]] void NoSuchFile(const YamlCursor& file, const std::string& name,
                             const std::vector<std::string>& present) {
  const std::optional<std::string> nearest = NearestWord(name, present);
  file.Fail("there is no such file in the dataset",
            nearest ? "Did you mean " + *nearest + "?" : "Add the file or remove the trial.");
}

// The name of a trial's file, in one spelling; it cannot leave the folder by its text.
std::string ReadFileName(const YamlCursor& file) {
  const std::string text = file.Name();
  const std::string rule = "must lie in the dataset's folder";
  const std::string remedy = "Move the file there and give its name relative to the folder.";
  const bool drive = text.size() > 1 && text[1] == ':';
  if (text.front() == '/' || drive) file.Fail(rule + ", and this path is absolute", remedy);
  if (text.find('\\') != text.npos) file.Fail("must be written with /", "Replace \\ by /.");
  const fs::path path(text);
  if (std::find(path.begin(), path.end(), "..") != path.end())
    file.Fail(rule + ", and this path goes up by ..", remedy);
  const fs::path normal = path.lexically_normal();
  if (!normal.has_filename() || normal == ".")
    file.Fail("must name a file", "Give the name of the trial's CSV file.");
  if (normal == kYamlName)
    file.Fail("must be a trial's CSV file", "Give the name of the trial's CSV file.");
  return normal.generic_string();
}

// Follows symbolic links and throws if they end outside `folder`.
void CheckInside(const fs::path& folder, const fs::path& path,
                 const std::function<void()>& fail_outside) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  const fs::path target = fs::weakly_canonical(path, error);
  const auto [in_root, in_target] =
      std::mismatch(root.begin(), root.end(), target.begin(), target.end());
  if (error || in_root != root.end()) fail_outside();
}

std::string ReadTrialFile(const fs::path& folder, const std::string& name, const YamlCursor& file) {
  const fs::path path = folder / name;
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) {
    std::vector<std::string> present;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
      if (it->path().filename() != kYamlName && present.size() < 1000)
        present.push_back(it->path().filename().string());
    }
    NoSuchFile(file, name, present);
  }
  CheckInside(folder, path, [&] {
    file.Fail("must lie in the dataset's folder, and this is a link that leads out of it",
              "Put the file itself there.");
  });
  if (!fs::is_regular_file(path, error))
    file.Fail("must be a file, and is a folder, a device or a link to nothing",
              "Give the name of the trial's CSV file.");
  return ReadFileBytes(path, kMaxCsvBytes);
}

class DatasetReader {
 public:
  DatasetReader(const YamlNode& root, const FileSource& files) : root_(root, ""), files_(files) {}

  Dataset Read() {
    if (root_.node().kind == YamlNode::Kind::kNull)
      root_.Fail("is empty; must begin with format: hoplab-dataset/1",
                 "See datasets/README.md for an example.");
    // The format first: a file of another format has other keys.
    CheckFormat(root_, kDatasetFormat);
    root_.AllowOnly({"format", "name", "title", "source", "mechanism", "controller", "initial",
                     "initial_sigma", "channels", "clocks", "inputs", "known", "effects",
                     "trials"});
    CheckNothingIsBlank(root_.node());
    dataset_.origin.place = files_.place + kYamlName;
    dataset_.name = root_.Required("name", "a short name").Name();
    dataset_.title = root_.OptionalText("title");
    if (const auto source = root_.Optional("source")) ReadSource(*source);
    const YamlCursor mechanism = root_.Required("mechanism", "a block that begins with type");
    dataset_.mechanism = InItsAir(ReadMechanism(mechanism));
    if (const auto controller = root_.Optional("controller"))
      dataset_.controller = ReadController(*controller);
    dataset_.channels = ReadChannels(
        root_.Required("channels", "the measured columns, as {body_y_m: {sigma: 0.001}}"));
    if (const auto clocks = root_.Optional("clocks")) dataset_.clocks = ReadClocks(*clocks);
    if (const auto inputs = root_.Optional("inputs")) dataset_.inputs = ReadInputs(*inputs);
    if (const auto known = root_.Optional("known")) dataset_.known = ReadKnown(*known);
    if (const auto effects = root_.Optional("effects")) ReadEffects(*effects);
    ReadTrials();
    CheckChannels();
    CheckRoles(dataset_);
    return std::move(dataset_);
  }

 private:
  void ReadSource(const YamlCursor& source) {
    source.AllowOnly({"kind", "by", "licence", "note"});
    dataset_.source.kind = static_cast<SourceKind>(
        1 + source.Required("kind", "recorded or simulated").Choice({"recorded", "simulated"}));
    dataset_.source.by = source.OptionalText("by");
    dataset_.source.licence = source.OptionalText("licence");
    dataset_.source.note = source.OptionalText("note");
  }

  // A ball that was recorded flew in air.
  MechanismSpec InItsAir(MechanismSpec mechanism) const {
    std::optional<double>& air = mechanism.ball.air_density_kg_per_m3;
    if (mechanism.type == MechanismKind::kBall && dataset_.source.kind == SourceKind::kRecorded)
      air = air.value_or(kUsualAirDensity);
    return mechanism;
  }

  // A list of files of formulas, in the dataset's folder, or of formulas themselves.
  void ReadEffects(const YamlCursor& effects) {
    constexpr std::size_t kMost = 16;
    const std::vector<YamlCursor> items = effects.Items(1);
    if (items.size() > kMost)
      effects.Fail("must have at most " + std::to_string(kMost) + " items",
                   "Leave out those that are not asked about.");
    for (const YamlCursor& item : items) {
      if (item.node().kind == YamlNode::Kind::kMap) {
        dataset_.effects.push_back(ReadEffectBlock(item));
        continue;
      }
      const std::string name = ReadFileName(item);
      if (!IsEffectFile(name))
        item.Fail("must be a file of the format hoplab-effect/1, as umbilical.yaml",
                  "Effects of the catalogue are known without being named here.");
      dataset_.effects.push_back(ParseEffectFile(files_.read(name, item), files_.place + name));
    }
  }

  void ReadTrials() {
    const YamlCursor trials = root_.Required("trials", "a list with file and role of each trial");
    const std::vector<YamlCursor> items = trials.Items(1);
    if (items.size() > kMaxTrials)
      trials.Fail("must have at most " + std::to_string(kMaxTrials) + " items",
                  "Split the dataset.");
    // All of dataset.yaml is checked before the first CSV is opened.
    for (const YamlCursor& item : items) dataset_.trials.push_back(ReadTrial(item));
    const bool has_train = std::any_of(dataset_.trials.begin(), dataset_.trials.end(),
                                       [](const Trial& t) { return t.role == TrialRole::kTrain; });
    if (!has_train)
      throw InputError({trials.place(), "trials", "at least one trial must have role: train",
                        "Change the role of the trials to fit."});
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const YamlCursor file = items[i].Required("file", "the name of its CSV file");
      const std::string csv = files_.read(dataset_.trials[i].file, file);
      total += csv.size();
      if (csv.size() > kMaxCsvBytes || total > kMaxDatasetBytes)
        file.Fail("a trial must have at most " + std::to_string(kMaxCsvBytes) +
                      " bytes, a dataset " + std::to_string(kMaxDatasetBytes),
                  "Cut the recording or lower its sample rate.");
      const std::string place = files_.place + dataset_.trials[i].file;
      dataset_.trials[i].trace = ParseTraceCsv(csv, place);
      CompleteWithTrace(dataset_.trials[i], place);
    }
  }

  Trial ReadTrial(const YamlCursor& item) {
    item.AllowOnly({"file", "role", "touchdown_angle_deg", "touchdown_angle_sigma_deg", "initial",
                    "initial_sigma", "mechanism", "controller", "inputs"});
    Trial trial;
    trial.origin.place = item.place();
    const YamlCursor file = item.Required("file", "the name of its CSV file");
    trial.file = ReadFileName(file);
    if (!names_.insert(trial.file).second)
      file.Fail("is the file of an earlier trial already", "Remove one of the two trials.");
    trial.role = ReadRole(item.Required("role", "train or test"));
    trial.mechanism =
        InItsAir(ReadTrialMechanism(item, *root_.node().Find("mechanism"), dataset_.mechanism));
    const YamlNode& root = root_.node();
    trial.inputs = ReadOver(item, "inputs", root.Find("inputs"), ReadInputs).value_or(Inputs());
    ReadTouchdownAngles(item, trial);
    trial.controller = ReadOver(item, "controller", root.Find("controller"), ReadController);
    trial.initial = ReadOver(item, "initial", root.Find("initial"), ReadState);
    trial.initial_sigma =
        ReadOver(item, "initial_sigma", root.Find("initial_sigma"), ReadStateSigma);
    if (trial.initial) CheckStart(item, *trial.initial, trial.mechanism);
    CheckDriven(item, trial);
    return trial;
  }

  void CheckChannels() const {
    for (const ChannelSpec& channel : dataset_.channels) {
      bool found = false;
      std::set<std::string> others;
      for (const Trial& trial : dataset_.trials) {
        for (const TraceColumn& column : trial.trace.columns)
          if (!ChannelFromName(column.name)) others.insert(column.name);
        const std::vector<double>* values = trial.trace.Find(channel.id);
        if (values == nullptr) continue;
        found = std::any_of(values->begin(), values->end(),
                            [](double value) { return !std::isnan(value); });
        if (found) break;
      }
      if (found) continue;
      const std::string name = ChannelName(channel.id);
      const auto nearest = NearestWord(name, {others.begin(), others.end()});
      throw InputError(
          {channel.origin.place, "channels." + name, "no trial has a sample of this column",
           nearest ? "Is the column " + Printable(*nearest) + " meant? Rename it in the files."
                   : "Remove the channel or add the column to the files."});
    }
  }

  using Inputs = std::vector<InputSpec>;

  YamlCursor root_;
  const FileSource& files_;
  Dataset dataset_;
  std::set<std::string> names_;
};

}  // namespace

Dataset ReadDataset(const fs::path& folder) {
  std::error_code error;
  const std::string shown = folder.string();
  const fs::path yaml = folder / kYamlName;
  if (!fs::exists(folder, error))
    throw InputError(
        {shown, "", "there is no such folder", NearestPath(folder, "Check the path.")});
  if (!fs::is_directory(folder, error))
    throw InputError({shown, "", "must be a folder with a dataset.yaml, and is a file",
                      folder.filename() == kYamlName ? "Give the folder it lies in."
                                                     : "Give the dataset's folder."});
  if (!fs::exists(yaml, error))
    throw InputError({shown, "", "is no dataset: it has no dataset.yaml",
                      "Give the folder that holds dataset.yaml."});
  CheckInside(folder, yaml, [&] {
    throw InputError({yaml.string(), "", "is a link that leads out of the dataset's folder",
                      "Put the file itself there."});
  });
  const YamlLimits limits;
  const YamlNode root =
      ParseYaml(ReadFileBytes(yaml, limits.max_bytes, kSamplesElsewhere), yaml.string(), limits);
  FileSource files;
  files.place = (folder / "").string();
  files.read = [&](const std::string& name, const YamlCursor& file) {
    return ReadTrialFile(folder, name, file);
  };
  return DatasetReader(root, files).Read();
}

Dataset ReadDatasetText(const std::string& yaml, const std::map<std::string, std::string>& texts,
                        const std::string& place) {
  FileSource files;
  files.place = place.empty() ? "" : place + "/";
  files.read = [&](const std::string& name, const YamlCursor& file) {
    const auto found = texts.find(name);
    if (found != texts.end()) return found->second;
    std::vector<std::string> present;
    for (const auto& [known, text] : texts) present.push_back(known);
    NoSuchFile(file, name, present);
  };
  const YamlNode root = ParseYaml(yaml, files.place + kYamlName);
  return DatasetReader(root, files).Read();
}

}  // namespace hoplab
