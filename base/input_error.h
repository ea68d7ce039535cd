#pragma once

#include <stdexcept>
#include <string>

namespace hoplab {

/// Bad input, told so that the reader can mend it: where it stands, what it says, the rule it
/// breaks, the remedy. Thrown where input is read, caught once in `main`, exit code 65.
/// Example: `drop.yaml:12: leg.E_Pa = -4; must be in (0, 1e13] Pa. Check the sign.`
class InputError : public std::runtime_error {
 public:
  struct Parts {
    std::string place;   // "drop.yaml:12" or a file or option name
    std::string value;   // "leg.E_Pa = -4"; may be empty
    std::string rule;    // "must be in (0, 1e13] Pa"
    std::string remedy;  // "Check the sign."; may be empty
  };
  explicit InputError(const Parts& parts) : std::runtime_error(Message(parts)), parts_(parts) {}
  const Parts& parts() const { return parts_; }

 private:
  static std::string Message(const Parts& p) {
    std::string text = p.place;
    if (!p.value.empty()) text += ": " + p.value;
    text += (p.value.empty() ? ": " : "; ") + p.rule;
    if (!p.remedy.empty()) text += ". " + p.remedy;
    return text;
  }
  Parts parts_;
};

}  // namespace hoplab
