#include <algorithm>
#include <fstream>
#include <string>

#include "base/input_error.h"
#include "datasets/import/table.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxTextBytes = 256ull << 20;

std::string FirstBytes(const fs::path& file, std::size_t count) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(count, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

}  // namespace

std::vector<std::string> LogFormatNames() { return {"csv", "motive", "trc", "sto", "mat", "hdf5"}; }

LogFormat FormatOfFile(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".trc") return LogFormat::kTrc;
  if (extension == ".mot" || extension == ".sto") return LogFormat::kStorage;
  if (extension == ".mat") return LogFormat::kMat;
  if (extension == ".h5" || extension == ".hdf5" || extension == ".hdf") return LogFormat::kHdf5;
  std::error_code error;
  if (fs::is_regular_file(file, error)) {
    std::string first = FirstBytes(file, 20);
    if (first.starts_with("\xEF\xBB\xBF")) first.erase(0, 3);
    if (first.starts_with("Format Version")) return LogFormat::kMotive;
    if (first.starts_with("PathFileType")) return LogFormat::kTrc;
  }
  return LogFormat::kCsv;
}

Table ReadLog(const fs::path& file, LogFormat format) {
  if (format == LogFormat::kMat) return ReadMat(file);
  if (format == LogFormat::kHdf5) return ReadHdf5(file);
  std::string bytes = ReadFileBytes(file, kMaxTextBytes);
  const std::string name = file.string();
  switch (format) {
    case LogFormat::kMotive:
      return ReadMotiveCsv(std::move(bytes), name);
    case LogFormat::kTrc:
      return ReadTrc(std::move(bytes), name);
    case LogFormat::kStorage:
      return ReadStorage(std::move(bytes), name);
    default:
      return ReadPlainCsv(std::move(bytes), name);
  }
}

}  // namespace hoplab
