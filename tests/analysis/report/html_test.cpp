#include "analysis/report/html.h"

#include "analysis/drawing/svg.h"
#include "tests/support/checks.h"
#include "tests/support/xml_check.h"

namespace swarmsmith {
namespace {

TEST(XmlCheck, FindsWhatIsWrong) {
  EXPECT_EQ(xml_trouble("<!DOCTYPE html>\n<a b=\"c &amp; d\"><e/>f</a>\n"), "");
  EXPECT_THAT(xml_trouble("<a><b></a></b>"), HasSubstr("a wrong end"));
  EXPECT_THAT(xml_trouble("<a>this & that</a>"), HasSubstr("a bare &"));
  EXPECT_THAT(xml_trouble("<a><br></a>"), HasSubstr("a wrong end"));
  EXPECT_THAT(xml_trouble("<a>"), HasSubstr("never closed"));
  EXPECT_THAT(xml_trouble("<a/><b/>"), HasSubstr("a second root"));
}

TEST(Html, EscapesWhatMeansSomething) {
  EXPECT_EQ(html_escaped("<b a=\"1\">&"), "&lt;b a=&quot;1&quot;&gt;&amp;");
  EXPECT_EQ(html_escaped(std::string_view("a\0b\x1b", 4)), "a\\u0000b\\u001b");
  EXPECT_EQ(html_escaped("zwölf\n"), "zwölf\n");
}

TEST(Html, ShowsNumbersAsPeopleReadThem) {
  EXPECT_EQ(shown_number(2.75), "2.75");
  EXPECT_EQ(shown_number(1.0 / 32), "0.03125");
  EXPECT_EQ(shown_number(-380000.4), "-380000");
  EXPECT_EQ(shown_number(1234.4), "1234");
  EXPECT_EQ(shown_number(-0.0), "0");
  EXPECT_EQ(shown_number(1.5e9), "1.5e+09");
}

TEST(Html, APageIsWellFormedAndAsksNoServer) {
  HtmlPage page;
  page.heading(2, "A < B");
  page.paragraph("5 > 4 & \"so on\"");
  page.begin_chapter();
  page.heading(3, "Inner", false);
  page.facts("Facts", {{"a<", "b&"}});
  page.table({.caption = "Table \"1\"", .columns = {{"x<"}, {"n", true}}, .rows = {{"&", "1"}}});
  Svg svg(84, 20, "title & co", "what it shows");
  svg.text({1, 5}, "a < b", {});
  page.picture("<?xml version=\"1.0\"?>\n" + svg.finish(), "Figure <1>");
  page.verbatim("Text:", "--x 1 <&>");
  page.end_chapter();
  const std::string text = page.finish("T & U", "All <of> it");
  EXPECT_EQ(xml_trouble(text), "");
  EXPECT_THAT(text, HasSubstr("<title>T &amp; U</title>"));
  EXPECT_THAT(text, HasSubstr("<a href=\"#p1\">A &lt; B</a>"));
  EXPECT_THAT(text, HasSubstr("<h2 id=\"p1\">"));
  EXPECT_THAT(text, HasSubstr("<th scope=\"row\">&amp;</th><td class=\"n\">1</td>"));
  EXPECT_THAT(text, Not(HasSubstr("<?xml")));
  EXPECT_THAT(text, Not(HasSubstr(">Inner</a>")));
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
}

TEST(Html, WhatIsEmptyIsLeftOut) {
  HtmlPage page;
  page.facts("No facts", {});
  page.table({.caption = "No rows", .columns = {{"x"}}});
  const std::string text = page.finish("T", "S");
  EXPECT_THAT(text, Not(HasSubstr("No facts")));
  EXPECT_THAT(text, Not(HasSubstr("No rows")));
  EXPECT_EQ(xml_trouble(text), "");
}

}  // namespace
}  // namespace swarmsmith
