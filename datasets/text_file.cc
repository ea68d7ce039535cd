#include "datasets/text_file.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void NoText(std::string_view bytes, std::size_t at, const std::string& place,
                         const std::string& reason) {
  const auto line = 1 + std::count(bytes.begin(), bytes.begin() + static_cast<long>(at), '\n');
  throw InputError({place + ":" + std::to_string(line), "", "is no UTF-8 text (" + reason + ")",
                    "Save the file as plain text in UTF-8."});
}

// Length of the UTF-8 sequence that starts at `at`; 0 if it is invalid: a stray or missing
// continuation, an overlong form, a surrogate, a value above U+10FFFF.
std::size_t SequenceLength(std::string_view bytes, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  const unsigned lead = byte(at);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  const unsigned second = byte(at + 1);
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
      (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

}  // namespace

std::string_view CheckText(std::string_view bytes, const std::string& place) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  const std::string_view start = bytes.substr(0, 2);
  if (start == "\xFF\xFE" || start == "\xFE\xFF") NoText(bytes, 0, place, "it looks like UTF-16");
  for (std::size_t i = 0; i < bytes.size();) {
    const unsigned char c = static_cast<unsigned char>(bytes[i]);
    if (c == 0) NoText(bytes, i, place, "a NUL byte");
    // A YAML reader takes 0x04 for the end of the file and drops the rest without a word.
    if ((c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F)
      NoText(bytes, i, place, "a control character");
    const std::size_t length = SequenceLength(bytes, i);
    if (length == 0) NoText(bytes, i, place, "an invalid byte sequence");
    i += length;
  }
  return bytes;
}

std::string NearestPath(const fs::path& absent, const char* remedy) {
  // A path with an end of its own, "rig-drop/", names a folder.
  const fs::path path = absent.has_filename() ? absent : absent.parent_path();
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::string> beside;
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error))
    beside.push_back(entry->path().filename().string());
  std::sort(beside.begin(), beside.end());
  const std::optional<std::string> nearest = NearestWord(path.filename().string(), beside);
  if (!nearest) return remedy;
  return "Did you mean " + (path.parent_path() / *nearest).string() + "?";
}

std::string ReadFileBytes(const fs::path& file, std::uint64_t max_bytes, const char* shrink) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status))
    throw InputError(
        {file.string(), "", "there is no such file", NearestPath(file, "Check the name.")});
  if (!fs::is_regular_file(status))
    throw InputError(
        {file.string(), "", "must be a file, and is a folder or a device", "Name a text file."});
  const std::uintmax_t size = fs::file_size(file, error);
  if (!error && size > max_bytes)
    throw InputError({file.string(), "size = " + std::to_string(size) + " bytes",
                      "must be at most " + std::to_string(max_bytes) + " bytes", shrink});
  std::ifstream in(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (error || !in)
    throw InputError({file.string(), "", "cannot be read", "Check its permissions."});
  return bytes;
}

}  // namespace hoplab
