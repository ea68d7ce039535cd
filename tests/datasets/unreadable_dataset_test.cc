// Files that are no text, no YAML, no dataset of this format, or not files at all: the whole
// message is compared.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "datasets/read_dataset.h"
#include "tests/datasets/small_dataset.h"
#include "tests/support/input_error_of.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;
using testing::ErrorOf;
using testing::ErrorWithCsv;
using testing::ErrorWithYaml;
using testing::InputErrorOf;
using testing::kCsv;
using testing::kYaml;
using testing::Replace;
using testing::TempFolder;
using testing::WriteText;

using testing::WriteText;

// ---- files that are no text, no YAML, no dataset

TEST(BadDataset, AnEmptyDatasetFileIsReported) {
  EXPECT_EQ(ErrorOf(""),
            "hops/dataset.yaml: is empty; must begin with format: hoplab-dataset/1. "
            "See datasets/README.md for an example.");
}

TEST(BadDataset, ANulByteIsNoText) {
  EXPECT_EQ(ErrorOf(Replace(kYaml, "hops", std::string("ho\0ps", 5))),
            "hops/dataset.yaml:2: is no UTF-8 text (a NUL byte). Save the file as plain text in "
            "UTF-8.");
}

TEST(BadDataset, AControlCharacterIsNoText) {
  EXPECT_EQ(
      ErrorWithYaml("hops", "ho\x04ps"),
      "hops/dataset.yaml:2: is no UTF-8 text (a control character). Save the file as plain text "
      "in UTF-8.");
}

TEST(BadDataset, InvalidUtf8IsNoText) {
  EXPECT_EQ(
      ErrorWithCsv("0.2995", "0.2995\xff"),
      "hops/a.csv:3: is no UTF-8 text (an invalid byte sequence). Save the file as plain text in "
      "UTF-8.");
}

TEST(BadDataset, Utf16IsNoUtf8) {
  EXPECT_EQ(
      ErrorOf(std::string("\xff\xfe"
                          "f\0o\0",
                          6)),
      "hops/dataset.yaml:1: is no UTF-8 text (it looks like UTF-16). Save the file as plain text "
      "in UTF-8.");
}

TEST(BadDataset, BrokenYamlIsReportedWithItsLine) {
  EXPECT_EQ(ErrorWithYaml("{sigma: 0.001}", "{sigma: 0.001"),
            "hops/dataset.yaml:16: is not valid YAML: end of map flow not found. "
            "Check indentation, brackets, quotes and colons near here.");
}

TEST(BadDataset, ASecondDocumentIsRefused) {
  EXPECT_EQ(ErrorOf(std::string(kYaml) + "---\nname: again\n"),
            "hops/dataset.yaml:25: a second document begins here, the file must hold one. "
            "Remove the line `---` or split the file.");
}

TEST(BadDataset, AnAliasBombIsRefusedBeforeItExpands) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 15; ++i) {
    const std::string below = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int j = 0; j < 10; ++j) bomb += (j > 0 ? ", " : "") + below;
    bomb += "]\n";
  }
  EXPECT_EQ(ErrorOf(bomb),
            "hops/dataset.yaml:5: with its aliases written out the file must have at most 100000 "
            "values and 4194304 bytes of text. Write the values out instead of nesting aliases.");
}

