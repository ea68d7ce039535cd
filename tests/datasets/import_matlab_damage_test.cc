// MATLAB's tables in files that are damaged: place, value, rule and remedy, no crash.

#include <gtest/gtest.h>

#include <algorithm>

#include "base/input_error.h"
#include "base/random.h"
#include "datasets/import/mat_objects.h"
#include "datasets/import/mat_tables.h"
#include "tests/datasets/import_samples.h"
#include "tests/datasets/matlab_tables.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::ImportFile;
using testing::InputErrorOf;
using testing::MatlabColumn;
using testing::MatlabFields;
using testing::MatlabNumber;
using testing::MatlabObjects;
using testing::MatlabStruct;
using testing::MatlabText;
using testing::MatlabTexts;
using testing::MatlabValue;
using testing::MatlabVersion;
using testing::TableOf;
using testing::WriteMatlab;
using testing::WriteText;

class MatlabDamage : public ::testing::Test {
 protected:
  testing::TempFolder temp_;
  const std::filesystem::path file_ = temp_.path() / "drop.mat";
};

std::string Refusal(const std::filesystem::path& file) {
  return InputErrorOf([&] { ReadMat(file); });
}

TEST_F(MatlabDamage, WhatContradictsItselfIsToldByNameWithARemedy) {
  struct Wrong {
    std::string of, says;
    MatlabValue value;
  };
  const std::vector<Wrong> cases = {
      {"nrows", "T; has no number of rows", MatlabText("many")},
      {"nrows", "T.t; has 3 rows; the table has 4", MatlabNumber(4)},
      {"varnames", "T; has 2 columns and 1 names", MatlabTexts({"t"})},
      {"data", "a form of table that is not known", MatlabNumber(1)},
      {"nrows", "T (fewer than two rows)", MatlabNumber(1)},
  };
  for (const MatlabVersion version : testing::kMatlabVersions) {
    for (const Wrong& wrong : cases) {
      MatlabObjects objects;
      MatlabFields fields =
          TableOf({{"t", MatlabColumn({0, 1, 2})}, {"z", MatlabColumn({3, 2, 1})}}, {"s", "m"});
      std::find_if(fields.begin(), fields.end(), [&](const auto& f) {
        return f.first == wrong.of;
      })->second = wrong.value;
      const auto file = WriteMatlab(file_, {{"T", objects.Add("table", fields)}}, objects, version);
      const std::string told = Refusal(file);
      EXPECT_NE(told.find(wrong.says), std::string::npos) << told;
    }
  }
}

TEST_F(MatlabDamage, AReferenceThatLeadsNowhereIsTold) {
  const std::vector<std::pair<std::size_t, std::string>> cases = {
      {1, "have a reference that is cut off"}, {4, "have no object 77"}};
  for (const MatlabVersion version : testing::kMatlabVersions) {
    for (const auto& [word, says] : cases) {
      MatlabObjects objects;
      MatlabValue table = objects.Add("table", TableOf({{"t", MatlabColumn({0, 1})}}));
      table.real[word] = 77;
      const std::string told = Refusal(WriteMatlab(file_, {{"T", table}}, objects, version));
      EXPECT_NE(told.find("objects; " + says), std::string::npos) << told;
      EXPECT_NE(told.find("copy or save it again"), std::string::npos) << told;
    }
    MatlabObjects newer(9);
    const MatlabValue table = newer.Add("table", TableOf({{"t", MatlabColumn({0, 1})}}));
    const std::string told = Refusal(WriteMatlab(file_, {{"T", table}}, newer, version));
    EXPECT_NE(told.find("version = 9; must be 2, 3 or 4. Save s = table2struct"), std::string::npos)
        << told;
  }
}

// The bytes of a small table, as -v6 saves it.
std::string SmallTable(bool timetable) {
  MatlabObjects objects;
  const MatlabValue times = objects.Add("duration", {{"millis", MatlabColumn({0, 4, 8})}});
  const std::vector<std::pair<std::string, MatlabValue>> columns = {
      {"z", MatlabColumn({3, 2, 1})}, {"label", MatlabTexts({"a", "b", "c"})}};
  const MatlabValue table =
      timetable ? objects.Add("timetable", testing::TimetableOf(times, 3, columns, {"m", ""}), true)
                : objects.Add("table", TableOf(columns, {"m", ""}));
  return Level5Bytes({{"log", MatlabStruct({{"T", table}})}, {"T", table}}, objects, false);
}

// Columns read, or the refusal. Anything else than an InputError goes on.
std::string Outcome(const std::string& bytes) {
  try {
    const MatSubsystem subsystem = ReadMat5Subsystem(bytes, false, "log.mat");
    Table table;
    table.file = "log.mat";
    const MatObjects objects(subsystem);
    for (const MatReference& reference : subsystem.references)
      AddMatTable(objects, reference, &table);
    return std::to_string(table.columns.size()) + " columns";
  } catch (const InputError& error) {
    const InputError::Parts& parts = error.parts();
    EXPECT_TRUE(!parts.place.empty() && !parts.rule.empty() && !parts.remedy.empty())
        << error.what();
    return "refused";
  }
}

TEST_F(MatlabDamage, BytesThatAreChangedOrCutNeitherCrashNorHang) {
  RandomStream random(11, 0);
  for (const bool timetable : {false, true}) {
    const std::string whole = SmallTable(timetable);
    ASSERT_EQ(Outcome(whole), timetable ? "4 columns" : "2 columns");
    int refused = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) Outcome(whole.substr(0, length));
    for (int i = 0; i < 20000; ++i) {
      std::string bytes = whole;
      for (int changes = 1 + i % 3; changes > 0; --changes) {
        const auto at =
            static_cast<std::size_t>(random.Uniform(116, static_cast<double>(bytes.size())));
        const double kind = random.Uniform(0, 4);
        bytes[at] = kind < 1   ? '\xFF'
                    : kind < 2 ? '\0'
                               : static_cast<char>(static_cast<int>(random.Uniform(0, 256)));
      }
      refused += Outcome(bytes) == "refused";
    }
    EXPECT_GT(refused, 2000);
  }
}

// What the HDF5 library makes of damage to its own bytes is the library's; here the bytes of the
// description change, which it only hands on.
TEST_F(MatlabDamage, ADescriptionIn73WithChangedBytesNeitherCrashesNorHangs) {
  MatlabObjects objects;
  const MatlabValue value = objects.Add(
      "table", TableOf({{"t", MatlabColumn({0, 1, 2})}, {"z", MatlabColumn({3, 2, 1})}}, {"s"}));
  WriteMatlab(file_, {{"T", value}}, objects, MatlabVersion::k73);
  const std::string whole = testing::ReadText(file_), description = objects.Description(false);
  const std::size_t begin = whole.find(description);
  ASSERT_NE(begin, std::string::npos);
  RandomStream random(12, 0);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bytes = whole;
    bytes[begin +
          static_cast<std::size_t>(random.Uniform(0, static_cast<double>(description.size())))] =
        static_cast<char>(static_cast<int>(random.Uniform(0, 256)));
    WriteText(file_, bytes);
    try {
      const MatSubsystem subsystem = ReadMat73Subsystem(file_.string());
      Table table;
      AddMatTable(MatObjects(subsystem), subsystem.references.at(0), &table);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace hoplab
