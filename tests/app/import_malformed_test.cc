// Recordings that are not what they should be: the message tells place, value, rule and remedy, the
// exit code is 65, and no dataset appears.

#include <gtest/gtest.h>

#include <functional>

#include "tests/app/hoplab_process.h"
#include "tests/datasets/import_samples.h"
#include "tests/datasets/matlab_objects.h"

namespace hoplab::testing {
namespace {

using Strings = std::vector<std::string>;

struct Malformed {
  std::string name;  // of the test
  std::string file;
  std::function<void(const std::filesystem::path&)> write;
  Strings map;
  Strings says;  // place and value, rule, remedy
};

void PrintTo(const Malformed& bad, std::ostream* out) { *out << bad.name; }

std::function<void(const std::filesystem::path&)> Text(std::string text) {
  return [text = std::move(text)](const std::filesystem::path& file) { WriteText(file, text); };
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("nothing to replace: " + from);
  return text.replace(at, from.size(), to);
}

std::string WithoutLastLine(std::string text) {
  text.pop_back();
  return text.substr(0, text.rfind('\n') + 1);
}

// What `write` writes, but for the last `bytes`.
std::function<void(const std::filesystem::path&)> Cut(
    const std::function<void(const std::filesystem::path&)>& write, std::uintmax_t bytes) {
  return [=](const std::filesystem::path& file) {
    write(file);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - bytes);
  };
}

void WriteMat(const std::filesystem::path& file) { WriteFallMat(file, MakeFall(), MAT_FT_MAT5); }
void WriteHdf5(const std::filesystem::path& file) { WriteFallHdf5(file, MakeFall()); }

// A MAT-file whose packed bytes were changed behind the header of its first variable.
void WriteDamagedMat(const std::filesystem::path& file) {
  WriteMat(file);
  std::string bytes = ReadText(file);
  for (std::size_t i = 150; i < 190; ++i) bytes[i] = static_cast<char>(~bytes[i]);
  WriteText(file, bytes);
}

void WriteWordsMat(const std::filesystem::path& file) {
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, MAT_FT_MAT5);
  std::size_t size[2] = {1, 4};
  char word[] = "none";
  std::size_t empty[2] = {2, 2};
  matvar_t* variables[] = {Mat_VarCreate("remark", MAT_C_CHAR, MAT_T_UINT8, 2, size, word, 0),
                           Mat_VarCreate("runs", MAT_C_CELL, MAT_T_CELL, 2, empty, nullptr, 0)};
  for (matvar_t* variable : variables) {
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
  }
  Mat_Close(mat);
}

// A table of two rows that says it has `rows`. `region`: where its description says its second
// region begins; 0: where it does.
void WriteTableMat(const std::filesystem::path& file, double rows, unsigned region) {
  MatlabObjects objects;
  const MatlabValue table = objects.Add("table", {{"data", MatlabCells({MatlabColumn({3, 2})})},
                                                  {"varnames", MatlabTexts({"z"})},
                                                  {"nrows", MatlabNumber(rows)}});
  std::string bytes = Level5Bytes({{"T", table}}, objects, false);
  if (region != 0) {
    // Version 4, four names, then the places of the regions.
    const std::size_t at = bytes.find(std::string("\4\0\0\0\4\0\0\0", 8));
    bytes[at + 12] = static_cast<char>(region & 0xFF);
    bytes[at + 13] = static_cast<char>(region >> 8);
  }
  WriteText(file, bytes);
}

