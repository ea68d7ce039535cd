#include "app/terminal/command_line.h"

#include <algorithm>
#include <ostream>

#include "app/terminal/command.h"
#include "app/terminal/help_text.h"
#include "app/terminal/usage_error.h"
#include "app/version.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

class CommandLine {
 public:
  CommandLine(const Program& program, Console& console) : program_(program), console_(console) {
    app_.name("hoplab");
    app_.formatter(std::make_shared<HelpFormatter>(console.out_columns));
    app_.set_version_flag("--version", "hoplab " + ProjectVersion());
    app_.require_subcommand(1);
    app_.footer("hoplab COMMAND --help says more. Begin with: hoplab fit datasets/rig-drops");
    for (const Command* command : program.commands) {
      CLI::App& sub = *app_.add_subcommand(command->name, command->what);
      sub.footer(command->footer);
      command->add(sub, invocation_);
    }
  }

  ExitCode Run(int argc, const char* const* argv) {
    json_ =
        std::any_of(argv, argv + argc, [](const char* a) { return std::string(a) == "--json"; });
    try {
      return ParseAndRun(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
      app_.exit(done, console_.out, console_.err);
      return ExitCode::kDone;
    } catch (const CLI::ExtrasError&) {
      const std::string hint = OptionHint();
      return Fail(ExitCode::kWrongUse,
                  (hint.empty() ? Unexpected() : hint) + " See " + HelpCall() + ".");
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

  // What is too much, in the order it was given. (CLI11 tells it backwards.)
  std::string Unexpected() const {
    std::vector<std::string> words = app_.remaining(true);
    for (std::string& word : words) word = Printable(word);
    return Join(words) + (words.size() > 1 ? ": these are" : ": this is") + " not expected here.";
  }

  std::string HelpCall() const {
    return command_.empty() ? "hoplab --help" : "hoplab " + command_ + " --help";
  }

  ExitCode Fail(ExitCode code, const std::string& message) {
    if (json_) console_.out << program_.failure_text(command_, message) << std::flush;
    console_.err << Styled("hoplab" + (command_.empty() ? "" : " " + command_) + ":",
                           Emphasis::kError, console_.err_colours)
                 << ' ' << message << std::endl;
    return code;
  }

  const Program& program_;
  Console& console_;
  CLI::App app_{"Fits compliant-leg hopping models to recorded traces"};
  Invocation invocation_;
  std::string command_;  // empty: none was recognised
  bool json_ = false;
};

}  // namespace

ExitCode RunCommandLine(const Program& program, int argc, const char* const* argv,
                        Console& console) {
  return CommandLine(program, console).Run(argc, argv);
}

}  // namespace hoplab
