#include "irace_core/files/foreign_space.h"

#include "irace_core/files/command_line_text.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

Expected<ForeignSpace> pcs(std::string text, ForeignSpaceOptions options = {}) {
  return parse_pcs_file({std::move(text), "p.pcs"}, options);
}
Expected<ForeignSpace> json(std::string text) {
  return parse_config_space({std::move(text), "s.json"}, {});
}
/// The converted file, or the error.
std::string text_of(const Expected<ForeignSpace>& read) {
  return read ? read->text : to_string(read.error());
}
std::string defaults_of(const Expected<ForeignSpace>& read) {
  if (!read) return to_string(read.error());
  return read->initial ? command_line_text(read->space, *read->initial) : "none";
}

constexpr auto kOld = R"(# SMAC's older format
algorithm {as, mmas, acs}[as] # what it does
sp-rho [0.00001, 1] [0.5]l
ants [5, 100] [10]i
nn [1,50][20]il
Conditionals:
nn | algorithm in {as, acs}
sp-rho | ants in {5, 6} && algorithm in {as}
Forbidden:
{algorithm=mmas, ants=5}
)";

TEST(PcsFile, ReadsTheOlderFormat) {
  const auto read = pcs(kOld);
  EXPECT_EQ(text_of(read),
            "algorithm \"-algorithm \" c (as, mmas, acs)\n"
            "sp_rho \"-sp-rho \" r,log (1e-05, 1) | ants %in% c(5, 6) & algorithm %in% c(\"as\")\n"
            "ants \"-ants \" i (5, 100)\n"
            "nn \"-nn \" i,log (1, 50) | algorithm %in% c(\"as\", \"acs\")\n"
            "\n[forbidden]\nalgorithm == \"mmas\" & ants == 5\n\n[global]\ndigits = 7\n");
  EXPECT_EQ(defaults_of(read), "-algorithm as -ants 10 -nn 20");
  ASSERT_EQ(read->warnings.size(), 1U);
  EXPECT_THAT(read->warnings.front(), HasSubstr("p.pcs:3:1: 'sp-rho' is called 'sp_rho'"));
}

TEST(PcsFile, ReadsTheNewerFormat) {
  const auto read =
      pcs("size ordinal {small, middle, large} [middle]\n"
          "a categorical {x,y} [x]\n"
          "n integer [1, 100] [5] log # comment\n"
          "r real [-1.5, 2] [0.25]\n"
          "n | size > small && a != y\n"
          "r | a == x || n < 7\n"
          "r | size == large\n"
          "{size in {small, large}, a == y}\n");
  EXPECT_EQ(text_of(read),
            "size \"-size \" o (small, middle, large)\n"
            "a \"-a \" c (x, y)\n"
            "n \"-n \" i,log (1, 100) | size %in% c(\"middle\", \"large\") & a != \"y\"\n"
            "r \"-r \" r (-1.5, 2) | (a == \"x\" | n < 7) & size == \"large\"\n"
            "\n[forbidden]\nsize %in% c(\"small\", \"large\") & a == \"y\"\n"
            "\n[global]\ndigits = 4\n");
  EXPECT_EQ(defaults_of(read), "-size middle -a x -n 5");
}

TEST(PcsFile, SwitchesForAclibAndDigitsAreAsAsked) {
  const auto read = pcs("r [0, 1] [0.5]\n", {.aclib = true, .digits = 2});
  EXPECT_EQ(text_of(read), "r \"r\" r (0, 1)\n\n[global]\ndigits = 2\n");
}

TEST(PcsFile, ManyNamesThatIraceCannotHaveAreOneWarning) {
  std::string text;
  for (int i = 0; i < 500; ++i)
    text += "a-" + std::to_string(i) + " {x, y}[x]\n";
  const auto read = value_of(pcs(text));
  ASSERT_EQ(read.warnings.size(), 4U);
  EXPECT_THAT(read.warnings[2], HasSubstr("p.pcs:3:1: 'a-2' is called 'a_2'"));
  EXPECT_EQ(read.warnings[3],
            "p.pcs: 497 more names are changed like this; --check prints them all");
}

TEST(ConfigSpace, NullIsAValueAsPythonWritesIt) {
  const auto read = json(R"({"hyperparameters": [
    {"name": "w", "type": "categorical", "choices": [null, "balanced"], "default_value": null},
    {"name": "r", "type": "uniform_float", "lower": 0, "upper": 1, "default": 0.5}],
    "conditions": [{"child": "r", "parent": "w", "type": "EQ", "value": null}]})");
  EXPECT_EQ(text_of(read),
            "w \"--w \" c (None, balanced)\nr \"--r \" r (0, 1) | w == \"None\"\n"
            "\n[global]\ndigits = 4\n");
  EXPECT_EQ(defaults_of(read), "--w None --r 0.5");
}