void WriteScalarHdf5(const std::filesystem::path& file) {
  const hid_t h5 = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t scalar = H5Screate(H5S_SCALAR);
  const hid_t rate =
      H5Dcreate2(h5, "rate", H5T_IEEE_F64LE, scalar, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(rate);
  H5Sclose(scalar);
  H5Fclose(h5);
}

const Strings kMap = {"t=t", "y=z"};
const Strings kTrcMap = {"y=R.HIP.Y"};
const Strings kStoMap = {"y=pelvis_ty"};
const Strings kMotiveMap = {"y=hip.Position.Y"};

std::vector<Malformed> CsvCases() {
  const auto csv = [](const std::string& name, const std::string& text, const Strings& says,
                      const Strings& map = kMap) {
    return Malformed{"Csv" + name, "log.csv", Text(text), map, says};
  };
  const std::string head = "t [s],z [mm]\n0,300\n";
  return {
      csv("Empty", "# nothing\n\n", {"log.csv: is empty", "Export the recording again."}),
      csv("Binary", head + std::string("\0\1", 2),
          {"log.csv:3: is no UTF-8 text (a NUL byte)", "Save the file as plain text"}),
      csv("NoNumbers", "time,height\nlow,high\n", {"log.csv:2: low,high; no row holds numbers"}),
      csv("CutLine", head + "0.01,299\n0.02\n",
          {"log.csv:4: 1 cells; must have 2", "a line that was cut off"}),
      csv("StrayComma", head + "0.01,299,5\n", {"log.csv:3: 3 cells; must have 2"}),
      csv("TitleMissing", "t [s],z [mm]\n0,300,1\n0.01,299,1\n",
          {"log.csv:1: 2 titles; must have 3", "Give each column a title"}),
      csv("NoNumber", head + "0.01,299mm\n",
          {"log.csv:3: z [mm] = 299mm; is not a number", "without units"}),
      csv("Thousands", "t [s];z [mm]\n0;1.300,5\n0,01;1299,5\n",
          {"log.csv:2: z [mm] = 1.300.5; is not a number", "thousands separators"}),
      csv("Infinite", head + "0.01,inf\n",
          {"log.csv:3: z [mm] = inf; must be a finite number", "Leave the cell empty"}),
      csv("TimeMissing", head + ",299\n",
          {"log.csv:3: t [s] = ; every row must have a time", "Remove the row"}),
      csv("TimeRepeats", head + "0,299\n",
          {"log.csv:3: t [s] = 0; repeats the time before, 0", "--cut"}),
      csv("TimeGoesBack", head + "0.02,299\n0.01,298\n",
          {"log.csv:4: t [s] = 0.01; goes back behind the time before, 0.02", "sort the rows"}),
      csv("OutOfRange", head + "0.01,3e12\n",
          {"log.csv:3: z [mm] = 3e12 mm; must be in [-1e6, 1e6] m", "Check its unit"}),
      csv("NoUnit", "t [s],z [V]\n0,1\n0.01,1\n",
          {"log.csv: column z [V] in V; is no unit that is known", "m, mm, cm", "--map y=z [V]:m"}),
      csv("OtherUnit", "t [s],z [N]\n0,1\n0.01,1\n",
          {"log.csv: column z [N] in N; body_y_m is a length"}),
      csv("NoUnitAtAll", "t,z\n0,1\n1,1\n",
          {"log.csv: column z; its unit stands nowhere", "--map y=z:m"}, {"t=t:s", "y=z"}),
      csv("NoSuchColumn", head, {"log.csv: column zz; there is no such column", "Did you mean z?"},
          {"t=t", "y=zz"}),
      csv("TwoSuchColumns", "t [s],z [mm],z [mm]\n0,1,2\n1,1,2\n",
          {"log.csv: column z; 2 columns are called so", "#2 or #3"}),
      csv("Contact", "t [s],c\n0,0\n0.01,0.5\n", {"log.csv:3: c = 0.5; must be 0 or 1"},
          {"t=t", "contact=c"}),
      csv("NoTime", "z [mm]\n300\n299\n",
          {"log.csv: no column could be told to be the time", "--map t=COLUMN:ms", "--rate 500"},
          {"y=z"}),
      {"CsvAbsent", "log.csv", [](const auto&) {}, kMap, {"log.csv: there is no such file"}},
  };
}

std::vector<Malformed> OpenSimCases() {
  const std::string trc = FallTrc(MakeFall()), sto = FallSto(MakeFall());
  const auto one = [](const std::string& name, const std::string& file, const std::string& text,
                      const Strings& says) {
    return Malformed{name, file, Text(text), file == "drop.trc" ? kTrcMap : kStoMap, says};
  };
  return {
      one("TrcOther", "drop.trc", "Frame,Time\n1,0\n",
          {"drop.trc:1: Frame,Time; the first line of a TRC must begin with PathFileType"}),
      one("TrcHeaderOnly", "drop.trc", trc.substr(0, trc.find("Frame#")),
          {"drop.trc:3: 3 lines; a TRC has five lines of header", "export it again"}),
      one("TrcCutOff", "drop.trc", WithoutLastLine(trc),
          {"drop.trc:3: NumFrames = 40; the file has 39 rows of samples", "cut off"}),
      one("TrcUnits", "drop.trc", Replaced(trc, "\tmm\t", "\tfurlong\t"),
          {"drop.trc:3: Units = furlong; is no unit of length", "Known: m, mm"}),
      one("TrcMarkers", "drop.trc", Replaced(trc, "\t2\tmm", "\t3\tmm"),
          {"drop.trc:3: NumMarkers = 3; the file has 2 markers in line 4"}),
      {"TrcHidden",
       "drop.trc",
       Text(trc),
       {"y=TOE.Y"},
       {"drop.trc: column TOE.Y; has no sample at all", "Map another column to body_y_m"}},
      one("TrcRagged", "drop.trc", Replaced(trc, "\t12.00\t0.00\t\t\n", "\t12.00\n"),
          {"drop.trc:7: 5 cells; must have 8"}),
      one("StoNoEnd", "drop.sto", Replaced(sto, "endheader", "end"),
          {"drop.sto:1: has no line endheader", "--format csv"}),
      one("StoCutOff", "drop.sto", WithoutLastLine(sto),
          {"drop.sto:3: nRows = 40; the file has 39 rows of samples", "cut off"}),
      one("StoColumns", "drop.sto", Replaced(sto, "nColumns=4", "nColumns=5"),
          {"drop.sto:4: nColumns = 5; the file has 4 columns"}),
      one("StoDegrees", "drop.sto", Replaced(sto, "inDegrees=yes", "inDegrees=maybe"),
          {"drop.sto:5: inDegrees = maybe; must be yes or no"}),
      one("StoSpatial", "drop.sto", Replaced(sto, "version=1", "DataType=SpatialVec"),
          {"drop.sto:2: DataType = SpatialVec; only tables of double, Quaternion", "flatten()"}),
      one("StoNoTuples", "drop.sto", Replaced(sto, "version=1", "DataType=Quaternion"),
          {"drop.sto:12: pelvis_tx = 0.00000; must be 4 numbers, separated by commas",
           "Export the table again."}),
      one("StoClockSet", "drop.sto", Replaced(sto, "0.152\t", "0.002\t"),
          {"goes back behind the time before, 0.148", "--mend-times"}),
      one("StoEmpty", "drop.sto", "a\nendheader\n",
          {"drop.sto:2: ends after its header", "Export the motion again."}),
  };
}

std::vector<Malformed> MotiveCases() {
  const std::string take = FallMotive(MakeFall());
  const auto one = [](const std::string& name, const std::string& text, const Strings& says,
                      const Strings& map = kMotiveMap) {
    return Malformed{"Motive" + name, "take.csv", Text(text), map, says};
  };
  return {
      one("NoAxes", Replaced(take, "Frame,Time", "Bild,Zeit"),
          {"has no row that begins Frame,Time", "export the take again"}),
      one("NoNames", "Format Version,1.23,Length Units,Meters\n\nFrame,Time (Seconds),X\n0,0,1\n",
          {"take.csv:3: 0 rows; a Motive export has at least three", "header information on"}),
      one("Units", Replaced(take, "Units,Millimeters", "Units,Stadia"),
          {"take.csv:1: Length Units = Stadia; is no unit of length", "Meters"}),
      one("CutOff", WithoutLastLine(take),
          {"take.csv:1: Total Exported Frames = 40; the file has 39 rows of samples"}),
      one("Ragged", Replaced(take, ",0.10,,,\n", "\n"), {"take.csv:8: 9 cells; must have 13"}),
      one("TwoMarkers", Replaced(take, ",hip:Marker1,hip:Marker1,hip:Marker1", ",hip,hip,hip"),
          {"take.csv: column hip.Position.Y; 2 columns are called so", "#8 or #12"}),
  };
}

std::vector<Malformed> BinaryCases() {
  const Strings mat_map = {"t=t:s", "y=log.pos(:,2):mm"}, h5_map = {"t=/t:ms", "y=/body/pos[:,1]"};
  return {
      {"MatText",
       "log.mat",
       Text("t = 1:10;\n"),
       mat_map,
       {"log.mat: is no MAT-file of version 5, 7 or 7.3", "save('log.mat', '-v7'"}},
      {"MatCutOff",
       "log.mat",
       Cut(WriteMat, 20),
       mat_map,
       {"log.mat: size = ", "is cut off", "copy or save it again"}},
      {"MatDamaged",
       "log.mat",
       WriteDamagedMat,
       mat_map,
       {"log.mat: variable 1; cannot be read", "The file is damaged"}},
      {"MatWords",
       "log.mat",
       WriteWordsMat,
       mat_map,
       {"log.mat: runs (no numbers); has no numeric vector or array", "a struct or a table"}},
      {"MatTableCutOff",
       "log.mat",
       [](const auto& file) { WriteTableMat(file, 1, 0x200); },
       mat_map,
       {"log.mat: objects; have a region that lies outside their description",
        "copy or save it again"}},
      {"MatTableRows",
       "log.mat",
       [](const auto& file) { WriteTableMat(file, 5, 0); },
       mat_map,
       {"log.mat: T.z; has 2 rows; the table has 5", "copy or save it again"}},
      {"MatNoColumn",
       "log.mat",
       WriteMat,
       {"t=t:s", "y=log.pos(:,3):mm"},
       {"log.mat: column log.pos(:,3); there is no such column", "Did you mean log.pos(:,1)?"}},
      {"Hdf5Text", "log.h5", Text("t,z\n0,1\n"), h5_map, {"log.h5: is no HDF5 file", "--format"}},
      {"Hdf5CutOff",
       "log.h5",
       Cut(WriteHdf5, 200),
       h5_map,
       {"log.h5: cannot be opened as HDF5", "cut off"}},
      {"Hdf5Scalars",
       "log.h5",
       WriteScalarHdf5,
       h5_map,
       {"log.h5: has no numeric dataset of one or two dimensions", "as datasets of numbers"}},
      {"Hdf5NoColumn",
       "log.h5",
       WriteHdf5,
       {"t=/time:ms", "y=/body/pos[:,1]"},
       {"log.h5: column /time; there is no such column", "/body/pos[:,0]"}},
  };
}

std::vector<Malformed> AllCases() {
  std::vector<Malformed> all;
  for (const auto& cases : {CsvCases(), OpenSimCases(), MotiveCases(), BinaryCases()})
    all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

class MalformedRecording : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedRecording, IsRefusedWithPlaceValueRuleAndRemedy) {
  const Malformed& bad = GetParam();
  const TempFolder temp;
  bad.write(temp.path() / bad.file);
  const long before = CountEntries(temp.path());
  std::vector<std::string> arguments = {"import", bad.file, "--out", "made"};
  for (const std::string& entry : bad.map) {
    arguments.emplace_back("--map");
    arguments.push_back(entry);
  }
  const ProcessResult run = RunHoplab(arguments, temp.path());
  EXPECT_EQ(run.exit_code, 65) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("hoplab import: ")) << run.err;
  for (const std::string& part : bad.says)
    EXPECT_NE(run.err.find(part), std::string::npos) << "no \"" << part << "\" in:\n" << run.err;
  EXPECT_EQ(CountEntries(temp.path()), before) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(All, MalformedRecording, ::testing::ValuesIn(AllCases()),
                         [](const auto& info) { return info.param.name; });

TEST(MalformedRecording, CutOffAnywhereABinaryFileNeitherCrashesNorBecomesADataset) {
  const TempFolder temp;
  const auto cases = {std::make_pair("log.mat", WriteMat), std::make_pair("log.h5", WriteHdf5)};
  for (const auto& [name, write] : cases) {
    write(temp.path() / name);
    const std::string whole = ReadText(temp.path() / name);
    for (int part = 0; part < 12; ++part) {
      WriteText(temp.path() / name, whole.substr(0, whole.size() * part / 12));
      const ProcessResult run = RunHoplab(
          {"import", name, "--map", "t=t:s", "--map", "y=z:m", "--out", "made"}, temp.path());
      EXPECT_EQ(run.exit_code, 65) << name << ", " << part << " twelfths: " << run.err;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(temp.path() / "made"));
}

}  // namespace
}  // namespace hoplab::testing
