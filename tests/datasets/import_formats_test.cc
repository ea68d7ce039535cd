// A recorded fall in every format, imported: the same digits, whatever it was written in.

#include <gtest/gtest.h>

#include <cmath>

#include "base/text.h"
#include "datasets/read_dataset.h"
#include "tests/datasets/import_samples.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::Fall;
using testing::FallCsv;
using testing::ImportFile;
using testing::InputErrorOf;

class ImportFormats : public testing::FallImport {};

TEST_F(ImportFormats, OpenSimTrcGivesBackItsPrintedDigits) {
  const auto file = Write("drop.trc", testing::FallTrc(fall_));
  const ImportResult result = ImportFile(file, {"x=R.HIP.X", "y=R.HIP.Y"});
  EXPECT_EQ(CsvOf(result), FallCsv(fall_));
  EXPECT_EQ(result.logs[0].format, "OpenSim TRC");
  EXPECT_FALSE(result.map.HasGuesses());
}

TEST_F(ImportFormats, ATrcInMetresIsReadInMetres) {
  const auto file = Write("drop.trc", testing::FallTrc(fall_, "m"));
  const std::string csv = CsvOf(ImportFile(file, {"y=R.HIP.Y"}));
  EXPECT_EQ(csv.substr(0, csv.find("\n0.004")), "time_s,body_y_m\n0.000,300.00");
}

TEST_F(ImportFormats, AHiddenMarkerOfATrcIsAMissingSample) {
  std::string text = testing::FallTrc(fall_);
  text.replace(text.find("\t5.20\t299.92\t"), 13, "\t5.20\t\t");
  const ImportResult result = ImportFile(Write("drop.trc", text), {"x=R.HIP.X", "y=R.HIP.Y"});
  EXPECT_EQ(result.logs[0].trace.missing.at(Channel::kBodyY), 1u);
  EXPECT_NE(CsvOf(result).find("\n0.004,0.00520,\n"), std::string::npos);
}

TEST_F(ImportFormats, OpenSimStorageGivesBackItsPrintedDigits) {
  for (const char* name : {"drop.sto", "drop.mot"}) {
    const ImportResult result =
        ImportFile(Write(name, testing::FallSto(fall_)), {"x=pelvis_tx", "y=pelvis_ty"});
    EXPECT_EQ(CsvOf(result), FallCsv(fall_)) << name;
    EXPECT_FALSE(result.map.HasGuesses());
  }
}

TEST_F(ImportFormats, AStorageInDegreesTellsItsAngles) {
  const ImportResult result =
      ImportFile(Write("drop.sto", testing::FallSto(fall_)), {"leg_angle=hip_flexion_r"});
  // 25 pi / 180 to the nearest double.
  EXPECT_NE(CsvOf(result).find("0.000,0.4363323129985824\n"), std::string::npos) << CsvOf(result);
}

// A turn about the lateral axis Z that goes through half a turn; w and z change sign together where
// the tracker chose the other of the two quaternions.
TEST_F(ImportFormats, AStorageOfQuaternionsGivesItsComponentsAndItsTurns) {
  std::string text =
      "Orientations\nversion=1\nDataType=Quaternion\nDataRate=100\nnRows=5\nnColumns=3\n"
      "endheader\ntime\tleg_imu\ttrunk_imu\n";
  const std::vector<double> angles = {3.0, 3.1, 3.2, 3.3, 3.4};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    text += testing::Format("%.2f", 0.01 * static_cast<double>(i)) + "\t" +
            FormatDouble(sign * std::cos(angles[i] / 2)) + ",0,0," +
            FormatDouble(sign * std::sin(angles[i] / 2)) + "\t1,0,0,0\n";
  }
  const auto file = Write("imu.sto", text);
  const ImportResult turn = ImportFile(file, {"leg_angle=leg_imu.angle_Z"});
  const Trace trace = ParseTraceCsv(CsvOf(turn), "imu.csv");
  for (std::size_t i = 0; i < angles.size(); ++i)
    EXPECT_NEAR((*trace.Find(Channel::kLegAngle))[i], angles[i], 1e-12) << i;
  EXPECT_FALSE(turn.map.HasGuesses());
  const std::string still = CsvOf(ImportFile(file, {"leg_angle=trunk_imu.angle_Z"}));
  EXPECT_NE(still.find("\n0.03,0\n"), std::string::npos) << still;
  const std::string error = InputErrorOf([&] { ImportFile(file, {"leg_angle=leg_imu.Z"}); });
  EXPECT_NE(error.find("leg_imu.Z in 1; leg_angle_rad is an angle"), std::string::npos) << error;
}

