#include "app/command_line.h"

#include <algorithm>
#include <ostream>

#include "app/command.h"
#include "app/commands/check.h"
#include "app/commands/compare.h"
#include "app/commands/completion.h"
#include "app/commands/design.h"
#include "app/commands/diagnose.h"
#include "app/commands/discover.h"
#include "app/commands/effects.h"
#include "app/commands/explain.h"
#include "app/commands/export.h"
#include "app/commands/fit.h"
#include "app/commands/gait.h"
#include "app/commands/generate.h"
#include "app/commands/identify.h"
#include "app/commands/import.h"
#include "app/commands/laws.h"
#include "app/commands/man.h"
#include "app/commands/optimize.h"
#include "app/commands/report.h"
#include "app/commands/reproduce.h"
#include "app/commands/simulate.h"
#include "app/commands/sweep.h"
#include "app/commands/version.h"
#include "app/help_text.h"
#include "app/run_record.h"
#include "app/usage_error.h"
#include "app/version.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

class CommandLine {
 public:
  explicit CommandLine(Console& console) : console_(console) {
    app_.name("hoplab");
    app_.formatter(std::make_shared<HelpFormatter>(console.out_columns));
    app_.set_version_flag("--version", "hoplab " + ProjectVersion());
    app_.require_subcommand(1);
    app_.footer("hoplab COMMAND --help says more. Begin with: hoplab fit datasets/rig-drops");
    AddImportCommand(app_, invocation_);
    AddCheckCommand(app_, invocation_);
    AddFitCommand(app_, invocation_);
    AddDiagnoseCommand(app_, invocation_);
    AddDiscoverCommand(app_, invocation_);
    AddDesignCommand(app_, invocation_);
    AddCompareCommand(app_, invocation_);
    AddGaitCommand(app_, invocation_);
    AddOptimizeCommand(app_, invocation_);
    AddSweepCommand(app_, invocation_);
    AddReproduceCommand(app_, invocation_);
    AddIdentifyCommand(app_, invocation_);
    AddSimulateCommand(app_, invocation_);
    AddGenerateCommand(app_, invocation_);
    AddReportCommand(app_, invocation_);
    AddExportCommand(app_, invocation_);
    AddLawsCommand(app_, invocation_);
    AddEffectsCommand(app_, invocation_);
    AddExplainCommand(app_, invocation_);
    AddCompletionCommand(app_, invocation_);
    AddManCommand(app_, invocation_);
    AddVersionCommand(app_, invocation_);
  }

  ExitCode Run(int argc, const char* const* argv) {
    json_ =
        std::any_of(argv, argv + argc, [](const char* a) { return std::string(a) == "--json"; });
    try {
      return ParseAndRun(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
      app_.exit(done, console_.out, console_.err);
      return ExitCode::kDone;
    } catch (const CLI::ParseError& error) {
      const std::string hint = OptionHint();
      return Fail(ExitCode::kWrongUse,
                  (hint.empty() ? Stop(error.what()) : hint) + " See " + HelpCall() + ".");
    } catch (const UsageError& error) {
      return Fail(ExitCode::kWrongUse, Stop(error.what()) + " See " + HelpCall() + ".");
    } catch (const InputError& error) {
      return Fail(ExitCode::kBadInput, error.what());
    } catch (const std::bad_alloc&) {
      return Fail(ExitCode::kNoResult, "not enough memory");
    } catch (const std::exception& error) {
      return Fail(ExitCode::kBug,
                  std::string("this is a bug in hoplab, not in your input: ") + error.what());
    }
  }

 private:
  ExitCode ParseAndRun(int argc, const char* const* argv) {
    if (argc < 2) {
      console_.err << app_.help();
      return ExitCode::kWrongUse;
    }
    const std::string first = argv[1];
    const std::vector<std::string> known = CommandNames();
    if (std::find(known.begin(), known.end(), first) != known.end()) {
      command_ = first;
    } else if (!first.starts_with("-")) {
      throw UsageError("there is no command " + Printable(first) + ". " + DidYouMean(first, known));
    }
    app_.parse(argc, argv);
    if (invocation_.plain) MakePlain(console_);
    const ExitCode code = invocation_.run(console_);
    console_.out.flush();
    if (!console_.out) throw InputError({"standard output", "", "cannot be written", ""});
    return code;
  }

  std::vector<std::string> CommandNames() {
    std::vector<std::string> names;
    for (const CLI::App* sub : app_.get_subcommands({})) names.push_back(sub->get_name());
    return names;
  }

  // With a stop at the end.
  static std::string Stop(std::string text) {
    if (!text.ends_with('.') && !text.ends_with('?')) text += '.';
    return text;
  }

  // An unknown long option with the one it was probably meant to be, whatever else is wrong.
  std::string OptionHint() {
    if (command_.empty()) return "";
    const CLI::App* sub = app_.get_subcommand(command_);
    std::vector<std::string> known;
    for (const CLI::Option* option : sub->get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    for (const std::string& extra : app_.remaining(true)) {
      if (!extra.starts_with("--")) continue;
      if (const auto nearest = NearestWord(extra.substr(0, extra.find('=')), known))
        return Printable(extra) + ": there is no such option. Did you mean " + *nearest + "?";
    }
    return "";
  }

  std::string HelpCall() const {
    return command_.empty() ? "hoplab --help" : "hoplab " + command_ + " --help";
  }

  ExitCode Fail(ExitCode code, const std::string& message) {
    if (json_) console_.out << TextOf(FailureRecord(command_, message)) << std::flush;
    console_.err << Styled("hoplab" + (command_.empty() ? "" : " " + command_) + ":",
                           Emphasis::kError, console_.err_colours)
                 << ' ' << message << std::endl;
    return code;
  }

  Console& console_;
  CLI::App app_{"Fits compliant-leg hopping models to recorded traces"};
  Invocation invocation_;
  std::string command_;  // empty: none was recognised
  bool json_ = false;
};

}  // namespace

ExitCode RunCommandLine(int argc, const char* const* argv, Console& console) {
  return CommandLine(console).Run(argc, argv);
}

}  // namespace hoplab
