// Replays the fuzzer's corpus: seeds, hostile files and what the fuzzer once found.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/datasets/fuzz_entry.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> Corpus() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::directory_iterator(fs::path(HOPLAB_SOURCE_DIR) / "tests" / "datasets" / "corpus"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(FuzzCorpus, HasADozenFiles) { EXPECT_GE(Corpus().size(), 12u); }

TEST(FuzzCorpus, EveryFileReadsOrFailsWithAnInputError) {
  for (const fs::path& file : Corpus())
    EXPECT_NO_THROW(testing::ReadHostileBytes(testing::ReadText(file))) << file;
}

}  // namespace
}  // namespace hoplab