TEST_F(ImportFormats, AStorageOfVectorsGivesItsDigitsOnceTheirUnitIsSaid) {
  const auto file = Write("markers.sto",
                          "markers\nDataType=Vec3\nnRows=3\nnColumns=2\nendheader\ntime\thip\n"
                          "0.00\t1.50,300.25,7\n0.01\tnan,nan,nan\n0.02\t2.50,299.75,7\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"x=hip.X:mm", "y=hip.Y:mm"})),
            "time_s,body_x_m,body_y_m\n0.00,0.00150,0.30025\n0.01,,\n0.02,0.00250,0.29975\n");
}

TEST_F(ImportFormats, AMotiveQuaternionGivesItsTurnAboutEachAxis) {
  const auto file = Write("take.csv", testing::FallMotive(fall_));
  const std::string csv =
      CsvOf(ImportFile(file, {"leg_angle=hip.Rotation.angle_Z", "y=hip.Position.Y"}));
  EXPECT_NE(csv.find("\n0.004,0.29992,0\n"), std::string::npos) << csv;
}

TEST_F(ImportFormats, TheOlderStorageHeaderIsReadToo) {
  const auto file = Write("old.mot",
                          "drop\ndatacolumns 3\ndatarows 2\nrange 0 1\nendheader\n"
                          "time pelvis_tx pelvis_ty\n 0.00 1.5  0.30\n 0.01 1.6  0.29\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"x=pelvis_tx", "y=pelvis_ty"})),
            "time_s,body_x_m,body_y_m\n0.00,1.5,0.30\n0.01,1.6,0.29\n");
}

TEST_F(ImportFormats, AGroundForceOfAStorageIsInNewtons) {
  const auto file = Write("forces.mot",
                          "grf\nversion=1\nnRows=2\nnColumns=3\ninDegrees=no\nendheader\n"
                          "time\tground_force_vx\tground_force_vy\n0\t-1.5\t12.25\n0.01\t0\t0\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"fx=ground_force_vx", "fy=ground_force_vy"})),
            "time_s,ground_force_x_N,ground_force_y_N\n0,-1.5,12.25\n0.01,0,0\n");
}

TEST_F(ImportFormats, MotiveGivesBackItsPrintedDigitsAlongAnyAxis) {
  const auto file = Write("take.csv", testing::FallMotive(fall_));
  const ImportResult result = ImportFile(file, {"x=-hip.Position.Z", "y=hip.Position.Y"});
  EXPECT_EQ(CsvOf(result), FallCsv(fall_));
  EXPECT_EQ(result.logs[0].format, "Motive CSV");
  EXPECT_FALSE(result.map.HasGuesses());
}

TEST_F(ImportFormats, AMotiveQuaternionIsNoAngle) {
  const auto file = Write("take.csv", testing::FallMotive(fall_));
  const std::string error = InputErrorOf([&] {
    ImportFile(file, {"leg_angle=hip.Rotation.X", "y=hip.Position.Y"});
  });
  EXPECT_NE(error.find("hip.Rotation.X in 1; leg_angle_rad is an angle"), std::string::npos)
      << error;
}

TEST_F(ImportFormats, MotiveVersionsWithoutRowTitlesAreReadToo) {
  const auto file = Write("take.csv",
                          "Format Version,1.21,Capture Frame Rate,250,Length Units,Meters\n\n"
                          ",,Marker,Marker,Marker\n,,toe,toe,toe\n,,1,1,1\n"
                          ",,Position,Position,Position\nFrame,Time,X,Y,Z\n"
                          "0,0.000,0.1,0.2,0.3\n1,0.004,,,\n2,0.008,0.1,0.19,0.3\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"y=toe.Position.Y"})),
            "time_s,body_y_m\n0.000,0.2\n0.004,\n0.008,0.19\n");
}

