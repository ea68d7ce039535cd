#include "app/terminal/man_page.h"

#include <sstream>

#include "app/version.h"

namespace hoplab {
namespace {

// Text for troff: backslashes and hyphens are themselves, no line is a request.
std::string Roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool begins_line = out.empty() || out.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string Term(const std::string& bold, const std::string& italic) {
  return ".TP\n" + (bold.empty() ? "" : "\\fB" + Roff(bold) + "\\fR") +
         (bold.empty() || italic.empty() ? "" : " ") +
         (italic.empty() ? "" : "\\fI" + Roff(italic) + "\\fR") + "\n";
}

std::string OptionTerms(const CLI::App& sub) {
  std::string text;
  for (const CLI::Option* option : sub.get_options()) {
    // Said once, for all commands.
    if (option->get_group().empty() || (sub.get_parent() && option == sub.get_help_ptr())) continue;
    const bool positional = option->get_positional();
    text += positional ? Term("", option->get_name(true, false))
                       : Term(option->get_name(false, true), option->get_option_text());
    text += Roff(option->get_description()) + "\n";
  }
  return text;
}

// What stands below the options in help: sentences first, then indented examples.
std::string FooterText(const std::string& footer) {
  std::string text;
  std::istringstream lines(footer);
  bool in_example = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line.starts_with("  ") != in_example) {
      in_example = !in_example;
      text += in_example ? ".RS 4\n.nf\n" : ".fi\n.RE\n.PP\n";
    } else if (!in_example && (text.empty() || line.ends_with(':'))) {
      text += ".PP\n";
    }
    text += Roff(in_example ? line.substr(2) : line) + "\n";
  }
  return text + (in_example ? ".fi\n.RE\n" : "");
}

constexpr const char* kEnd = R"(.SH EXIT STATUS
.TP
.B 0
Done, whatever the verdict.
.TP
.B 1
The run ended without a usable result.
.TP
.B 64
The command line is wrong.
.TP
.B 65
What it names is wrong: a file, a key, a value.
.TP
.B 70
A bug in hoplab.
.TP
.B 130
Interrupted; what was finished is kept.
.SH ENVIRONMENT
.TP
.B NO_COLOR
No colours if it is set to anything.
.TP
.B TERM
No colours and no line that is written over if it is \fBdumb\fR.
.TP
.B COLUMNS
How wide text may be.
.SH FILES
.TP
.I runs/NAME\-COMMAND\-NNN
A run folder: \fIrun.json\fR (schema hoplab\-run/1), the tables behind its plots as CSV, and
\fIreport.html\fR, which opens without a network.
.SH SEE ALSO
.BR mpirun (1)
)";

}  // namespace

std::string ManPage(const CLI::App& app) {
  std::string text = ".\\\" Written by `hoplab man`.\n.TH HOPLAB 1 \"\" \"hoplab " +
                     ProjectVersion() +
                     "\" \"User Commands\"\n.nh\n.ad l\n"
                     ".SH NAME\nhoplab \\- " +
                     Roff(app.get_description()) +
                     "\n.SH SYNOPSIS\n.B hoplab\n.I COMMAND\n.RI [ OPTIONS ]\n.SH DESCRIPTION\n" +
                     Roff(app.get_footer()) + "\n" + OptionTerms(app) + ".SH COMMANDS\n";
  for (const CLI::App* sub : app.get_subcommands({})) {
    if (sub->get_group().empty()) continue;
    text += ".SS hoplab " + Roff(sub->get_name()) + "\n" + Roff(sub->get_description()) + ".\n" +
            OptionTerms(*sub) + FooterText(sub->get_footer());
  }
  return text + kEnd;
}

}  // namespace hoplab
