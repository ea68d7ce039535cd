#include "experiments/line_journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/input_error.h"

namespace hoplab {

LineJournal::LineJournal(std::filesystem::path file, const std::string& header, bool discard,
                         JournalWords words,
                         const std::function<void(std::string_view line)>& visit)
    : file_(std::move(file)), words_(std::move(words)) {
  std::error_code ignored;
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), ignored);
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0)
    throw InputError({file_.string(), "", "cannot be written: " + std::string(strerror(errno)),
                      "Give another place with --out."});
  try {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      throw InputError({file_.string(), "", "is being written by another " + words_.writer,
                        "Wait for it, or give another place with --out."});
    std::ifstream in(file_, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    Load(text, header, discard, visit);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

LineJournal::~LineJournal() {
  if (descriptor_ >= 0) close(descriptor_);
}

void LineJournal::Load(const std::string& text, const std::string& header, bool discard,
                       const std::function<void(std::string_view)>& visit) {
  const std::size_t first_end = text.find('\n');
  const bool same = first_end != text.npos && text.substr(0, first_end) == header;
  const bool fresh = first_end == text.npos;  // empty, or torn in its first line
  if (!same && !fresh && !discard)
    throw InputError({file_.string(), "", words_.foreign, words_.remedy});
  if (!same || discard) {
    if (ftruncate(descriptor_, 0) != 0)
      throw InputError({file_.string(), "", "cannot be emptied", ""});
    Write(header + "\n");
    return;
  }
  const std::size_t whole = text.rfind('\n') + 1;  // what follows was torn by the interruption
  if (whole < text.size() && ftruncate(descriptor_, static_cast<off_t>(whole)) != 0)
    throw InputError({file_.string(), "", "cannot be mended", "Remove it."});
  for (std::size_t at = first_end + 1; at < whole;) {
    const std::size_t end = text.find('\n', at);
    visit(std::string_view(text).substr(at, end - at));
    at = end + 1;
  }
}

void LineJournal::Write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      throw InputError({file_.string(), "", "cannot be written: " + std::string(strerror(errno)),
                        "Make room, then start the same command again."});
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void LineJournal::Add(const std::string& line) { Write(line + "\n"); }

void LineJournal::Remove() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace hoplab
