#include "app/reports/report_page.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>
#include <vector>

#include "app/reports/explain.h"
#include "app/reports/headline.h"
#include "app/reports/report_table.h"
#include "base/check.h"
#include "web/assets.h"

namespace hoplab {
namespace {

// A page stays below 6 MB; what the scripts leave of this is for the tables.
constexpr double kPageBytes = 5.7e6;
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

// How many rows of each table fit into `bytes`: all of a small one, an equal share of the rest for
// each of the large ones.
std::map<std::string, std::size_t> RowsThatFit(const std::map<std::string, ReportTable>& tables,
                                               double bytes) {
  std::vector<std::pair<double, std::string>> by_size;
  for (const auto& [name, table] : tables)
    by_size.emplace_back(table.bytes_per_row() * static_cast<double>(table.rows()), name);
  std::sort(by_size.begin(), by_size.end());
  std::map<std::string, std::size_t> rows;
  for (std::size_t i = 0; i < by_size.size(); ++i) {
    const auto& [size, name] = by_size[i];
    const ReportTable& table = tables.at(name);
    const double share = std::min(size, bytes / static_cast<double>(by_size.size() - i));
    bytes -= share;
    rows[name] =
        size <= share ? table.rows() : static_cast<std::size_t>(share / table.bytes_per_row());
  }
  return rows;
}

Json PackedTables(const std::map<std::string, std::string>& files, double bytes) {
  std::map<std::string, ReportTable> tables;
  for (const auto& [name, text] : files) {
    if (name.ends_with(".csv"))
      tables.emplace(name.substr(0, name.size() - 4), ReportTable(name, text));
  }
  Json packed = Json::object();
  for (const auto& [name, rows] : RowsThatFit(tables, bytes))
    packed[name] = tables.at(name).Packed(rows);
  return packed;
}

// Numbers stay in one line with their units: a blank between a digit and a letter does not break.
std::string FirmUnits(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool firm = text[i] == ' ' && i > 0 && i + 1 < text.size() && text[i - 1] >= '0' &&
                      text[i - 1] <= '9' &&
                      (std::isalpha(static_cast<unsigned char>(text[i + 1])) || text[i + 1] == '%');
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
           // One value over a plane is a map.
           return figure.is_object() && figure.value("kind", Json()) == "surface" &&
                  figure.value("columns", Json()).size() > 3;
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
  const std::string plotting_3d(HasSurfaces(record) ? WebAsset("plotly-3d.js") : "");
  const std::string run = ScriptJson(WithoutLongLists(record));
  const std::string explanations = ScriptJson(ExplanationsFor(record));
  const auto taken =
      static_cast<double>(WebAsset("plotly.js").size() + plotting_3d.size() +
                          WebAsset("report.js").size() + run.size() + explanations.size());
  const auto asset = [](const char* name) {
    return [name] { return std::string(WebAsset(name)); };
  };
  const auto text = [](std::string value) { return [value = std::move(value)] { return value; }; };
  return Filled(
      WebAsset("page.html"),
      {{"title", text(HtmlText(headline.title))},
       {"sentence", text(FirmUnits(HtmlText(headline.sentence)))},
       {"figures", text(FiguresHtml(record, headline))},
       {"status", text(record.value("status", Json()) == "failed" ? "failed" : "ok")},
       {"style", asset("report.css")},
       {"plotting", asset("plotly.js")},
       {"plotting_3d", text(plotting_3d)},
       {"script", asset("report.js")},
       {"run", text(run)},
       {"explanations", text(explanations)},
       {"tables",
        [&] { return ScriptJson(PackedTables(files, std::max(0.0, kPageBytes - taken))); }},
       {"plotting_license", text(HtmlText(std::string(WebAsset("plotly-license.txt"))))},
       {"license", text(HtmlText(std::string(WebAsset("hoplab-license.txt"))))}});
}

}  // namespace hoplab
