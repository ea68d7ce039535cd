#include "app/records/compared_side.h"

#include <limits>

#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {

ComparedSide::ComparedSide(const ComparedRun& compared) : record_(compared.run.record) {
  std::filesystem::path folder = compared.folder;
  if (!folder.has_filename()) folder = folder.parent_path();
  name_ = Printable(folder.filename().string(), 60);
  const std::string place = Printable((folder / "run.json").string(), 200);
  const std::string command = TextAt(record_, "/command");
  if (command != "fit" && command != "diagnose") {
    throw InputError({place, "command = " + Printable(command),
                      "must be fit or diagnose: other runs have no values to compare",
                      "Give folders that fit or diagnose wrote."});
  }
  const bool named =
      TextAt(record_, "/verdict") == "named" || TextAt(record_, "/verdict") == "confounded";
  is_diagnosis_ = command == "diagnose";
  is_extended_ = is_diagnosis_ && named && JsonAt(record_, "/extension").is_object();
  part_ = is_extended_ ? "/extension" : is_diagnosis_ ? "/null" : "";
  const Json& parameters = JsonAt(record_, part_ + "/parameters");
  if (TextAt(record_, "/status") == "failed" || !parameters.is_array()) {
    throw InputError({place, "status = " + Printable(TextAt(record_, "/status")),
                      "must have a result: there is nothing to compare",
                      Printable(TextAt(record_, "/message"), 300)});
  }
}

const Json* ComparedSide::parameter(const std::string& name) const {
  for (const Json& p : parameters()) {
    if (TextAt(p, "/name") == name) return &p;
  }
  return nullptr;
}

const Json& ComparedSide::test() const {
  return JsonAt(record_, is_extended_ ? "/extension/test_after" : part_ + "/test");
}

const Json& ComparedSide::mechanism() const {
  return JsonAt(record_, is_extended_ ? "/extension/mechanism" : "/mechanism");
}

}  // namespace hoplab
