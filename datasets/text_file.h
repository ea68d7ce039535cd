#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hoplab {

/// `bytes` without a byte order mark. Throws InputError with `place` and the line if they are no
/// UTF-8 text: a NUL or another control character, an invalid sequence, UTF-16.
std::string_view CheckText(std::string_view bytes, const std::string& place);

/// The remedy for a file or folder that is not there: "Did you mean hops/rig-drops?" of what lies
/// beside it, else `remedy`.
std::string NearestPath(const std::filesystem::path& absent, const char* remedy);

/// The bytes of the file. Throws InputError if it is absent, no regular file (a folder, a pipe, a
/// device), larger than `max_bytes` (`shrink` is the remedy then) or cannot be read.
std::string ReadFileBytes(const std::filesystem::path& file, std::uint64_t max_bytes,
                          const char* shrink = "Cut the recording or lower its sample rate.");

}  // namespace hoplab