TEST(BadDataset, AnAliasBombOfLongTextIsRefused) {
  std::string bomb = "a: &a " + std::string(100'000, 'x') + "\nb: [*a";
  for (int i = 0; i < 1000; ++i) bomb += ", *a";
  EXPECT_EQ(ErrorOf(bomb + "]\n"),
            "hops/dataset.yaml:2: with its aliases written out the file must have at most 100000 "
            "values and 4194304 bytes of text. Write the values out instead of nesting aliases.");
}

TEST(BadDataset, AnAliasInsideWhatItNamesIsRefused) {
  EXPECT_EQ(
      ErrorOf("a: &a [*a]\n"),
      "hops/dataset.yaml:1: an alias may not stand inside what it names. Write the value out.");
}

TEST(BadDataset, DeepNestingIsRefused) {
  EXPECT_EQ(ErrorOf("name: " + std::string(100'000, '[') + std::string(100'000, ']')),
            "hops/dataset.yaml:1: is nested more than 24 deep. Check the brackets and the "
            "indentation.");
}

TEST(BadDataset, BracketsThatNobodyClosesAreRefused) {
  EXPECT_EQ(ErrorOf("name: " + std::string(100'000, '[')),
            "hops/dataset.yaml:1: a key must be plain text. Check the brackets and the colons.");
}

TEST(BadDataset, AYamlTagIsRefused) {
  EXPECT_EQ(ErrorWithYaml("name: hops", "name: !!python/object hops"),
            "hops/dataset.yaml:2: tag tag:yaml.org,2002:python/object; tags are not part of the "
            "format. Remove the tag.");
}

TEST(BadDataset, AKeyThatIsAListIsRefused) {
  EXPECT_EQ(ErrorWithYaml("name: hops", "name: hops\n? [a, b]\n: c"),
            "hops/dataset.yaml:3: a key must be plain text. Check the brackets and the colons.");
}

TEST(BadDataset, AnotherFormatVersionIsRefused) {
  EXPECT_EQ(ErrorWithYaml("hoplab-dataset/1", "hoplab-dataset/2"),
            "hops/dataset.yaml:1: format = hoplab-dataset/2; must be hoplab-dataset/1. "
            "Write format: hoplab-dataset/1.");
}

TEST(BadDataset, AScenarioIsToldWhatReadsIt) {
  EXPECT_EQ(ErrorWithYaml("hoplab-dataset/1", "hoplab-scenario/1"),
            "hops/dataset.yaml:1: format = hoplab-scenario/1; must be hoplab-dataset/1. "
            "This is a scenario: simulate, generate, gait, optimize and sweep read it.");
}

TEST(BadDataset, AYamlFileLargerThanTheLimitIsRefused) {
  EXPECT_EQ(ErrorOf(std::string(kYaml) + std::string(2'000'000, '#')),
            "hops/dataset.yaml: size = " + std::to_string(std::string(kYaml).size() + 2'000'000) +
                " bytes; must be at most 1048576 bytes. Samples belong into the CSV files.");
}

// ---- folders

class BadDatasetFolder : public ::testing::Test {
 protected:
  BadDatasetFolder() {
    WriteText(folder_ / "dataset.yaml", kYaml);
    WriteText(folder_ / "a.csv", kCsv);
    WriteText(folder_ / "b.csv", kCsv);
  }
  std::string Error() {
    return InputErrorOf([&] { ReadDataset(folder_); });
  }
  TempFolder temp_;
  fs::path folder_ = temp_.path() / "hops";
  std::string yaml_ = (folder_ / "dataset.yaml").string();
};

TEST_F(BadDatasetFolder, IsGoodToBeginWith) { EXPECT_EQ(Error(), "(no error)"); }

TEST_F(BadDatasetFolder, AFolderThatIsNotThereIsReported) {
  const fs::path absent = temp_.path() / "absent";
  EXPECT_EQ(InputErrorOf([&] { ReadDataset(absent); }),
            absent.string() + ": there is no such folder. Check the path.");
}

TEST_F(BadDatasetFolder, AMisspeltFolderIsGuessed) {
  const std::string remedy = ". Did you mean " + folder_.string() + "?";
  for (const char* misspelt : {"hpos", "hops1", "hpos/"}) {
    const fs::path absent = temp_.path() / misspelt;
    EXPECT_EQ(InputErrorOf([&] { ReadDataset(absent); }),
              absent.string() + ": there is no such folder" + remedy);
  }
}

TEST_F(BadDatasetFolder, TheYamlItselfIsNoFolder) {
  EXPECT_EQ(InputErrorOf([&] { ReadDataset(yaml_); }),
            yaml_ +
                ": must be a folder with a dataset.yaml, and is a file. "
                "Give the folder it lies in.");
}

TEST_F(BadDatasetFolder, AFolderWithoutADatasetIsReported) {
  EXPECT_EQ(InputErrorOf([&] { ReadDataset(temp_.path()); }),
            temp_.path().string() +
                ": is no dataset: it has no dataset.yaml. "
                "Give the folder that holds dataset.yaml.");
}

TEST_F(BadDatasetFolder, AMissingFileGetsTheNearestInTheFolder) {
  fs::rename(folder_ / "a.csv", folder_ / "aa.csv");
  EXPECT_EQ(Error(), yaml_ +
                         ":18: trials[0].file = a.csv; there is no such file in the dataset. "
                         "Did you mean aa.csv?");
}

TEST_F(BadDatasetFolder, ALinkOutOfTheFolderIsRefused) {
  WriteText(temp_.path() / "secret.csv", kCsv);
  fs::remove(folder_ / "a.csv");
  fs::create_symlink("../secret.csv", folder_ / "a.csv");
  EXPECT_EQ(Error(), yaml_ +
                         ":18: trials[0].file = a.csv; must lie in the dataset's folder, and this "
                         "is a link that leads out of it. Put the file itself there.");
}

TEST_F(BadDatasetFolder, ALinkedSubfolderOutOfTheFolderIsRefused) {
  WriteText(temp_.path() / "elsewhere" / "a.csv", kCsv);
  fs::create_directory_symlink(temp_.path() / "elsewhere", folder_ / "sub");
  WriteText(yaml_, Replace(kYaml, "a.csv", "sub/a.csv"));
  EXPECT_EQ(Error(),
            yaml_ +
                ":18: trials[0].file = sub/a.csv; must lie in the dataset's folder, and this is a "
                "link that leads out of it. Put the file itself there.");
}

TEST_F(BadDatasetFolder, ALinkedDatasetFileOutOfTheFolderIsRefused) {
  fs::rename(yaml_, temp_.path() / "other.yaml");
  fs::create_symlink("../other.yaml", yaml_);
  EXPECT_EQ(Error(), yaml_ +
                         ": is a link that leads out of the dataset's folder. "
                         "Put the file itself there.");
}

TEST_F(BadDatasetFolder, AFolderIsNoTrial) {
  fs::remove(folder_ / "a.csv");
  fs::create_directory(folder_ / "a.csv");
  EXPECT_EQ(Error(), yaml_ +
                         ":18: trials[0].file = a.csv; must be a file, and is a folder, a device "
                         "or a link to nothing. Give the name of the trial's CSV file.");
}

TEST_F(BadDatasetFolder, APipeIsNotWaitedFor) {
  fs::remove(folder_ / "a.csv");
  ASSERT_EQ(mkfifo((folder_ / "a.csv").c_str(), 0600), 0);
  EXPECT_EQ(Error(), yaml_ +
                         ":18: trials[0].file = a.csv; must be a file, and is a folder, a device "
                         "or a link to nothing. Give the name of the trial's CSV file.");
}

TEST_F(BadDatasetFolder, AHugeTraceIsRefusedWithoutReadingIt) {
  fs::resize_file(folder_ / "a.csv", 100ull << 30);  // sparse
  EXPECT_EQ(Error(), (folder_ / "a.csv").string() +
                         ": size = 107374182400 bytes; must be at most 67108864 bytes. "
                         "Cut the recording or lower its sample rate.");
}

TEST_F(BadDatasetFolder, AHugeDatasetFileIsRefusedWithoutReadingIt) {
  fs::resize_file(yaml_, 100ull << 30);
  EXPECT_EQ(Error(), yaml_ +
                         ": size = 107374182400 bytes; must be at most 1048576 bytes. "
                         "Samples belong into the CSV files.");
}

}  // namespace
}  // namespace hoplab
