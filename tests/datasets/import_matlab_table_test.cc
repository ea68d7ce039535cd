// MATLAB's tables and timetables in files of versions 6, 7 and 7.3, written byte by byte by
// matlab_objects.cc: the columns come out, what is no number is named.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/datasets/import_samples.h"
#include "tests/datasets/matlab_tables.h"

namespace hoplab {
namespace {

using testing::Fall;
using testing::FallCsv;
using testing::ImportFile;
using testing::Kind;
using testing::MakeFall;
using testing::MatlabCells;
using testing::MatlabColumn;
using testing::MatlabFields;
using testing::MatlabMatrix;
using testing::MatlabNumber;
using testing::MatlabObjects;
using testing::MatlabStruct;
using testing::MatlabText;
using testing::MatlabTexts;
using testing::MatlabValue;
using testing::MatlabVariables;
using testing::MatlabVersion;
using testing::TableOf;
using testing::TempFolder;
using testing::TimetableOf;

std::vector<double> Milliseconds(const Fall& fall) {
  std::vector<double> out;
  for (const double t : fall.t_s) out.push_back(std::round(1e3 * t));
  return out;
}

class MatlabTables : public ::testing::Test {
 protected:
  std::filesystem::path Write(const MatlabVariables& variables, const MatlabObjects& objects,
                              MatlabVersion version) {
    return testing::WriteMatlab(temp_.path() / "drop.mat", variables, objects, version);
  }
  MatlabValue Positions() const {
    std::vector<double> numbers = fall_.x_mm;
    numbers.insert(numbers.end(), fall_.y_mm.begin(), fall_.y_mm.end());
    return MatlabMatrix(fall_.x_mm.size(), 2, numbers);
  }
  void ExpectFall(const ImportResult& result) {
    const std::string& csv = result.files.at(result.logs.at(0).file);
    EXPECT_EQ(ParseTraceCsv(csv, "drop.csv"), ParseTraceCsv(FallCsv(fall_), "expected"));
  }
  TempFolder temp_;
  const Fall fall_ = MakeFall();
};

TEST_F(MatlabTables, ColumnsAndUnitsOfATableAreReadInEveryVersion) {
  for (const MatlabVersion version : testing::kMatlabVersions) {
    SCOPED_TRACE(static_cast<int>(version));
    MatlabObjects objects;
    const MatlabValue table = objects.Add(
        "table", TableOf({{"t", MatlabColumn(fall_.t_s)}, {"pos", Positions()}}, {"s", "mm"}));
    const auto file = Write({{"T", table}, {"gain", MatlabColumn({1, 2})}}, objects, version);
    const ImportResult result = ImportFile(file, {"t=T.t", "x=T.pos(:,1)", "y=T.pos(:,2)"});
    ExpectFall(result);
    EXPECT_FALSE(result.map.HasGuesses());
    EXPECT_EQ(result.unused, std::vector<std::string>{"gain"});
    EXPECT_EQ(result.notes, std::vector<std::string>());
  }
}

TEST_F(MatlabTables, EarlierReleasesDescribeTheirObjectsShorter) {
  for (const std::uint32_t release : {2u, 3u}) {
    for (const MatlabVersion version : testing::kMatlabVersions) {
      MatlabObjects objects(release);
      const MatlabValue table = objects.Add(
          "table", TableOf({{"t", MatlabColumn(fall_.t_s)}, {"pos", Positions()}}, {"s", "mm"}));
      ExpectFall(ImportFile(Write({{"T", table}}, objects, version),
                            {"t=T.t", "x=T.pos(:,1)", "y=T.pos(:,2)"}));
    }
  }
}

TEST_F(MatlabTables, ATimetableHasItsTimes) {
  for (const MatlabVersion version : testing::kMatlabVersions) {
    SCOPED_TRACE(static_cast<int>(version));
    MatlabObjects objects;
    const MatlabValue zero = objects.Add("duration", {{"millis", MatlabNumber(0)}});
    const MatlabValue four = objects.Add("duration", {{"millis", MatlabNumber(4)}});
    const MatlabValue times = objects.Add(
        "duration", {{"millis", MatlabColumn(Milliseconds(fall_))}, {"fmt", MatlabText("s")}});
    std::vector<double> since_1970, rounded(fall_.t_s.size(), 1e-5);
    for (const double ms : Milliseconds(fall_)) since_1970.push_back(1.7e12 + ms);
    MatlabValue dates = MatlabColumn(since_1970);
    dates.imaginary = rounded;
    const MatlabValue moments = objects.Add("datetime", {{"data", dates}});
    const MatlabValue by_rate = MatlabStruct({{"origin", zero},
                                              {"specifiedAsRate", MatlabNumber(1)},
                                              {"stepSize", four},
                                              {"sampleRate", MatlabNumber(250)}});
    const MatlabValue by_step = MatlabStruct({{"origin", zero},
                                              {"specifiedAsRate", MatlabNumber(0)},
                                              {"stepSize", four},
                                              {"sampleRate", MatlabNumber(250)}});
    MatlabVariables variables;
    for (const auto& [name, rows] :
         MatlabVariables{{"A", times}, {"B", by_rate}, {"C", by_step}, {"D", moments}})
      variables.emplace_back(
          name,
          objects.Add("timetable",
                      TimetableOf(rows, fall_.t_s.size(), {{"pos", Positions()}}, {"mm"}), true));
    const auto file = Write(variables, objects, version);
    for (const char* name : {"A", "B", "C", "D"}) {
      SCOPED_TRACE(name);
      const std::string of = name;
      ExpectFall(ImportFile(
          file, {"t=" + of + ".Time", "x=" + of + ".pos(:,1)", "y=" + of + ".pos(:,2)"}));
    }
  }
}

TEST_F(MatlabTables, EveryKindOfNumberIsReadAndTheOthersAreNamed) {
  for (const MatlabVersion version : testing::kMatlabVersions) {
    SCOPED_TRACE(static_cast<int>(version));
    MatlabObjects objects;
    const MatlabValue durations = objects.Add("duration", {{"millis", MatlabColumn({0, 4, 8})}});
    const MatlabValue kinds =
        objects.Add("categorical", {{"codes", MatlabColumn({1, 2, 1}, Kind::kUint8)},
                                    {"categoryNames", MatlabTexts({"low", "high"})}});
    const MatlabValue words = objects.Add("string", {{"any", MatlabColumn({1, 2, 3, 1})}}, true);
    const MatlabValue inner = objects.Add("table", TableOf({{"q", MatlabColumn({1, 2, 3})}}));
    MatlabValue complex = MatlabColumn({1, 2, 3});
    complex.imaginary = {1, 0, 0};
    const MatlabValue table =
        objects.Add("table", TableOf({{"z_mm", MatlabColumn({300, 299.5, 298}, Kind::kSingle)},
                                      {"when", durations},
                                      {"count", MatlabColumn({-1, 0, 7}, Kind::kInt32)},
                                      {"down", MatlabColumn({0, 1, 1}, Kind::kLogical)},
                                      {"label", MatlabTexts({"a", "b", "c"})},
                                      {"kind", kinds},
                                      {"word", words},
                                      {"inner", inner},
                                      {"wave", complex}}));
    const MatlabValue series = objects.Add("timeseries", {{"Name", MatlabText("z")}});
    const MatlabValue nested = MatlabStruct({{"run", table}, {"fs", MatlabNumber(250)}});
    const auto file = Write({{"log", nested}, {"ts", series}}, objects, version);
    const ImportResult result =
        ImportFile(file, {"t=log.run.when", "y=log.run.z_mm", "contact=log.run.down"});
    EXPECT_EQ(result.files.at("drop.csv"),
              "time_s,body_y_m,contact\n0.000,0.300,0\n0.004,0.2995,1\n0.008,0.298,1\n");
    EXPECT_EQ(result.unused, std::vector<std::string>{"log.run.count"});
    const std::vector<std::string> expected = {
        "log.run.label is not read: no numbers",
        "log.run.kind is not read: objects of class categorical",
        "log.run.word is not read: objects of class string",
        "log.run.inner is not read: objects of class table",
        "log.run.wave is not read: complex numbers",
        "ts is not read: an object of MATLAB's class timeseries"};
    for (const std::string& note : expected)
      EXPECT_TRUE(std::any_of(
          result.notes.begin(), result.notes.end(),
          [&](const std::string& have) { return have.find(note) != std::string::npos; }))
          << note;
    EXPECT_EQ(result.notes.size(), expected.size());
  }
}

TEST_F(MatlabTables, WhatAClassHoldsByDefaultNeedNotBeSaved) {
  for (const MatlabVersion version : testing::kMatlabVersions) {
    MatlabObjects objects;
    MatlabFields fields =
        TableOf({{"t", MatlabColumn(fall_.t_s)}, {"pos", Positions()}}, {"s", "mm"});
    const auto rows = std::find_if(fields.begin(), fields.end(),
                                   [](const auto& f) { return f.first == "nrows"; });
    objects.SetDefault("table", {*rows, {"data", MatlabCells({})}});
    fields.erase(rows);
    const MatlabValue table = objects.Add("table", fields);
    ExpectFall(ImportFile(Write({{"T", table}}, objects, version),
                          {"t=T.t", "x=T.pos(:,1)", "y=T.pos(:,2)"}));
  }
}

TEST_F(MatlabTables, NamesOfMoreThan63LettersLieElsewhere) {
  MatlabObjects objects;
  MatlabFields fields = TableOf({{"t", MatlabColumn(fall_.t_s)}, {"cut", Positions()}});
  const std::string name = "position_of_the_hip_" + std::string(60, 'x');
  fields.back().second = MatlabStruct({{"VariableUnits", MatlabTexts({"s", "mm"})},
                                       {"useVariableNames2048", MatlabNumber(1)},
                                       {"VariableNames2048", MatlabTexts({"t", name})}});
  const MatlabValue table = objects.Add("table", fields);
  ExpectFall(ImportFile(Write({{"T", table}}, objects, MatlabVersion::k7),
                        {"t=T.t", "x=T." + name + "(:,1)", "y=T." + name + "(:,2)"}));
}

}  // namespace
}  // namespace hoplab
