#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace hoplab {

/// What a journal says where it cannot be used.
struct JournalWords {
  std::string writer;   // "sweep": who else may be writing it
  std::string foreign;  // what it holds if its header is another one
  std::string remedy;   // then
};

/// Lines of text on disk as they come, under a header that says what they belong to, so that work
/// which was interrupted goes on where it was. One process writes it.
class LineJournal {
 public:
  /// Opens or begins the journal; `visit` gets each whole line that stands there but the header, a
  /// torn last one is cut off. Throws InputError if the lines belong to another header (`discard`:
  /// they are thrown away) or another process is writing.
  LineJournal(std::filesystem::path file, const std::string& header, bool discard,
              JournalWords words, const std::function<void(std::string_view line)>& visit);
  LineJournal(const LineJournal&) = delete;
  LineJournal& operator=(const LineJournal&) = delete;
  ~LineJournal();

  /// Adds a line without its end; it is on its way to the disk when this returns. Throws InputError
  /// if it cannot be written.
  void Add(const std::string& line);
  const std::filesystem::path& file() const { return file_; }
  /// Deletes the file: its lines stand elsewhere now.
  void Remove();

 private:
  void Load(const std::string& text, const std::string& header, bool discard,
            const std::function<void(std::string_view)>& visit);
  void Write(std::string_view text);

  std::filesystem::path file_;
  JournalWords words_;
  int descriptor_ = -1;
};

}  // namespace hoplab
