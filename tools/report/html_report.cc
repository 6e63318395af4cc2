#include "tools/report/html_report.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "tools/report/style.h"

namespace talus {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string cell(const char* tag, const Column& column, const std::string& text) {
  return fmt::format("<{0}{1}>{2}</{0}>", tag, column.number ? " class=\"number\"" : "", escaped(text));
}

std::string html_of(const Paragraph& paragraph) { return "<p>" + escaped(paragraph.text) + "</p>\n"; }

std::string html_of(const Table& table) {
  std::string html = "<div class=\"wide\"><table>\n";
  if (!table.caption.empty()) html += "<caption>" + escaped(table.caption) + "</caption>\n";
  html += "<thead><tr>";
  for (const Column& column : table.columns) html += cell("th", column, column.name);
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw std::invalid_argument(fmt::format("table \"{}\": a row of {} cells, must have {} as there are columns",
                                              table.caption, row.size(), table.columns.size()));
    }
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) html += cell("td", table.columns[i], row[i]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// Within a page an SVG begins at its element: what stands before it (declaration, document type) is for files.
std::string html_of(const Figure& figure) {
  const std::size_t begin = figure.svg.find("<svg");
  const std::size_t end = figure.svg.rfind("</svg>");
  if (begin == std::string::npos || end == std::string::npos)
    throw std::invalid_argument(fmt::format("figure \"{}\": must be the text of an SVG file", figure.caption));
  constexpr std::string_view closing = "</svg>";
  return "<figure>" + figure.svg.substr(begin, end + closing.size() - begin) + "<figcaption>" +
         escaped(figure.caption) + "</figcaption></figure>\n";
}

std::string html_of(const Listing& listing) {
  return "<details><summary>" + escaped(listing.caption) + "</summary><pre>" + escaped(listing.text) +
         "</pre></details>\n";
}

std::string html_of(const EmbeddedPage& page) {
  return fmt::format(
      R"(<figure class="page"><iframe title="{0}" srcdoc="{1}"></iframe><figcaption>{0}</figcaption></figure>)"
      "\n",
      escaped(page.caption), escaped(page.html));
}

}  // namespace

std::string html_of(const Report& report) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n",
      escaped(report.title), report_style);
  if (!report.subtitle.empty()) html += "<p class=\"subtitle\">" + escaped(report.subtitle) + "</p>\n";
  for (const Section& section : report.sections) {
    html += "<section>\n<h2>" + escaped(section.heading) + "</h2>\n";
    for (const Block& block : section.blocks) html += std::visit([](const auto& kind) { return html_of(kind); }, block);
    html += "</section>\n";
  }
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace talus
