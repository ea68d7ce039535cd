// A start of the program: what it loads. Its time in milliseconds is that of the machine
// (tools/start-time prints it); the number of libraries, which it comes from, is the same
// everywhere.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

TEST(StartCli, LoadsNoLibraryThatFewRunsNeed) {
  const ProcessResult run =
      RunProcess({.command = {"/usr/bin/env", "LD_TRACE_LOADED_OBJECTS=1", HOPLAB_BINARY}});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_NE(run.out.find("libstdc++.so"), std::string::npos) << run.out;
  for (const char* library : {"libmpi", "libhdf5", "libmatio", "libcurl", "libcrypto"})
    EXPECT_EQ(run.out.find(library), std::string::npos) << library << "\n" << run.out;
  EXPECT_LE(std::count(run.out.begin(), run.out.end(), '\n'), 40) << run.out;
}

TEST(StartCli, UnderALauncherWithoutItsLibraryTellsWhatIsMissing) {
  const TempFolder folder;
  WriteText(folder.path() / "libmpi.so.40", "no library");
  const std::string scenario = HOPLAB_SOURCE_DIR "/experiments/modulus.yaml";
  const ProcessResult run =
      RunProcess({.command = {"/usr/bin/env", "OMPI_COMM_WORLD_SIZE=2",
                              "LD_LIBRARY_PATH=" + folder.path().string(), HOPLAB_BINARY, "sweep",
                              scenario, "--out", (folder.path() / "run").string()}});
  EXPECT_EQ(run.exit_code, 65) << run.out;
  EXPECT_NE(run.err.find("libmpi.so.40: cannot be opened"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("libopenmpi3"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace hoplab::testing
