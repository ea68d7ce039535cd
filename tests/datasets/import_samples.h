#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/import/import.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {

/// A fall from 0.3 m at 1.3 m/s forward, 250 samples a second: what the samples hold, in mm with
/// two decimals.
struct Fall {
  std::vector<double> t_s, x_mm, y_mm;
};
inline Fall MakeFall(int rows = 40) {
  Fall fall;
  for (int i = 0; i < rows; ++i) {
    const double t = 0.004 * i;
    fall.t_s.push_back(std::round(1e3 * t) / 1e3);
    fall.x_mm.push_back(std::round(1e5 * 1.3 * t) / 1e2);
    fall.y_mm.push_back(std::round(1e5 * (0.3 - 4.905 * t * t)) / 1e2);
  }
  return fall;
}

inline std::string Format(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// What every sample imports to: the digits of Fall, in metres.
inline std::string FallCsv(const Fall& fall) {
  std::string csv = "time_s,body_x_m,body_y_m\n";
  for (std::size_t i = 0; i < fall.t_s.size(); ++i)
    csv += Format("%.3f", fall.t_s[i]) + "," + Format("%.5f", fall.x_mm[i] / 1e3) + "," +
           Format("%.5f", fall.y_mm[i] / 1e3) + "\n";
  return csv;
}

/// The header OpenSim and Cortex write; x forward, y up, one marker more.
inline std::string FallTrc(const Fall& fall, const std::string& units = "mm") {
  const std::string rows = std::to_string(fall.t_s.size());
  std::string text =
      "PathFileType\t4\t(X/Y/Z)\tdrop.trc\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
      "OrigNumFrames\n"
      "250.00\t250.00\t" +
      rows + "\t2\t" + units + "\t250.00\t1\t" + rows +
      "\n"
      "Frame#\tTime\tR.HIP\t\t\tTOE\t\t\n"
      "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
      "\n";
  for (std::size_t i = 0; i < fall.t_s.size(); ++i)
    text += std::to_string(i + 1) + "\t" + Format("%.3f", fall.t_s[i]) + "\t" +
            Format("%.2f", fall.x_mm[i]) + "\t" + Format("%.2f", fall.y_mm[i]) +
            "\t12.00\t0.00\t\t\n";
  return text;
}

/// As OpenSim 4 prints a table of coordinates: metres, angles in degrees.
inline std::string FallSto(const Fall& fall) {
  const std::string rows = std::to_string(fall.t_s.size());
  std::string text = "Coordinates\nversion=1\nnRows=" + rows +
                     "\nnColumns=4\ninDegrees=yes\n\n"
                     "Units are S.I. units (second, meters, Newtons, ...)\n"
                     "If the header above contains a line with 'inDegrees', this indicates whether "
                     "rotational values are in degrees (yes) or radians (no).\n\nendheader\n"
                     "time\tpelvis_tx\tpelvis_ty\thip_flexion_r\n";
  for (std::size_t i = 0; i < fall.t_s.size(); ++i)
    text += Format("%.3f", fall.t_s[i]) + "\t" + Format("%.5f", fall.x_mm[i] / 1e3) + "\t" +
            Format("%.5f", fall.y_mm[i] / 1e3) + "\t25.0\n";
  return text;
}

/// A rigid body and a marker as Motive 3 exports them; y up, the body moves along -z.
inline std::string FallMotive(const Fall& fall) {
  std::string text =
      "Format Version,1.23,Take Name,drop,Take Notes,,Capture Frame Rate,250.000000,Export Frame "
      "Rate,250.000000,Capture Start Time,2024-03-05 10.11.12.345 AM,Capture Start Frame,0,Total "
      "Frames in Take," +
      std::to_string(fall.t_s.size()) + ",Total Exported Frames," +
      std::to_string(fall.t_s.size()) +
      ",Rotation Type,Quaternion,Length Units,Millimeters,Coordinate Space,Global\n"
      "\n"
      ",Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid "
      "Body,Marker,Marker,Marker\n"
      ",Name,hip,hip,hip,hip,hip,hip,hip,hip,hip:Marker1,hip:Marker1,hip:Marker1\n"
      ",ID,\"3A01\",\"3A01\",\"3A01\",\"3A01\",\"3A01\",\"3A01\",\"3A01\",\"3A01\",\"7B02\","
      "\"7B02\",\"7B02\"\n"
      ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker "
      "Error,Position,Position,Position\n"
      "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z,,X,Y,Z\n";
  for (std::size_t i = 0; i < fall.t_s.size(); ++i)
    text += std::to_string(i) + "," + Format("%.3f", fall.t_s[i]) +
            ",0.000000,0.000000,0.000000,1.000000,4.00," + Format("%.2f", fall.y_mm[i]) + "," +
            Format("%.2f", -fall.x_mm[i]) + ",0.10,,,\n";
  return text;
}

/// A MAT-file of vectors t, x and a struct: log.pos(:,1..2) in mm, log.fs.
inline void WriteFallMat(const std::filesystem::path& file, const Fall& fall, mat_ft version) {
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, version);
  std::size_t column[2] = {fall.t_s.size(), 1};
  std::size_t pair[2] = {fall.t_s.size(), 2};
  std::size_t one[2] = {1, 1};
  std::vector<double> t = fall.t_s, positions = fall.x_mm;
  positions.insert(positions.end(), fall.y_mm.begin(), fall.y_mm.end());
  double rate = 250;
  const auto array = [](const char* name, std::size_t* size, double* data) {
    return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, data, 0);
  };
  const char* fields[] = {"pos", "fs"};
  matvar_t* log = Mat_VarCreateStruct("log", 2, one, fields, 2);
  Mat_VarSetStructFieldByName(log, "pos", 0, array("pos", pair, positions.data()));
  Mat_VarSetStructFieldByName(log, "fs", 0, array("fs", one, &rate));
  matvar_t* time = array("t", column, t.data());
  std::vector<float> singles(fall.t_s.size(), 0.1f);
  matvar_t* single =
      Mat_VarCreate("gain", MAT_C_SINGLE, MAT_T_SINGLE, 2, column, singles.data(), 0);
  for (matvar_t* variable : {time, log, single}) {
    Mat_VarWrite(mat, variable,
                 version == MAT_FT_MAT5 ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
  }
  Mat_Close(mat);
}

