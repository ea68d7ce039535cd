#include "app/report_page.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "app/report_headline.h"
#include "app/report_table.h"
#include "base/check.h"
#include "web/assets.h"

namespace hoplab {
namespace {

// Cells a page may hold, of all its tables together: about 2.5 MB of the 6 a page may have.
constexpr std::size_t kCells = 440000;
// Longer lists of a record stand in its tables, too.
constexpr std::size_t kLongList = 2000;

Json WithoutLongLists(Json record) {
  Json left_out = Json::array();
  for (auto it = record.begin(); it != record.end();) {
    const bool is_long = it->is_array() && it->size() > kLongList;
    // The rows of a sweep are its table.
    if (is_long || it.key() == "rows") {
      left_out.push_back(it.key());
      it = record.erase(it);
    } else {
      ++it;
    }
  }
  record["left_out_of_page"] = left_out;
  return record;
}

Json PackedTables(const std::map<std::string, std::string>& files) {
  std::map<std::string, ReportTable> tables;
  std::size_t cells = 0;
  for (const auto& [name, text] : files) {
    if (!name.ends_with(".csv")) continue;
    cells += tables.emplace(name.substr(0, name.size() - 4), ReportTable(name, text))
                 .first->second.cells();
  }
  Json packed = Json::object();
  for (const auto& [name, table] : tables) {
    // Every table gives the same share of its rows where there are too many.
    const std::size_t most = cells <= kCells ? table.rows()
                                             : static_cast<std::size_t>(
                                                   static_cast<double>(table.rows()) *
                                                   static_cast<double>(kCells) /
                                                   static_cast<double>(cells));
    packed[name] = table.Packed(most);
  }
  return packed;
}

// Numbers stay in one line with their units: a blank between a digit and a letter does not break.
std::string FirmUnits(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool firm = text[i] == ' ' && i > 0 && i + 1 < text.size() && text[i - 1] >= '0' &&
                      text[i - 1] <= '9' && (std::isalpha(static_cast<unsigned char>(text[i + 1])) ||
                                             text[i + 1] == '%');
    out += firm ? "&nbsp;" : std::string(1, text[i]);
  }
  return out;
}

std::string FigureHtml(const Json& record, const HeadlineFigure& figure) {
  const Json::json_pointer path(figure.pointer);
  const Json value = record.contains(path) ? record.at(path) : Json(nullptr);
  std::string html = "<div class=\"figure\" data-pointer=\"" + HtmlText(figure.pointer) + "\"";
  if (value.is_number()) html += " data-value=\"" + HtmlText(value.dump()) + "\"";
  html += "><dt>" + HtmlText(figure.label) + "</dt><dd><span class=\"number\">" +
          HtmlText(figure.value) + "</span>";
  if (!figure.unit.empty()) html += " <span class=\"unit\">" + HtmlText(figure.unit) + "</span>";
  html += "</dd>";
  if (!figure.note.empty()) html += "<dd class=\"note\">" + HtmlText(figure.note) + "</dd>";
  return html + "</div>\n";
}

std::string FiguresHtml(const Json& record, const Headline& headline) {
  std::string html;
  for (const HeadlineFigure& figure : headline.figures) html += FigureHtml(record, figure);
  return html;
}

// Surfaces need a second plotting library.
bool HasSurfaces(const Json& record) {
  const auto figures = record.find("figures");
  return figures != record.end() && figures->is_array() &&
         std::any_of(figures->begin(), figures->end(), [](const Json& figure) {
           return figure.is_object() && figure.value("kind", "") == "surface";
         });
}

// `{{name}}` of the template is what `value` gives; what it gives is not looked into.
std::string Filled(std::string_view page,
                   const std::map<std::string, std::function<std::string()>, std::less<>>& values) {
  std::string out;
  while (true) {
    const std::size_t begin = page.find("{{");
    out += page.substr(0, begin);
    if (begin == page.npos) return out;
    const std::size_t end = page.find("}}", begin);
    HOPLAB_CHECK(end != page.npos);
    const auto value = values.find(page.substr(begin + 2, end - begin - 2));
    HOPLAB_CHECK(value != values.end());
    out += value->second();
    page.remove_prefix(end + 2);
  }
}

}  // namespace

std::string ScriptJson(const Json& value) {
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string HtmlText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string ReportPage(const Json& record, const std::map<std::string, std::string>& files) {
  const Headline headline = HeadlineOf(record);
  const auto asset = [](const char* name) {
    return [name] { return std::string(WebAsset(name)); };
  };
  const auto text = [](std::string value) {
    return [value = std::move(value)] { return value; };
  };
  return Filled(
      WebAsset("page.html"),
      {{"title", text(HtmlText(headline.title))},
       {"sentence", text(FirmUnits(HtmlText(headline.sentence)))},
       {"figures", text(FiguresHtml(record, headline))},
       {"status", text(HtmlText(record.value("status", "")))},
       {"style", asset("report.css")},
       {"plotting", asset("plotly.js")},
       {"plotting_3d",
        [&] { return HasSurfaces(record) ? std::string(WebAsset("plotly-3d.js")) : ""; }},
       {"script", asset("report.js")},
       {"run", [&] { return ScriptJson(WithoutLongLists(record)); }},
       {"tables", [&] { return ScriptJson(PackedTables(files)); }},
       {"plotting_license", text(HtmlText(std::string(WebAsset("plotly-license.txt"))))},
       {"license", text(HtmlText(std::string(WebAsset("hoplab-license.txt"))))}});
}

}  // namespace hoplab
