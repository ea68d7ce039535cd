#include "app/reports/kept_work.h"

#include <ostream>

namespace hoplab {

ExitCode TellKeptWork(const std::string& done, const std::string& file, Json record, bool json,
                      Console& console) {
  const std::string message =
      "interrupted; " + done + " are kept in " + file + ", the same command computes the others";
  SetFailed(record, message);
  if (json) console.out << TextOf(record);
  console.err << "hoplab " << record["command"].get<std::string>() << ": " << message << '\n';
  return ExitCode::kInterrupted;
}

}  // namespace hoplab