TEST_F(ImportFormats, MatFilesOfBothVersionsGiveBackTheirNumbers) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const auto file = temp_.path() / "drop.mat";
    std::filesystem::remove(file);
    testing::WriteFallMat(file, fall_, version);
    const ImportResult result =
        ImportFile(file, {"t=t:s", "x=log.pos(:,1):mm", "y=log.pos(:,2):mm"});
    const Trace trace = ParseTraceCsv(CsvOf(result), "drop.csv");
    EXPECT_EQ(trace, ParseTraceCsv(FallCsv(fall_), "expected")) << version;
    EXPECT_EQ(result.unused, std::vector<std::string>{"gain"});  // a rate is a setting, no column
  }
}

TEST_F(ImportFormats, AQualisysMatGivesBackItsMarkersByNameAndItsTimesByTheFrameRate) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const auto file = temp_.path() / "drop.mat";
    std::filesystem::remove(file);
    testing::WriteFallQualisys(file, fall_, version);
    const ImportResult result = ImportFile(file, {"x=-hip.X", "y=hip.Z"});
    EXPECT_EQ(ParseTraceCsv(CsvOf(result), "drop.csv"), ParseTraceCsv(FallCsv(fall_), "expected"))
        << version;
    EXPECT_FALSE(result.map.HasGuesses());
    EXPECT_EQ(result.unused, (std::vector<std::string>{"hip.Y", "hip.residual", "toe.X", "toe.Y",
                                                       "toe.Z", "toe.residual"}));
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_NE(result.notes[0].find("markers in mm, Time is frame / 250 Hz"), std::string::npos);
    const std::string hidden = InputErrorOf([&] { ImportFile(file, {"y=toe.Z"}); });
    EXPECT_NE(hidden.find("column toe.Z; has no sample at all"), std::string::npos) << hidden;
  }
}

TEST_F(ImportFormats, ACubeWithoutLabelsIsNamedByItsIndices) {
  const auto file = temp_.path() / "drop.mat";
  testing::WriteFallQualisys(file, fall_, MAT_FT_MAT5, false);
  const std::string path = "drop0001.Trajectories.Labeled.Data";
  const ImportResult result = ImportFile(file, {"x=-" + path + "(1,1,:)", "y=" + path + "(1,3,:)"});
  EXPECT_EQ(ParseTraceCsv(CsvOf(result), "drop.csv"), ParseTraceCsv(FallCsv(fall_), "expected"));
}

TEST_F(ImportFormats, ASingleOfAMatFileIsWrittenInItsOwnDigits) {
  const auto file = temp_.path() / "drop.mat";
  testing::WriteFallMat(file, fall_, MAT_FT_MAT5);
  const std::string csv = CsvOf(ImportFile(file, {"t=t:s", "leg_length=gain:m"}));
  EXPECT_NE(csv.find("\n0.004,0.1\n"), std::string::npos) << csv;
}

TEST_F(ImportFormats, Hdf5GivesBackItsNumbersFromDatasetsAndTables) {
  const auto file = temp_.path() / "drop.h5";
  testing::WriteFallHdf5(file, fall_);
  const ImportResult two = ImportFile(file, {"t=/t:ms", "x=/body/pos[:,0]", "y=/body/pos[:,1]"});
  EXPECT_EQ(ParseTraceCsv(CsvOf(two), "drop.csv"), ParseTraceCsv(FallCsv(fall_), "expected"));
  const ImportResult table = ImportFile(file, {"t=/table.t_s", "y=/table.z_m"});
  EXPECT_FALSE(table.map.HasGuesses());
  EXPECT_TRUE(CsvOf(table).starts_with("time_s,body_y_m\n0,0.3\n0.004,0.29992\n0.008,"));
}

TEST_F(ImportFormats, SpreadsheetsOfOtherCountriesAreRead) {
  const auto file = Write("lauf.csv",
                          "\xEF\xBB\xBFMessung 17;;\r\nZeit [ms];Weg [mm];H\xC3\xB6he [mm]\r\n"
                          "0,0;0,10;300,00\r\n4,0;5,20;299,92\r\n");
  const ImportResult result = ImportFile(file, {"t=Zeit", "x=Weg", "y=H\xC3\xB6he"});
  EXPECT_EQ(CsvOf(result),
            "time_s,body_x_m,body_y_m\n0.0000,0.00010,0.30000\n0.0040,0.00520,0.29992\n");
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("decimal commas"), std::string::npos);
}

