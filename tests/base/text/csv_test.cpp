#include "base/text/csv.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

TEST(CsvField, IsInQuotesWhenItMustBe) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,\"b\""), "\"a,\"\"b\"\"\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_line({"", "a", "b c", ""}), ",a,b c,\n");
}

TEST(CsvField, IsNoFormula) {
  EXPECT_EQ(csv_field("=1+1"), "'=1+1");
  EXPECT_EQ(csv_field("=HYPERLINK(\"http://x\",\"y\")"),
            "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\"");
  EXPECT_EQ(csv_field("+cmd|' /C calc'!A0"), "'+cmd|' /C calc'!A0");
  EXPECT_EQ(csv_field("-2+3"), "'-2+3");
  EXPECT_EQ(csv_field("-cmd|x"), "'-cmd|x");
  EXPECT_EQ(csv_field("--a(1)"), "'--a(1)");
  EXPECT_EQ(csv_field("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(csv_field("\t=1"), "'\t=1");
  EXPECT_EQ(csv_field("\r=1"), "\"'\r=1\"");
  EXPECT_EQ(csv_field("\n=1"), "\"'\n=1\"");
}

TEST(CsvField, KeepsNumbersAndSwitches) {
  for (const char* text : {"-1.5", "-1e-300", "-0", "-inf", "1e400", "-1e400",
                           "--nstates 1 --s0 0 --rwm0 10", "-a 0.25 --name x_y/z:1,2"}) {
    const std::string field = csv_field(text);
    EXPECT_EQ(field.find('\''), std::string::npos) << field;
  }
}

TEST(CsvField, ComesBack) {
  for (const char* text :
       {"",   "'",   "''",           "a",    "'a",  "=1",   "'=1",      "''=1",
        "-1", "'-1", "'--nstates 1", "-x y", "'",   "it's", "'quoted'", "@",
        "+",  "-",   "\t",           "\n",   "'\r", "--",   "---x",     "--a=b"}) {
    std::string field = csv_field(text);
    if (field.starts_with('"')) field = field.substr(1, field.size() - 2);
    EXPECT_EQ(csv_text(field), text);
  }
}

TEST(CsvTable, ReadsQuotesCommasLineBreaksAndBothLineEnds) {
  const auto table =
      value_of(parse_csv("\xef\xbb\xbf"
                         "a,b\r\n1,\"x, \"\"y\"\"\nz\"\r\n\n2,\n3,\"\"",
                         "t.csv"));
  EXPECT_THAT(table.columns, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_THAT(table.rows[0].cells, ElementsAre("1", "x, \"y\"\nz"));
  EXPECT_THAT(table.rows[1].cells, ElementsAre("2", ""));
  EXPECT_THAT(table.rows[2].cells, ElementsAre("3", ""));
  // The row before it has two lines, and a blank one follows.
  EXPECT_EQ(table.place(table.rows[1]), "t.csv:5");
  EXPECT_EQ(cell_of(table, table.rows[1], "a"), "2");
  EXPECT_EQ(cell_of(table, table.rows[1], "c"), "");
}

TEST(CsvTable, ReadsTextsThatWereKeptFromBeingFormulas) {
  const std::vector<std::string> texts = {"=1+1", "'=1+1", "@x", "-2+3", "-1.5", "it's", "a,\"b\""};
  const auto table =
      value_of(parse_csv(csv_line({"a", "b", "c", "d", "e", "f", "g"}) + csv_line(texts), "t"));
  EXPECT_EQ(table.rows.front().cells, texts);
}

TEST(CsvTable, NamesEveryBadRowByItsLine) {
  const auto table = parse_csv("a,b,a\n1,2,3\n1,2\n1,2,3,4\n", "t.csv");
  ASSERT_FALSE(table);
  ASSERT_EQ(table.error().size(), 3U);
  EXPECT_EQ(to_string(table.error()[0]), "t.csv:1: the column a occurs twice");
  EXPECT_EQ(to_string(table.error()[1]), "t.csv:3: the row has 2 fields, the headline 3");
  EXPECT_EQ(to_string(parse_csv("a,b\n1\n", "t.csv").error().front()),
            "t.csv:2: the row has 1 field, the headline 2");
  EXPECT_EQ(to_string(table.error()[2]), "t.csv:4: the row has 4 fields, the headline 3");
  EXPECT_THAT(to_string(parse_csv("a\n\"1\n2\n", "t.csv").error().front()),
              HasSubstr("t.csv:2: a quote is opened"));
  EXPECT_THAT(to_string(parse_csv(" \n", "t.csv").error().front()), HasSubstr("the file is empty"));
}

TEST(CsvTable, ReadsWholeNumbersOnly) {
  EXPECT_EQ(integer_in("-12"), -12);
  EXPECT_EQ(integer_in("12x"), std::nullopt);
  EXPECT_EQ(integer_in(""), std::nullopt);
  EXPECT_EQ(number_in("2.5e1"), 25);
  EXPECT_EQ(number_in("2,5"), std::nullopt);
  EXPECT_EQ(number_in("nan"), std::nullopt);
}

}  // namespace
}  // namespace swarmsmith