TEST(PcsFile, SaysWhatItCannotRead) {
  const auto error = [](std::string text) {
    return text_of(pcs("a {x, y}[x]\nn [1,9][5]i\n" + std::move(text)));
  };
  EXPECT_EQ(text_of(pcs("# nothing\n")), "p.pcs: the file has no parameter");
  EXPECT_THAT(error("b {x, y}\n"), HasSubstr("p.pcs:3:9: expected [...]"));
  EXPECT_THAT(error("b {x, y}[z]\n"), HasSubstr("p.pcs:3:1: 'z' is not a value of 'b': x, y"));
  EXPECT_THAT(error("b [1,2][3]\n"), HasSubstr("the default 3 of 'b' is not from 1 to 2"));
  EXPECT_THAT(error("b [1,2,3][1]\n"), HasSubstr("p.pcs:3:3: expected two numbers"));
  EXPECT_THAT(error("b [1,2][1]x\n"), HasSubstr("expected i, l, il, log or the end"));
  EXPECT_THAT(error("b normal [1,2][1]\n"), HasSubstr("categorical, ordinal, integer"));
  EXPECT_THAT(error("a {x, y}[x]\n"), HasSubstr("there is a parameter 'a' above already"));
  EXPECT_THAT(error("n | a in {z}\n"), HasSubstr("p.pcs:3:5: 'z' is not a value of 'a'"));
  EXPECT_THAT(error("n | a < y\n"), HasSubstr("have no order"));
  EXPECT_THAT(error("n | b == y\n"), HasSubstr("there is no parameter 'b'"));
  EXPECT_THAT(error("b | a == y\n"), HasSubstr("there is no parameter 'b'"));
  EXPECT_THAT(error("n | a\n"), HasSubstr("expected `name in {a, b}`"));
  EXPECT_THAT(error("n | a == x && a == y || a == x\n"), HasSubstr("both && and ||"));
  EXPECT_THAT(error("{n * 2 > 4}\n"), HasSubstr("p.pcs:3: formulas in forbidden lines"));
  EXPECT_THAT(error("{a=x\n"), HasSubstr("expected {name=value"));
  EXPECT_THAT(text_of(pcs("a-b {x}[x]\na_b {x}[x]\n")), HasSubstr("rename one"));
  EXPECT_THAT(text_of(pcs("b [0,1][0]l\n")), HasSubstr("p.pcs:1:1: parameter 'b': a logarithmic"));
}

constexpr auto kJson = R"({
  "name": "svm",
  "hyperparameters": [
    {"name": "C", "type": "uniform_float", "log": true, "lower": 0.01, "upper": 100, "default": 1.0},
    {"name": "svm:kernel", "type": "categorical", "choices": ["rbf", "poly"], "default": "rbf",
     "weights": [0.7, 0.3]},
    {"name": "degree", "type": "uniform_int", "lower": 2, "upper": 5, "default_value": 3, "log": false},
    {"name": "shrink", "type": "categorical", "choices": [true, false], "default": true},
    {"name": "tol", "type": "ordinal", "sequence": [0.001, 0.01, 0.1], "default": 0.01},
    {"name": "iter", "type": "constant", "value": -1},
    {"name": "low", "type": "uniform_int", "lower": 1, "upper": 9, "default": 1, "q": null}
  ],
  "conditions": [
    {"child": "degree", "type": "AND", "conditions": [
      {"child": "degree", "parent": "svm:kernel", "type": "EQ", "value": "poly"},
      {"child": "degree", "type": "OR", "conditions": [
        {"child": "degree", "parent": "C", "type": "GT", "value": 0.5},
        {"child": "degree", "parent": "tol", "type": "LT", "value": 0.1}]}]},
    {"child": "shrink", "parent": "svm:kernel", "type": "IN", "values": ["rbf", "poly"]},
    {"child": "low", "parent": "shrink", "type": "NEQ", "value": false}
  ],
  "forbiddens": [
    {"type": "AND", "clauses": [{"name": "shrink", "type": "EQUALS", "value": false},
                                {"name": "tol", "type": "IN", "values": [0.001, 0.1]}]},
    {"type": "RELATION", "left": "degree", "right": "low", "lambda": "LESS"}
  ]
})";

