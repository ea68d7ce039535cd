#include "app/terminal/completion.h"

#include "app/terminal/completion_parts.h"
#include "base/check.h"

namespace hoplab {

std::string CompletionScript(const CLI::App& app, std::string_view shell,
                             ValuesOfOption values_of) {
  if (shell == "bash") return BashScript(app, values_of);
  if (shell == "zsh") return ZshScript(app, values_of);
  HOPLAB_CHECK(shell == "fish");
  return FishScript(app, values_of);
}

}  // namespace hoplab
