// The page of a report.

#include "tools/report/html_report.h"

#include <gtest/gtest.h>

namespace talus::html_report_test {
namespace {

Report sample() {
  return {"Speed <of> \"piles\"",
          "two runs",
          {{"Results & more",
            {Paragraph{"a < b"}, Table{"Times", {{"scene"}, {"time [s]", true}}, {{"drop", "1.25"}, {"line", "10.5"}}},
             Figure{"<?xml version=\"1.0\"?>\n<svg width=\"10\"><text>t</text></svg>\n", "A plot"}}}}};
}

TEST(HtmlReport, ShowsTextAsItIs) {
  const std::string html = html_of(sample());
  EXPECT_NE(html.find("<h1>Speed &lt;of&gt; &quot;piles&quot;</h1>"), std::string::npos);
  EXPECT_NE(html.find("<h2>Results &amp; more</h2>"), std::string::npos);
  EXPECT_NE(html.find("<p>a &lt; b</p>"), std::string::npos);
}

TEST(HtmlReport, AlignsNumbersToTheRight) {
  const std::string html = html_of(sample());
  EXPECT_NE(html.find("<th class=\"number\">time [s]</th>"), std::string::npos);
  EXPECT_NE(html.find("<tr><td>drop</td><td class=\"number\">1.25</td></tr>"), std::string::npos);
  EXPECT_NE(html.find(".number { text-align: right"), std::string::npos);
}

TEST(HtmlReport, HoldsItsFiguresWithoutTheirFileHead) {
  const std::string html = html_of(sample());
  EXPECT_NE(html.find("<figure><svg width=\"10\"><text>t</text></svg><figcaption>A plot"), std::string::npos);
  EXPECT_EQ(html.find("<?xml"), std::string::npos);
}

TEST(HtmlReport, AsksForNothingFromElsewhere) {
  const std::string html = html_of(sample());
  for (const char* reference : {"src=", "href=", "url(", "@import", "<script"})
    EXPECT_EQ(html.find(reference), std::string::npos) << reference;
}

TEST(HtmlReport, HoldsAnotherPageWithItsMarkupEscaped) {
  const std::string html = html_of(Report{"t", "", {{"s", {EmbeddedPage{"<p class=\"a\">b & c</p>", "player"}}}}});
  EXPECT_NE(html.find("srcdoc=\"&lt;p class=&quot;a&quot;&gt;b &amp; c&lt;/p&gt;\""), std::string::npos);
}

TEST(HtmlReport, KeepsTheLinesOfAListing) {
  const std::string html = html_of(Report{"t", "", {{"s", {Listing{"a <\nb", "file"}}}}});
  EXPECT_NE(html.find("<summary>file</summary><pre>a &lt;\nb</pre>"), std::string::npos);
}

TEST(HtmlReport, RefusesRaggedTablesAndFiguresThatAreNoSvg) {
  EXPECT_THROW(html_of(Report{"t", "", {{"s", {Table{"c", {{"a"}, {"b"}}, {{"1"}}}}}}}), std::invalid_argument);
  EXPECT_THROW(html_of(Report{"t", "", {{"s", {Figure{"no drawing", "c"}}}}}), std::invalid_argument);
}

}  // namespace
}  // namespace talus::html_report_test