/// As Qualisys Track Manager exports a measurement: a struct named after its file with FrameRate
/// and markers x coordinate x frame in mm, NaN where a marker was hidden; the body moves along -X,
/// Z up.
inline void WriteFallQualisys(const std::filesystem::path& file, const Fall& fall, mat_ft version,
                              bool labelled = true) {
  mat_t* mat = Mat_CreateVer(file.c_str(), nullptr, version);
  std::size_t one[2] = {1, 1}, two[2] = {1, 2};
  const std::size_t frames = fall.t_s.size();
  std::size_t cube[3] = {2, 4, frames};
  double rate = 250;
  const double nan = std::nan("");
  std::vector<double> data;
  for (std::size_t i = 0; i < frames; ++i)
    for (const double value : {-fall.x_mm[i], nan, 12.0, nan, fall.y_mm[i], nan, 0.4, nan})
      data.push_back(value);
  const char* top[] = {"File", "FrameRate", "Trajectories"};
  const char* of_trajectories[] = {"Labeled"};
  const char* of_labeled[] = {"Labels", "Data"};
  matvar_t* root = Mat_VarCreateStruct("drop0001", 2, one, top, 3);
  matvar_t* trajectories = Mat_VarCreateStruct("Trajectories", 2, one, of_trajectories, 1);
  matvar_t* marked = Mat_VarCreateStruct("Labeled", 2, one, of_labeled, 2);
  std::vector<std::string> names = {"hip", "toe"};
  const auto text = [](std::string& name) {
    std::size_t size[2] = {1, name.size()};
    return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, size, name.data(), 0);
  };
  matvar_t* cells[] = {text(names[0]), text(names[1])};
  matvar_t* labels = Mat_VarCreate("Labels", MAT_C_CELL, MAT_T_CELL, 2, two, cells, 0);
  Mat_VarSetStructFieldByName(
      marked, "Data", 0,
      Mat_VarCreate("Data", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, cube, data.data(), 0));
  if (labelled) Mat_VarSetStructFieldByName(marked, "Labels", 0, labels);
  Mat_VarSetStructFieldByName(trajectories, "Labeled", 0, marked);
  Mat_VarSetStructFieldByName(
      root, "FrameRate", 0,
      Mat_VarCreate("FrameRate", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &rate, 0));
  Mat_VarSetStructFieldByName(root, "Trajectories", 0, trajectories);
  Mat_VarWrite(mat, root, version == MAT_FT_MAT5 ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE);
  Mat_VarFree(root);
  if (!labelled) Mat_VarFree(labels);
  Mat_Close(mat);
}

