#include "base/atomic_file.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/input_error_of.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;
using testing::CountEntries;
using testing::InputErrorOf;
using testing::ReadText;
using testing::TempFolder;
using testing::WriteText;

const OverwriteOptions kForce = {true, ""};

TEST(WriteFileAtomically, WritesTheWholeFileAndNothingBesideIt) {
  const TempFolder temp;
  WriteFileAtomically(temp.path() / "a.csv", "time_s\n0\n");
  EXPECT_EQ(ReadText(temp.path() / "a.csv"), "time_s\n0\n");
  EXPECT_EQ(CountEntries(temp.path()), 1);
}

TEST(WriteFileAtomically, MakesTheFoldersAboveIt) {
  const TempFolder temp;
  WriteFileAtomically(temp.path() / "a" / "b" / "c.csv", "x");
  EXPECT_EQ(ReadText(temp.path() / "a" / "b" / "c.csv"), "x");
}

TEST(WriteFileAtomically, RefusesToOverwrite) {
  const TempFolder temp;
  const fs::path file = temp.path() / "a";
  WriteText(file, "old");
  EXPECT_EQ(InputErrorOf([&] { WriteFileAtomically(file, "new"); }),
            file.string() +
                ": exists already and is not overwritten. Choose another name or use --force.");
  EXPECT_EQ(ReadText(file), "old");
}

TEST(WriteFileAtomically, OverwritesWithForce) {
  const TempFolder temp;
  WriteText(temp.path() / "a", "old");
  WriteFileAtomically(temp.path() / "a", "new", kForce);
  EXPECT_EQ(ReadText(temp.path() / "a"), "new");
}

TEST(WriteFileAtomically, SaysSoWhenAFolderStandsThere) {
  const TempFolder temp;
  EXPECT_EQ(InputErrorOf([&] { WriteFileAtomically(temp.path(), "x", kForce); }),
            temp.path().string() +
                ": cannot be written (it is a folder). Choose another place or free this one.");
}

TEST(WriteFileAtomically, SaysSoWhenAFileStandsWhereAFolderIsNeeded) {
  const TempFolder temp;
  WriteText(temp.path() / "a", "x");
  EXPECT_NE(InputErrorOf([&] { WriteFileAtomically(temp.path() / "a" / "b", "x"); }), "(no error)");
}

TEST(WriteFolderAtomically, ShowsTheFolderOnlyWhenItIsFull) {
  const TempFolder temp;
  const fs::path folder = temp.path() / "run";
  WriteFolderAtomically(folder, [&](const fs::path& staged) {
    WriteText(staged / "a", "1");
    EXPECT_FALSE(fs::exists(folder));
    WriteText(staged / "b", "2");
  });
  EXPECT_EQ(ReadText(folder / "b"), "2");
  EXPECT_EQ(CountEntries(temp.path()), 1);
}

TEST(WriteFolderAtomically, LeavesNothingBehindWhenFillingFails) {
  const TempFolder temp;
  const auto fill = [](const fs::path& staged) {
    WriteText(staged / "a", "1");
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(WriteFolderAtomically(temp.path() / "run", fill), std::runtime_error);
  EXPECT_EQ(CountEntries(temp.path()), 0);
}

TEST(WriteFolderAtomically, KeepsTheOldFolderWhenFillingFails) {
  const TempFolder temp;
  WriteText(temp.path() / "run" / "run.json", "old");
  const auto fill = [](const fs::path&) { throw std::runtime_error("disk full"); };
  EXPECT_THROW(WriteFolderAtomically(temp.path() / "run", fill, kForce), std::runtime_error);
  EXPECT_EQ(ReadText(temp.path() / "run" / "run.json"), "old");
  EXPECT_EQ(CountEntries(temp.path()), 1);
}

TEST(WriteFolderAtomically, RefusesAFolderWithSomethingInIt) {
  const TempFolder temp;
  const fs::path folder = temp.path() / "run";
  WriteText(folder / "run.json", "old");
  bool filled = false;
  EXPECT_EQ(
      InputErrorOf([&] { WriteFolderAtomically(folder, [&](const fs::path&) { filled = true; }); }),
      folder.string() +
          ": exists already and is not overwritten. Choose another name or use --force.");
  EXPECT_FALSE(filled);
}

TEST(WriteFolderAtomically, TakesAnEmptyFolderAsAbsent) {
  const TempFolder temp;
  fs::create_directory(temp.path() / "run");
  WriteFolderAtomically(temp.path() / "run",
                        [](const fs::path& staged) { WriteText(staged / "a", "1"); });
  EXPECT_EQ(ReadText(temp.path() / "run" / "a"), "1");
}

TEST(WriteFolderAtomically, ReplacesTheWholeFolderWithForce) {
  const TempFolder temp;
  WriteText(temp.path() / "run" / "run.json", "old");
  WriteText(temp.path() / "run" / "stale.csv", "old");
  WriteFolderAtomically(temp.path() / "run",
                        [](const fs::path& staged) { WriteText(staged / "run.json", "new"); },
                        {true, "run.json"});
  EXPECT_EQ(ReadText(temp.path() / "run" / "run.json"), "new");
  EXPECT_EQ(CountEntries(temp.path() / "run"), 1);
  EXPECT_EQ(CountEntries(temp.path()), 1);
}

TEST(WriteFolderAtomically, DoesNotReplaceAFolderWithoutTheMarkerEvenWithForce) {
  const TempFolder temp;
  const fs::path home = temp.path() / "home";
  WriteText(home / "thesis.tex", "years of work");
  EXPECT_EQ(InputErrorOf([&] {
              WriteFolderAtomically(home, [](const fs::path&) {}, {true, "run.json"});
            }),
            home.string() +
                ": is not replaced: it holds no run.json, so it was not written by this command. "
                "Choose another name.");
  EXPECT_EQ(ReadText(home / "thesis.tex"), "years of work");
}

TEST(WriteFolderAtomically, TakesANameWithATrailingSlash) {
  const TempFolder temp;
  WriteFolderAtomically(temp.path() / "run" / "",
                        [](const fs::path& staged) { WriteText(staged / "a", "1"); });
  EXPECT_EQ(ReadText(temp.path() / "run" / "a"), "1");
}

TEST(WriteFolderAtomically, RefusesTheWorkingFolderItself) {
  EXPECT_NE(InputErrorOf([] {
              WriteFolderAtomically(
                  ".", [](const fs::path&) {}, kForce);
            }),
            "(no error)");
}

}  // namespace
}  // namespace hoplab