// A spreadsheet leaves out the zeros behind the comma: 1,00 is written 1.
TEST_F(ImportFormats, ALastRowOfWholeNumbersHidesNoDecimalComma) {
  const auto file = Write("lauf.csv", "t [s];z [mm]\n0,5;300,5\n0,75;299,5\n1;299\n");
  const ImportResult result = ImportFile(file, {"t=t", "y=z"});
  EXPECT_EQ(CsvOf(result), "time_s,body_y_m\n0.5,0.3005\n0.75,0.2995\n1,0.299\n");
}

TEST_F(ImportFormats, LinesOfSettingsBeforeTheTitlesAreSkipped) {
  const auto file = Write("log.csv",
                          "Subject,rig\nRate [Hz],500\nMass [kg],1.2\n\nt [s],z [mm]\n0,300\n"
                          "0.002,299\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"t=t", "y=z"})), "time_s,body_y_m\n0,0.300\n0.002,0.299\n");
}

TEST_F(ImportFormats, ARowOfUnitsBelowTheTitlesIsRead) {
  const auto file = Write("log.txt", "time\theight\tstate\nms\tcm\t\n0\t30.00\t1\n5\t29.99\t1\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"t=time", "y=height"})),
            "time_s,body_y_m\n0.000,0.3000\n0.005,0.2999\n");
}

TEST_F(ImportFormats, AFileWithoutTitlesIsMappedByColumnNumbers) {
  const auto file = Write("log.dat", "% made by a script\n0 0.0 300\n4 5.2 299.9\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"t=#1:ms", "y=#3:mm"})),
            "time_s,body_y_m\n0.000,0.300\n0.004,0.2999\n");
}

TEST_F(ImportFormats, QuotedTitlesMayHoldTheSeparator) {
  const auto file = Write("log.csv", "\"time, s\",\"height, mm\"\n0,300\n0.01,299\n");
  EXPECT_EQ(CsvOf(ImportFile(file, {"t=time", "y=height"})),
            "time_s,body_y_m\n0,0.300\n0.01,0.299\n");
}

TEST_F(ImportFormats, TextAndMissingWordsInColumnsNobodyMapsDoNoHarm) {
  const auto file = Write("log.csv",
                          "t [s],z [m],mode,T [V]\n0,0.3,flight,n/a\n0.01,NaN,flight,?\n"
                          "0.02,NA,stance,1\n");
  const ImportResult result = ImportFile(file, {"t=t", "y=z"});
  EXPECT_EQ(CsvOf(result), "time_s,body_y_m\n0,0.3\n0.01,\n0.02,\n");
}

TEST_F(ImportFormats, TheResultIsADatasetOnceItsBlanksAreFilled) {
  const auto file = Write("drop.sto", testing::FallSto(fall_));
  ImportRequest request;
  request.logs = {{file}};
  request.name = "drop";
  request.map = {ParseMapEntry("y=pelvis_ty").value()};
  ImportResult result = ImportLogs(request);
  EXPECT_EQ(result.blanks.size(), 8u);  // seven of the mechanism, one angle
  request.type = MechanismKind::kBall;
  request.values = {{"mechanism.body_mass_kg", "0.0027"},
                    {"mechanism.ball.radius_m", "0.02"},
                    {"mechanism.ball.restitution", "0.9"},
                    {"mechanism.ball.tangential_loss", "0.1"}};
  result = ImportLogs(request);
  EXPECT_TRUE(result.blanks.empty());
  const Dataset dataset = ReadDatasetText(result.files.at("dataset.yaml"), result.files, "drop");
  EXPECT_EQ(dataset.mechanism.body_mass_kg, 0.0027);
  EXPECT_EQ(dataset.trials.at(0).trace.Find(Channel::kBodyY)->front(), 0.3);
}

}  // namespace
}  // namespace hoplab