/// /t in ms as 64-bit integers, /body/pos of two columns with the attribute units = mm, and a table
/// of members t_s and z_m.
inline void WriteFallHdf5(const std::filesystem::path& file, const Fall& fall) {
  const hid_t h5 = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t rows = fall.t_s.size();
  const hsize_t pair[2] = {rows, 2};
  const auto write = [](hid_t in, const char* name, hid_t stored, hid_t type, hid_t space,
                        const void* data) {
    const hid_t dataset =
        H5Dcreate2(in, name, stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    return dataset;
  };
  std::vector<long long> t_ms;
  std::vector<double> positions;
  struct Row {
    double t_s;
    float z_m;
  };
  std::vector<Row> table;
  for (std::size_t i = 0; i < rows; ++i) {
    t_ms.push_back(std::llround(1e3 * fall.t_s[i]));
    positions.push_back(fall.x_mm[i]);
    positions.push_back(fall.y_mm[i]);
    table.push_back({fall.t_s[i], static_cast<float>(fall.y_mm[i] / 1e3)});
  }
  const hid_t line = H5Screate_simple(1, &rows, nullptr);
  const hid_t plane = H5Screate_simple(2, pair, nullptr);
  H5Dclose(write(h5, "t", H5T_STD_I64LE, H5T_NATIVE_LLONG, line, t_ms.data()));
  const hid_t body = H5Gcreate2(h5, "body", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t pos = write(body, "pos", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, plane, positions.data());
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, 2);
  const hid_t scalar = H5Screate(H5S_SCALAR);
  const hid_t units = H5Acreate2(pos, "units", text, scalar, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(units, text, "mm");
  const hid_t row = H5Tcreate(H5T_COMPOUND, sizeof(Row));
  H5Tinsert(row, "t_s", HOFFSET(Row, t_s), H5T_NATIVE_DOUBLE);
  H5Tinsert(row, "z_m", HOFFSET(Row, z_m), H5T_NATIVE_FLOAT);
  H5Dclose(write(h5, "table", row, row, line, table.data()));
  H5Aclose(units);
  H5Sclose(scalar);
  H5Tclose(text);
  H5Tclose(row);
  H5Dclose(pos);
  H5Gclose(body);
  H5Sclose(plane);
  H5Sclose(line);
  H5Fclose(h5);
}

/// Imports one file with these --map options.
inline ImportResult ImportFile(const std::filesystem::path& file,
                               const std::vector<std::string>& map,
                               const TraceOptions& options = {}) {
  ImportRequest request;
  request.logs = {{file}};
  request.name = "drop";
  for (const std::string& entry : map) request.map.push_back(ParseMapEntry(entry).value());
  request.options = options;
  return ImportLogs(request);
}

/// Writes the fall in some format and reads what is imported of it.
class FallImport : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& text) {
    WriteText(temp_.path() / name, text);
    return temp_.path() / name;
  }
  /// The only trial's CSV.
  static std::string CsvOf(const ImportResult& result) {
    return result.files.at(result.logs.at(0).file);
  }
  TempFolder temp_;
  const Fall fall_ = MakeFall();
};

}  // namespace hoplab::testing
