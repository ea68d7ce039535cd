// What the user says of a log's columns, what is guessed, and what is done to the samples.

#include <gtest/gtest.h>

#include "tests/datasets/import_samples.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::Fall;
using testing::Format;
using testing::ImportFile;
using testing::InputErrorOf;
using testing::MakeFall;
using testing::TempFolder;
using testing::WriteText;

class ImportMap : public ::testing::Test {
 protected:
  std::filesystem::path Log(const std::string& text, const std::string& name = "log.csv") {
    WriteText(temp_.path() / name, text);
    return temp_.path() / name;
  }
  static std::string CsvOf(const ImportResult& result) {
    return result.files.at(result.logs.at(0).file);
  }
  // A fall with these titles of time, forward and height, height times `sign`.
  static std::string FallLog(const std::string& titles, double time, double length,
                             double sign = 1) {
    const Fall fall = MakeFall(100);
    std::string text = titles + "\n";
    for (std::size_t i = 0; i < fall.t_s.size(); ++i)
      text += Format("%.7g", time * fall.t_s[i]) + "," +
              Format("%.7g", length * fall.x_mm[i] / 1e3) + "," +
              Format("%.7g", sign * length * fall.y_mm[i] / 1e3) + ",7\n";
    return text;
  }
  TempFolder temp_;
};

// ---- --map

TEST(ImportMapEntry, SignAndUnitAreTakenOff) {
  const MapEntry entry = ParseMapEntry("y=-hip Z:mm").value();
  EXPECT_EQ(entry.target, Channel::kBodyY);
  EXPECT_EQ(entry.column, "hip Z");
  EXPECT_EQ(entry.unit, "mm");
  EXPECT_TRUE(entry.negate);
}

TEST(ImportMapEntry, AColonThatNoUnitFollowsBelongsToTheName) {
  const MapEntry entry = ParseMapEntry("body_x_m=rig:Marker 1").value();
  EXPECT_EQ(entry.column, "rig:Marker 1");
  EXPECT_EQ(entry.unit, "");
  EXPECT_TRUE(ParseMapEntry("t=Time:ms").value().target.IsTime());
}

TEST(ImportMapEntry, WhatIsNoEntryIsNone) {
  for (const char* text : {"", "y", "=z", "y=", "y=-", "y=:mm"})
    EXPECT_FALSE(ParseMapEntry(text).has_value() && ParseMapEntry(text)->column.empty()) << text;
  EXPECT_FALSE(ParseMapEntry("y="));
  EXPECT_FALSE(ParseMapEntry("z"));
  EXPECT_EQ(InputErrorOf([] { ParseMapEntry("height=z"); }).substr(0, 31),
            "--map: height; is no channel. K");
}

TEST_F(ImportMap, AMinusTurnsAnAxisAround) {
  const auto file = Log("t,d\n0,-300.0\n1,0\n2,-5\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"t=t:ms", "y=-d:mm"})),
            "time_s,body_y_m\n0.000,0.3000\n0.001,0.000\n0.002,0.005\n");
}

TEST_F(ImportMap, AColumnIsFoundByItsTitleWithOrWithoutUnitInLettersOfAnyCase) {
  const auto file = Log("Time (ms),Z [mm]\n0,300\n1,299\n");
  const std::string expected = "time_s,body_y_m\n0.000,0.300\n0.001,0.299\n";
  for (const char* y : {"y=Z [mm]", "y=Z", "y=z", "y=#2", "y=z:mm"})
    EXPECT_EQ(CsvOf(ImportFile(file, {"t=time", y})), expected) << y;
}

TEST_F(ImportMap, AUnitThatContradictsTheFileIsTakenAndSaid) {
  const auto file = Log("t [s],z [mm]\n0,0.3\n1,0.2\n");
  const ImportResult result = ImportFile(file, {"t=t", "y=z:m"});
  EXPECT_EQ(CsvOf(result), "time_s,body_y_m\n0,0.3\n1,0.2\n");
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("z [mm] is in mm by the file and in m by --map"),
            std::string::npos);
}