TEST(ConfigSpace, ReadsItsJson) {
  const auto read = json(kJson);
  EXPECT_EQ(text_of(read),
            "C \"--C \" r,log (0.01, 100)\n"
            "svm_kernel \"--svm:kernel \" c (rbf, poly)\n"
            "degree \"--degree \" i (2, 5) | svm_kernel == \"poly\" & (C > 0.5 | tol %in% "
            "c(\"0.001\", \"0.01\"))\n"
            "shrink \"--shrink \" c (True, False) | svm_kernel %in% c(\"rbf\", \"poly\")\n"
            "tol \"--tol \" o (0.001, 0.01, 0.1)\n"
            "iter \"--iter \" c (-1)\n"
            "low \"--low \" i (1, 9) | shrink != \"False\"\n"
            "\n[forbidden]\nshrink == \"False\" & tol %in% c(\"0.001\", \"0.1\")\n"
            "degree < low\n\n[global]\ndigits = 4\n");
  EXPECT_EQ(defaults_of(read), "--C 1 --svm:kernel rbf --shrink True --tol 0.01 --iter -1 --low 1");
  EXPECT_EQ(read->warnings.size(), 2U);
}

TEST(ConfigSpace, SaysWhatItCannotRead) {
  const auto one = [](const std::string& parameter, const std::string& more = "") {
    return text_of(json(R"({"hyperparameters": [)" + parameter + "]" + more + "}"));
  };
  EXPECT_THAT(text_of(json("{")), HasSubstr("s.json: this is not JSON"));
  EXPECT_THAT(text_of(json("[]")), HasSubstr("an object with \"hyperparameters\""));
  EXPECT_THAT(one("1"), HasSubstr("s.json: hyperparameters[0]: expected an object"));
  EXPECT_THAT(one(R"({"type": "constant"})"), HasSubstr("expected a member \"name\""));
  EXPECT_THAT(one(R"({"name": "a", "type": "normal_float", "mu": 1})"),
              HasSubstr("hyperparameters[0]: the type \"normal_float\" does not exist in irace"));
  const std::string a = R"({"name": "a", "type": "uniform_int", "lower": 1, "upper": 9)";
  EXPECT_THAT(one(a + R"(, "q": 2})"), HasSubstr("steps (\"q\")"));
  EXPECT_THAT(one(a + R"(, "default": 10})"), HasSubstr("is not from 1 to 9"));
  EXPECT_THAT(one(a + R"(, "default": [1]})"), HasSubstr("hyperparameters[0].default: expected"));
  EXPECT_THAT(
      one(a + "}", R"(, "conditions": [{"child": "b", "parent": "a", "type": "EQ", "value": 1}])"),
      HasSubstr("conditions[0]: there is no parameter 'b'"));
  EXPECT_THAT(
      one(a + "}", R"(, "conditions": [{"child": "a", "parent": "a", "type": "XX", "value": 1}])"),
      HasSubstr("found \"XX\""));
  EXPECT_THAT(one(a + "}", R"(, "forbiddens": [{"name": "a", "type": "IN"}])"),
              HasSubstr("forbiddens[0]: expected a list \"values\""));
  EXPECT_EQ(defaults_of(json(R"({"hyperparameters": [)" + a + "}]}")), "none");
}

TEST(SpaceFormat, IsSeenInTheFile) {
  const auto format = [](std::string text, std::string file = "parameters.txt") {
    return space_format_of({std::move(text), std::move(file)});
  };
  EXPECT_EQ(format("# c\n\na \"-a \" c (x,y)\n"), SpaceFormat::Irace);
  EXPECT_EQ(format("a \"\" c ({x},[y])\n"), SpaceFormat::Irace);
  EXPECT_EQ(format("[global]\ndigits=4\n"), SpaceFormat::Irace);
  EXPECT_EQ(format(""), SpaceFormat::Irace);
  EXPECT_EQ(format("# c\na {x,y}[x]\n"), SpaceFormat::Pcs);
  EXPECT_EQ(format("a[1,2][1]\n"), SpaceFormat::Pcs);
  EXPECT_EQ(format("a real [1,2] [1]\n"), SpaceFormat::Pcs);
  EXPECT_EQ(format("", "a.pcs"), SpaceFormat::Pcs);
  EXPECT_EQ(format("{\n\"hyperparameters\": []}"), SpaceFormat::ConfigSpace);
  EXPECT_EQ(format("", "a.json"), SpaceFormat::ConfigSpace);
}

}  // namespace
}  // namespace swarmsmith
