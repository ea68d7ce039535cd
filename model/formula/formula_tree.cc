#include "model/formula/formula_tree.h"

#include <algorithm>
#include <boost/spirit/home/x3.hpp>
#include <cctype>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "model/formula/formula_error.h"

namespace hoplab {
namespace {

namespace x3 = boost::spirit::x3;
using Kind = FormulaTree::Kind;

// Where the text begins, for the places of its parts.
struct TextTag;
template <class Context>
std::size_t PlaceOf(const char* at, Context& ctx) {
  const char* const begin = x3::get<TextTag>(ctx);
  return static_cast<std::size_t>(at - begin);
}

const auto kTakeNumber = [](auto& ctx) {
  FormulaTree& tree = x3::_val(ctx);
  const auto& text = x3::_attr(ctx);
  tree.begin = tree.at = PlaceOf(text.begin(), ctx);
  tree.end = PlaceOf(text.end(), ctx);
  const std::optional<double> number = ParseDouble({text.begin(), text.size()});
  tree.number = number.value_or(std::nan(""));
};
const auto kTakeName = [](auto& ctx) {
  FormulaTree& tree = x3::_val(ctx);
  const auto& text = x3::_attr(ctx);
  tree.kind = Kind::kName;
  tree.name = std::string(text.begin(), text.end());
  tree.begin = tree.at = PlaceOf(text.begin(), ctx);
  tree.end = PlaceOf(text.end(), ctx);
};
const auto kTakeArgument = [](auto& ctx) {
  FormulaTree& tree = x3::_val(ctx);
  tree.kind = Kind::kCall;
  tree.arguments.push_back(std::move(x3::_attr(ctx)));
};
const auto kTakeClose = [](auto& ctx) { x3::_val(ctx).end = PlaceOf(x3::_attr(ctx).end(), ctx); };
const auto kTake = [](auto& ctx) { x3::_val(ctx) = std::move(x3::_attr(ctx)); };

// The operator is met first, its right side after it.
const auto kTakeOperator = [](auto& ctx) {
  FormulaTree& tree = x3::_val(ctx);
  FormulaTree whole;
  const char sign = *x3::_attr(ctx).begin();
  whole.kind = sign == '+'   ? Kind::kSum
               : sign == '-' ? Kind::kDifference
               : sign == '*' ? Kind::kProduct
               : sign == '/' ? Kind::kQuotient
                             : Kind::kPower;
  whole.at = PlaceOf(x3::_attr(ctx).begin(), ctx);
  whole.begin = tree.begin;
  whole.arguments.push_back(std::move(tree));
  tree = std::move(whole);
};
const auto kTakeRight = [](auto& ctx) {
  FormulaTree& tree = x3::_val(ctx);
  tree.end = x3::_attr(ctx).end;
  tree.arguments.push_back(std::move(x3::_attr(ctx)));
};
const auto kTakeMinus = [](auto& ctx) {
  FormulaTree& tree = x3::_val(ctx);
  tree.kind = Kind::kMinus;
  tree.begin = tree.at = PlaceOf(x3::_attr(ctx).begin(), ctx);
};

const x3::rule<struct SumTag, FormulaTree> kSum = "part";
const x3::rule<struct ProductTag, FormulaTree> kProduct = "part";
const x3::rule<struct SignedTag, FormulaTree> kSigned = "part";
const x3::rule<struct PowerTag, FormulaTree> kPower = "part";
const x3::rule<struct PrimaryTag, FormulaTree> kPrimary = "part";
const x3::rule<struct NamedTag, FormulaTree> kNamed = "a name";
const x3::rule<struct CloseTag, boost::iterator_range<const char*>> kClose =
    "an operator, a comma or )";

const auto kDigits = +x3::digit;
const auto kNumberText =
    x3::raw[x3::lexeme[((kDigits >> -('.' >> *x3::digit)) | ('.' >> kDigits)) >>
                       -((x3::lit('e') | 'E') >> -(x3::lit('+') | '-') >> kDigits)]];
const auto kNameText = x3::raw[x3::lexeme[(x3::alpha | '_') >> *(x3::alnum | '_')]];

const auto kClose_def = x3::raw[x3::lit(')')];
const auto kNamed_def = kNameText[kTakeName] >>
                        -('(' > kSum[kTakeArgument] > *(',' > kSum[kTakeArgument]) >
                          kClose[kTakeClose]);
const auto kPrimary_def = kNumberText[kTakeNumber] | kNamed[kTake] | ('(' > kSum[kTake] > kClose);
const auto kPower_def = kPrimary[kTake] >>
                        -(x3::raw[x3::lit('^')][kTakeOperator] > kSigned[kTakeRight]);
const auto kSigned_def = (x3::raw[x3::lit('-')][kTakeMinus] > kSigned[kTakeRight]) |
                         (x3::lit('+') > kSigned[kTake]) | kPower[kTake];
const auto kProduct_def = kSigned[kTake] >>
                          *(x3::raw[x3::char_("*/")][kTakeOperator] > kSigned[kTakeRight]);
const auto kSum_def = kProduct[kTake] >>
                      *(x3::raw[x3::char_("+-")][kTakeOperator] > kProduct[kTakeRight]);

BOOST_SPIRIT_DEFINE(kSum, kProduct, kSigned, kPower, kPrimary, kNamed, kClose)

// What no parser should have to recurse through.
void CheckSize(std::string_view text) {
  if (text.size() > kLongestFormula)
    throw FormulaError(FormulaError::Of::kFormula,
                       "must have at most " + std::to_string(kLongestFormula) +
                           " characters, has " + std::to_string(text.size()),
                       "Split it into several effects.");
  int depth = 0, signs = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    const bool sign = c == '-' || c == '+' || c == '^';
    if (sign) ++signs;
    if (!sign && c != ' ' && c != '(') signs = c == '^' ? signs : 0;
    if (depth > kDeepestFormula || signs > kDeepestFormula)
      throw FormulaError(i, i + 1,
                         "is nested deeper than " + std::to_string(kDeepestFormula) + " levels",
                         "Remove parentheses and signs that say nothing, or split the effect.");
  }
}

// What must stand at a place: after a whole part an operator, else a part.
[[noreturn]] void FailAt(std::string_view text, std::size_t at) {
  constexpr std::string_view kUsed = "+-*/^(),._ ";
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
  const bool ends = at >= text.size();
  const char c = ends ? ' ' : text[at];
  if (!ends && !std::isalnum(static_cast<unsigned char>(c)) &&
      kUsed.find(c) == std::string_view::npos)
    throw FormulaError(at, at + 1, Printable(text.substr(at, 1)) + " has no meaning in a formula",
                       "Use numbers, names, + - * / ^, parentheses and commas.");
  std::size_t before = at;
  while (before > 0 && std::isspace(static_cast<unsigned char>(text[before - 1]))) --before;
  const char last = before > 0 ? text[before - 1] : ' ';
  const bool after_part =
      std::isalnum(static_cast<unsigned char>(last)) || last == '_' || last == '.' || last == ')';
  const std::string_view read = text.substr(0, at);
  const auto open =
      std::count(read.begin(), read.end(), '(') - std::count(read.begin(), read.end(), ')');
  const std::string where = ends ? " here, and the formula ends" : " here";
  if (!after_part)
    throw FormulaError(at, at + 1, "must have a number, a name or (" + where,
                       ends ? "Complete the formula." : "Write what is meant between the two.");
  if (open > 0)
    throw FormulaError(at, at + 1, "must have an operator, a comma or )" + where,
                       "A parenthesis was opened and not closed, or an operator is missing.");
  if (c == ')')
    throw FormulaError(at, at + 1, "closes a parenthesis that was never opened",
                       "Remove it, or open one before.");
  throw FormulaError(at, at + 1, "must have an operator" + where,
                     "Write what is meant between the two.");
}

}  // namespace

FormulaTree ParseFormula(std::string_view text) {
  CheckSize(text);
  // The parser's classes of characters are those of ASCII.
  const auto foreign = std::find_if(text.begin(), text.end(),
                                    [](char c) { return static_cast<unsigned char>(c) > 127; });
  if (foreign != text.end()) FailAt(text, static_cast<std::size_t>(foreign - text.begin()));
  if (Trim(text).empty())
    throw FormulaError(FormulaError::Of::kFormula, "is empty", "Write one, as \"-c * vx\".");
  FormulaTree tree;
  const char* first = text.data();
  const char* const begin = first;
  const char* const last = first + text.size();
  const auto grammar = x3::with<TextTag>(begin)[kSum];
  try {
    if (!x3::phrase_parse(first, last, grammar, x3::space, tree))
      FailAt(text, static_cast<std::size_t>(first - begin));
  } catch (const x3::expectation_failure<const char*>& e) {
    FailAt(text, static_cast<std::size_t>(e.where() - begin));
  }
  if (first != last) FailAt(text, static_cast<std::size_t>(first - begin));
  return tree;
}

}  // namespace hoplab
