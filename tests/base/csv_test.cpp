#include "base/csv.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace swarmsmith