TEST_F(ImportMap, ContactsNeedNoUnit) {
  const auto file = Log("t [s],foot\n0,0\n0.1,1\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"t=t", "contact=foot"})), "time_s,contact\n0,0\n0.1,1\n");
}

// ---- guesses

TEST_F(ImportMap, GravityTellsTheVerticalAxisAndItsUnit) {
  struct Case {
    const char* titles;
    double time, length, sign;
    std::vector<std::string> expected;
  };
  const std::vector<Case> cases = {
      {"Time (ms),hip X [mm],hip Z [mm],q",
       1e3,
       1e3,
       1,
       {"t=Time (ms):ms", "y=hip Z [mm]:mm", "x=hip X [mm]:mm"}},
      {"t,pos_x,pos_y,q", 1, 1, 1, {"t=t:s", "y=pos_y:m", "x=pos_x:m"}},
      {"timestamp,x,y,q", 1e6, 1e2, 1, {"t=timestamp:us", "y=y:cm", "x=x:cm"}},
      {"t,pos_fwd,pos_up,q", 1, 1e3, 1, {"t=t:s", "y=pos_up:mm", "x=pos_fwd:mm"}},
      {"t,px,pz,q", 1, 1, 1, {"t=t:s", "y=pz:m", "x=px:m"}},
      {"t,horizontal,vertical,q", 1, 1, 1, {"t=t:s", "y=vertical:m", "x=horizontal:m"}},
      {"t,Marker vor [mm],Marker hoch [mm],q",
       1,
       1e3,
       1,
       {"t=t:s", "y=Marker hoch [mm]:mm", "x=Marker vor [mm]:mm"}},
      // An image's rows count downwards.
      {"time,x,y,q", 1e3, 1e3, -1, {"t=time:ms", "y=-y:mm", "x=x:mm"}},
  };
  for (const Case& c : cases) {
    const auto file = Log(FallLog(c.titles, c.time, c.length, c.sign));
    const ImportResult result = ImportFile(file, {});
    EXPECT_EQ(result.map_texts, c.expected) << c.titles;
    EXPECT_TRUE(result.map.HasGuesses());
    EXPECT_EQ(result.unused, std::vector<std::string>{"q"});
    EXPECT_NE(result.map.columns[1].why.find("falls at 9.8"), std::string::npos)
        << result.map.columns[1].why;
  }
}

// A column that only begins as the height does gives way to one that is an axis of it.
TEST_F(ImportMap, WhatTravelsFurtherButIsNoAxisIsNotForward) {
  const Fall fall = MakeFall(100);
  std::string text = "t,hip_x [m],hip_z [m],hip_path [m]\n";
  for (std::size_t i = 0; i < fall.t_s.size(); ++i)
    text += Format("%.7g", fall.t_s[i]) + "," + Format("%.7g", fall.x_mm[i] / 1e3) + "," +
            Format("%.7g", fall.y_mm[i] / 1e3) + "," + Format("%.7g", 9.0 * fall.t_s[i]) + "\n";
  EXPECT_EQ(ImportFile(Log(text), {}).map_texts,
            (std::vector<std::string>{"t=t:s", "y=hip_z [m]:m", "x=hip_x [m]:m"}));
}

TEST_F(ImportMap, ABodyThatMovesAgainstAnAxisIsTurnedAround) {
  const auto file = Log(testing::FallMotive(MakeFall(100)), "take.csv");
  const ImportResult result = ImportFile(file, {});
  EXPECT_EQ(result.map_texts, (std::vector<std::string>{"t=Time (Seconds):s", "y=hip.Position.Y:mm",
                                                        "x=-hip.Position.Z:mm"}));
  EXPECT_EQ(CsvOf(result), testing::FallCsv(MakeFall(100)));
}

TEST_F(ImportMap, MatricesOfBinaryFilesAreGuessedByTheirColumns) {
  const Fall fall = MakeFall(100);
  testing::WriteFallMat(temp_.path() / "log.mat", fall, MAT_FT_MAT5);
  EXPECT_EQ(ImportFile(temp_.path() / "log.mat", {}).map_texts,
            (std::vector<std::string>{"t=t:s", "y=log.pos(:,2):mm", "x=log.pos(:,1):mm"}));
  testing::WriteFallHdf5(temp_.path() / "log.h5", fall);
  EXPECT_EQ(ImportFile(temp_.path() / "log.h5", {}).map_texts,
            (std::vector<std::string>{"t=/t:ms", "y=/body/pos[:,1]:mm", "x=/body/pos[:,0]:mm"}));
}

TEST_F(ImportMap, OpenSimNamesAreGuessed) {
  const auto trc = Log(testing::FallTrc(MakeFall(100)), "drop.trc");
  EXPECT_EQ(ImportFile(trc, {}).map_texts,
            (std::vector<std::string>{"t=Time:s", "y=R.HIP.Y:mm", "x=R.HIP.X:mm"}));
  const auto sto = Log(testing::FallSto(MakeFall(100)), "drop.sto");
  EXPECT_EQ(ImportFile(sto, {}).map_texts,
            (std::vector<std::string>{"t=time:s", "y=pelvis_ty:m", "x=pelvis_tx:m"}));
}

TEST_F(ImportMap, GuessesSaidAsMapOptionsGiveTheSameAndAreNoGuesses) {
  const auto file = Log(FallLog("Time,X,Y,q", 1e3, 1e3));
  const ImportResult guessed = ImportFile(file, {});
  const ImportResult said = ImportFile(file, guessed.map_texts);
  EXPECT_EQ(CsvOf(guessed), CsvOf(said));
  EXPECT_FALSE(said.map.HasGuesses());
}

TEST_F(ImportMap, TheFormatsOwnNamesAreNoGuess) {
  const std::string csv = "time_s,body_x_m,body_y_m,contact\n0,0.1,0.3,0\n0.1,0.2,,1\n";
  const ImportResult result = ImportFile(Log(csv), {});
  EXPECT_FALSE(result.map.HasGuesses());
  EXPECT_EQ(CsvOf(result), csv);
}

TEST_F(ImportMap, AHeightThatDoesNotFallIsNotGuessed) {
  std::string text = "time,x,y\n";
  for (int i = 0; i < 100; ++i) text += Format("%.3f", 0.01 * i) + "," + Format("%d", 0) + ",0.3\n";
  const std::string error = InputErrorOf([&] { ImportFile(Log(text), {}); });
  EXPECT_NE(error.find("no column could be told to be a channel"), std::string::npos) << error;
  EXPECT_NE(error.find("the columns are: time, x, y"), std::string::npos) << error;
}

// The file says centimetres, and the body falls in millimetres.
TEST_F(ImportMap, AHeightThatFallsInAnotherUnitThanItsOwnIsTold) {
  const auto file = Log(FallLog("t,hip_x_cm,hip_z_cm,q", 1, 1e3));
  const std::string error = InputErrorOf([&] { ImportFile(file, {}); });
  EXPECT_NE(error.find("hip_z_cm falls at 9.8"), std::string::npos) << error;
  EXPECT_NE(error.find("if it is in mm, and not as the file says. Name them, as --map t=COLUMN:ms "
                       "--map 'y=hip_z_cm:mm'; "),
            std::string::npos)
      << error;
  EXPECT_EQ(ImportFile(file, {"y=hip_z_cm:mm"}).map_texts,
            (std::vector<std::string>{"t=t:s", "y=hip_z_cm:mm"}));
  // Beside what can be told it is a warning.
  const auto beside = Log(FallLog("t,hip_x_cm,hip_z_cm,body_vx_m_per_s", 1, 1e3), "beside.csv");
  const ImportResult result = ImportFile(beside, {});
  ASSERT_EQ(result.map.warnings.size(), 1u);
  EXPECT_NE(result.map.warnings[0].find("hip_z_cm falls at 9.8"), std::string::npos);
}

TEST_F(ImportMap, WithAMapOnlyWhatItLeavesOpenIsGuessed) {
  const auto file = Log(FallLog("Time,X,Y,q", 1e3, 1e3));
  const ImportResult result = ImportFile(file, {"x=X", "y=Y"});
  EXPECT_EQ(result.map_texts, (std::vector<std::string>{"t=Time:ms", "y=Y:mm", "x=X:mm"}));
  EXPECT_TRUE(result.map.HasGuesses());
}

// ---- samples

TEST_F(ImportMap, ARateStandsInForTimes) {
  TraceOptions options;
  options.rate_hz = 500;
  EXPECT_EQ(CsvOf(ImportFile(Log("z [mm]\n300\n299\n297\n"), {"y=z"}, options)),
            "time_s,body_y_m\n0,0.300\n0.002,0.299\n0.004,0.297\n");
}

TEST_F(ImportMap, TimesOfARateBeginAtZeroBehindACutToo) {
  ImportRequest request;
  request.logs = {{Log("z [mm]\n300\n299\n297\n295\n"), TrialRole::kTrain, {{0.003}}}};
  request.map = {ParseMapEntry("y=z").value()};
  request.name = "rate";
  request.options.rate_hz = 500;
  request.options.zero_time = true;
  EXPECT_EQ(CsvOf(ImportLogs(request)), "time_s,body_y_m\n0,0.297\n0.002,0.295\n");
}

TEST_F(ImportMap, ACutKeepsBothEndsAndTimeMayBeginAtZero) {
  const auto file =
      Log("t [ms],z [m]\n1700000000123,1\n1700000000125,2\n1700000000127,3\n"
          "1700000000129,4\n");
  ImportRequest request;
  request.logs = {{file, TrialRole::kTrain, {{1700000000.125, 1700000000.127}}}};
  request.map = {ParseMapEntry("t=t").value(), ParseMapEntry("y=z").value()};
  request.name = "epoch";
  EXPECT_EQ(CsvOf(ImportLogs(request)), "time_s,body_y_m\n1700000000.125,2\n1700000000.127,3\n");
  request.options.zero_time = true;
  EXPECT_EQ(CsvOf(ImportLogs(request)), "time_s,body_y_m\n0.000,2\n0.002,3\n");
}

TEST_F(ImportMap, SeveralCutsOfALogAreSeveralTrials) {
  ImportRequest request;
  request.logs = {{Log("t [s],z [m]\n0,1\n1,2\n2,3\n3,4\n"), TrialRole::kTrain, {{{}, 1}, {2}}}};
  request.map = {ParseMapEntry("t=t").value(), ParseMapEntry("y=z").value()};
  request.name = "parts";
  const ImportResult result = ImportLogs(request);
  EXPECT_EQ(result.files.at("log-1.csv"), "time_s,body_y_m\n0,1\n1,2\n");
  EXPECT_EQ(result.files.at("log-2.csv"), "time_s,body_y_m\n2,3\n3,4\n");
}

// A clock that stands still or starts anew outside the cut does no harm; inside it does.
TEST_F(ImportMap, TimeMustIncreaseWithinTheCutAlone) {
  ImportRequest request;
  const auto file = Log("t [s],z [m]\n0,1\n0,1\n1,2\n2,3\n3,4\n0,5\n");
  request.map = {ParseMapEntry("t=t").value(), ParseMapEntry("y=z").value()};
  request.name = "clock";
  request.logs = {{file, TrialRole::kTrain, {{1, 2}}}};
  EXPECT_EQ(CsvOf(ImportLogs(request)), "time_s,body_y_m\n1,2\n2,3\n");
  request.logs = {{file, TrialRole::kTrain, {{{}, 2}}}};
  EXPECT_EQ(InputErrorOf([&] { ImportLogs(request); }),
            file.string() +
                ":3: t [s] = 0; repeats the time before, 0. Remove the row, sort the rows by time, "
                "cut the log with --cut, or say --mend-times.");
  request.logs = {{Log("t [s],z [m]\n0,1\n1,2\n2,3\n1,4\n"), TrialRole::kTrain, {{1, 1}}}};
  EXPECT_NE(InputErrorOf([&] { ImportLogs(request); }).find(":5: t [s] = 1; repeats"),
            std::string::npos);
}

TEST_F(ImportMap, AShiftIsExact) {
  TraceOptions options;
  options.shifts[Channel::kBodyY] = "-0.0350";
  options.shifts[std::nullopt] = "-12";
  const auto file = Log("t [s],z [mm]\n12.001,335.1\n12.003,\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"t=t", "y=z"}, options)),
            "time_s,body_y_m\n0.001,0.3001\n0.003,\n");
}

TEST_F(ImportMap, SeveralLogsFollowTheMapOfTheFirst) {
  ImportRequest request;
  request.logs = {{Log(FallLog("Time,X,Y,q", 1e3, 1e3), "run 1.csv")},
                  {Log("q,Y,X,Time\n1,300,0,0\n1,290,1,5\n", "run 2.csv"), TrialRole::kTest}};
  request.name = "two";
  const ImportResult result = ImportLogs(request);
  EXPECT_EQ(result.logs[1].file, "run-2.csv");
  EXPECT_EQ(result.files.at("run-2.csv"),
            "time_s,body_x_m,body_y_m\n0.000,0.000,0.300\n0.005,0.001,0.290\n");
  EXPECT_NE(result.files.at("dataset.yaml").find("role: test"), std::string::npos);
}

}  // namespace
}  // namespace hoplab
