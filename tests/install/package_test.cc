// The Debian packages: what CPack makes of the build, installed by dpkg into a scratch root. With
// HOPLAB_TEST_DPKG=1 in the environment, and as root, into the system as well, and removed again.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "tests/install/steps.h"

namespace hoplab::testing {
namespace {

namespace fs = std::filesystem;

class Package : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new TempFolder;
    log_ = RunSteps({{HOPLAB_CPACK, "--config", HOPLAB_BUILD_DIR "/CPackConfig.cmake", "-G", "DEB",
                      "-B", scratch_->path().string()}},
                    scratch_->path());
  }
  static void TearDownTestSuite() {
    delete scratch_;
    scratch_ = nullptr;
  }
  void SetUp() override { ASSERT_EQ(log_, ""); }

  static fs::path Scratch() { return scratch_->path(); }
  static std::string File(const std::string& package) {
    for (const auto& entry : fs::directory_iterator(Scratch())) {
      if (entry.path().filename().string().starts_with(package + "_" HOPLAB_VERSION "_"))
        return entry.path().string();
    }
    return "";
  }
  static std::string Output(std::vector<std::string> command) {
    const ProcessResult r = RunProcess({.command = std::move(command), .folder = Scratch()});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return r.out;
  }
  static std::string Field(const std::string& package, const std::string& name) {
    std::string text = Output({"/usr/bin/dpkg-deb", "--field", File(package), name});
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }
  // The packages installed by dpkg to a root of their own; what they depend on is in the system.
  static fs::path InstalledTo(const std::string& folder, const std::vector<std::string>& packages) {
    const fs::path root = Scratch() / folder;
    for (const char* file : {"status", "available"}) WriteText(root / "var/lib/dpkg" / file, "");
    for (const char* part : {"updates", "info"})
      fs::create_directories(root / "var/lib/dpkg" / part);
    std::vector<std::string> command = {"/usr/bin/env",
                                        "PATH=/usr/sbin:/usr/bin:/sbin:/bin",
                                        "dpkg",
                                        "--force-not-root",
                                        "--force-depends",
                                        "--root=" + root.string(),
                                        "--log=" + (root / "dpkg.log").string(),
                                        "--install"};
    for (const std::string& package : packages) command.push_back(File(package));
    EXPECT_EQ(RunSteps({command}, Scratch()), "");
    for (const std::string& package : packages) {
      EXPECT_EQ(Output({"/usr/bin/dpkg-query", "--admindir=" + (root / "var/lib/dpkg").string(),
                        "-W", "-f", "${Status}", package}),
                "install ok installed");
    }
    return root;
  }

 private:
  static inline TempFolder* scratch_ = nullptr;
  static inline std::string log_;
};

// The modulus that `program` fits to the shipped drops in `datasets`.
double FittedModulus(const std::string& program, const fs::path& datasets, const fs::path& folder) {
  const ProcessResult fit = RunProcess(
      {.command = {program, "fit", (datasets / "rig-drops").string(), "--json", "--quiet"},
       .folder = folder});
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  return fit.exit_code == 0
             ? nlohmann::json::parse(fit.out).at("parameters").at(0).at("value").get<double>()
             : 0.0;
}

TEST_F(Package, SaysWhatItIsAndWhatItNeeds) {
  EXPECT_EQ(Field("hoplab", "Version"), HOPLAB_VERSION);
  EXPECT_EQ(Field("hoplab", "Section"), "science");
  const std::string depends = Field("hoplab", "Depends");
  for (const char* library : {"libc6 (>=", "libstdc++6 (>=", "libyaml-cpp", "libnlopt"})
    EXPECT_NE(depends.find(library), std::string::npos) << depends;
  EXPECT_EQ(depends.find("-dev"), std::string::npos) << depends;
  EXPECT_NE(Field("libhoplab-dev", "Depends").find("libceres-dev"), std::string::npos);
#ifdef HOPLAB_PYTHON
  EXPECT_NE(Field("python3-hoplab", "Depends").find("python3-numpy"), std::string::npos);
#endif
}

TEST_F(Package, HoldsItsFilesAsRootsReadableByAll) {
  std::istringstream lines(Output({"/usr/bin/dpkg-deb", "--contents", File("hoplab")}));
  bool program = false, copyright = false;
  long files = 0;
  for (std::string line; std::getline(lines, line); ++files) {
    EXPECT_NE(line.find(" root/root "), std::string::npos) << line;
    program = program || line.ends_with(" ./usr/bin/hoplab");
    copyright = copyright || line.ends_with(" ./usr/share/doc/hoplab/copyright");
    const bool runs = line.front() == 'd' || line.ends_with(" ./usr/bin/hoplab") ||
                      line.ends_with("/sweep.slurm");
    EXPECT_EQ(line.substr(1, 9), runs ? "rwxr-xr-x" : "rw-r--r--") << line;
  }
  EXPECT_TRUE(program);
  EXPECT_TRUE(copyright);
  EXPECT_GT(files, 40);
}

TEST_F(Package, InstalledByDpkgTheProgramFits) {
  const fs::path root = InstalledTo("root", {"hoplab"});
  const std::string program = (root / "usr/bin/hoplab").string();
  EXPECT_EQ(FittedModulus(program, root / "usr/share/hoplab/datasets", Scratch()),
            FittedModulus(HOPLAB_BINARY, fs::path(HOPLAB_SOURCE_DIR) / "datasets", Scratch()));

  const std::string sections = Output({"/usr/bin/readelf", "-S", "-d", program});
  EXPECT_EQ(sections.find(".symtab"), std::string::npos) << "not stripped";
  EXPECT_EQ(sections.find("RUNPATH"), std::string::npos);
  EXPECT_EQ(sections.find("RPATH"), std::string::npos);
}

#ifdef HOPLAB_PYTHON
TEST_F(Package, InstalledByDpkgTheModuleIsWhereDebiansPythonLooks) {
  const fs::path root = InstalledTo("python-root", {"python3-hoplab"});
  const fs::path packages = root / "usr/lib/python3/dist-packages";
  EXPECT_EQ(Output({"/usr/bin/env", "PYTHONPATH=" + packages.string(), HOPLAB_PYTHON, "-B", "-c",
                    "import hoplab; print(hoplab.__version__, hoplab.__file__)"}),
            HOPLAB_VERSION " " + (packages / "hoplab/__init__.py").string() + "\n");
}
#endif

TEST_F(Package, InTheSystemWhereThatIsAskedForFitsAndLeavesNothing) {
  const char* asked = std::getenv("HOPLAB_TEST_DPKG");
  if (asked == nullptr || std::string(asked) != "1") return;
  ASSERT_FALSE(fs::exists("/usr/bin/hoplab")) << "installed already: not ours to remove";
  ASSERT_EQ(RunSteps({{"/usr/bin/dpkg", "-i", File("hoplab")}}, Scratch()), "");
  EXPECT_EQ(FittedModulus("/usr/bin/hoplab", "/usr/share/hoplab/datasets", Scratch()),
            FittedModulus(HOPLAB_BINARY, fs::path(HOPLAB_SOURCE_DIR) / "datasets", Scratch()));
  EXPECT_EQ(RunSteps({{"/usr/bin/dpkg", "-r", "hoplab"}}, Scratch()), "");
  EXPECT_FALSE(fs::exists("/usr/bin/hoplab"));
  EXPECT_FALSE(fs::exists("/usr/share/hoplab"));
}

}  // namespace
}  // namespace hoplab::testing
