#include "irace_core/files/parameter_file.h"

#include "irace_core/files/expression_text.h"
#include "tests/irace_core/files/random_spaces.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

Expected<ParameterFile> read(std::string text) {
  return parse_parameter_file({.parameters = {std::move(text), "p.txt"}});
}
std::string error_of(std::string text) {
  const auto file = read(std::move(text));
  return file ? "none" : to_string(file.error());
}
std::vector<std::string> values_of(const std::string& domain) {
  const auto file = read("n \"\" i (1,9)\na \"-a\" c " + domain);
  if (!file) return {to_string(file.error())};
  return std::get<Categorical>(file->space[1].domain).values;
}
std::vector<std::string> warnings_of(const std::string& domain) {
  return read("n \"\" i (1,9)\na \"-a\" c " + domain)->warnings;
}

void expect_same(const ParameterSpace& a, const ParameterSpace& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(a[i] == b[i]) << *print_parameter_file(a) << *print_parameter_file(b);
  EXPECT_TRUE(std::ranges::equal(a.forbidden(), b.forbidden()));
  EXPECT_EQ(a.digits(), b.digits());
}

TEST(ParameterFile, ReadsValuesAsRDoes) {
  EXPECT_THAT(values_of("('x y', 'z')"), ElementsAre("'x y'", "'z'"));
  EXPECT_THAT(values_of("('x, y', z)"), ElementsAre("'x", "y'", "z"));
  EXPECT_THAT(values_of("(\"x, z)"), ElementsAre("\"x", "z"));
  EXPECT_THAT(values_of("(x\"y, z)"), ElementsAre("x\"y", "z"));
  EXPECT_THAT(values_of("(x(1), y) z)"), ElementsAre("x(1)", "y) z"));
  EXPECT_THAT(values_of("( \"x\" , \"y\" )"), ElementsAre("x", "y"));
  EXPECT_THAT(values_of("(\"\", \"a b\", \"a,b\")"), ElementsAre("", "a b", "a,b"));
  EXPECT_THAT(values_of("(one two, three ) # (and four)"), ElementsAre("one two", "three"));
  EXPECT_THAT(values_of("(\"x, z) # say \"hello\""), ElementsAre("\"x", "z"));
}

TEST(ParameterFile, MendsWhatIsADefectInR) {
  EXPECT_THAT(values_of("(\"a#b\", \"c|d\") # a comment"), ElementsAre("a#b", "c|d"));
  EXPECT_THAT(values_of("(x , y )"), ElementsAre("x", "y"));
  EXPECT_THAT(warnings_of("(x , y )"),
              ElementsAre("p.txt:2:11: the blanks after the value 'x' are left out; R would keep "
                          "them"));
  EXPECT_THAT(values_of("(,x,)"), ElementsAre("x"));
  EXPECT_EQ(warnings_of("(,x,)").size(), 2U);
  EXPECT_THAT(values_of("(\"x\"y, z)").front(), HasSubstr("after the closing quote"));
  const auto file =
      value_of(read("a \"--a#1 \" c (x,y) | b == 'p#q' # comment\nb \"\" c (\"p#q\", r)\n"));
  EXPECT_EQ(file.space[0].switch_text, "--a#1 ");
  EXPECT_EQ(print(*file.space[0].condition), "b == \"p#q\"");
}

TEST(ParameterFile, ConditionsOfIrace35MayHaveDoubledOperators) {
  const auto file = value_of(read("a \"\" i (1,9)\nb \"\" c (x,y) | a > 2 && a < 5 || a == 9"));
  EXPECT_EQ(print(*file.space[1].condition), "a > 2 & a < 5 | a == 9");
  EXPECT_THAT(file.warnings,
              ElementsAre("p.txt:2:31: '||' is read as '|'", "p.txt:2:22: '&&' is read as '&'"));
}

TEST(ParameterFile, BoundsMayHoldCommas) {
  const auto file =
      value_of(read("ants \"\" i (5,100)\nrank \"\" i (1, min(ants, 10))\n"
                    "other \"\" i ('1', \"min(ants, 10)\")"));
  EXPECT_EQ(file.space[1].domain, file.space[2].domain);
}

TEST(ParameterFile, SaysWhereAndWhat) {
  EXPECT_EQ(error_of("\n\n  a \"\" c x"),
            "p.txt:3:10: expected the domain in parentheses, found \"x\"");
  EXPECT_EQ(error_of("a \"\" c (x # y)"),
            "p.txt:1:8: expected the domain in parentheses, closed before any '|' and '#', found "
            "\"(x # y)\"");
  EXPECT_EQ(error_of("a \"\" i (1, 5, )").substr(0, 14), "p.txt:1:15: fo");
  EXPECT_EQ(error_of("a \"\" i (1, \"b +\")\nb \"\" i (1,2)"),
            "p.txt:1:16: found the end, expected a value, a name or '('");
  EXPECT_EQ(error_of("a \"\" i (1, exp(b))\nb \"\" i (1,2)"),
            "p.txt:1:1: parameter 'a', domain (1, exp(b)): a bound may use + - * / %% min max "
            "round floor ceiling trunc");
  EXPECT_EQ(error_of("a \"\" i (1, 1:5)"),
            "p.txt:1:1: parameter 'a', domain (1, 1:5): a bound may use + - * / %% min max round "
            "floor ceiling trunc");
  EXPECT_EQ(error_of("a \"\" i (1,2)\n[forbiden]\n"),
            "p.txt:2:1: expected [forbidden] or [global], found \"[forbiden]\"");
  EXPECT_EQ(error_of("[global]\ndigits = 2\na \"\" i (1,2)").substr(0, 38),
            "p.txt:3:1: expected an option of [glob");
  EXPECT_EQ(error_of("x \"\" r (0, 1)\nn \"\" i (1, 2) | z > 1\nz \"\" i (1,n)\n"),
            "p.txt:3:1: parameter 'z', domain (1,n): depends on itself, by its condition or "
            "domain or through other parameters");
}

TEST(ParameterFile, DigitsFromOutsideRoundBoundsAsIrace35Does) {
  const ParameterSources sources{.parameters = {"a \"\" r (0.126, 1)\n", "p.txt"},
                                 .forbidden = {},
                                 .dependency = {},
                                 .digits = 2};
  const auto file = value_of(parse_parameter_file(sources));
  EXPECT_EQ(std::get<double>(std::get<Real>(file.space[0].domain).lower), 0.13);
  EXPECT_EQ(file.space.digits(), 2);
  EXPECT_THAT(file.warnings, ElementsAre("p.txt:1:9: the bound 0.126 of 'a' is rounded to 0.13, "
                                         "for digits = 2"));
}

TEST(ParameterFile, NamesMayHaveLettersOfAnyLanguage) {
  const auto file = value_of(parse_parameter_file(
      {.parameters = {"gr\u00f6\u00dfe \"--g \" i (1,9)\nb \"\" r (0,1) | gr\u00f6\u00dfe > 3\n"
                      "[forbidden]\ngr\u00f6\u00dfe == 5\n",
                      "p.txt"}}));
  EXPECT_EQ(file.space[0].name, "gr\u00f6\u00dfe");
  EXPECT_EQ(file.space.forbidden().size(), 1U);
  EXPECT_THAT(error_of("a\u00a0\"--a \" i (1,9)\n"), HasSubstr("p.txt:1:1"));
}

TEST(ParameterFile, AForbiddenLineIsNoValueAlone) {
  for (const char* line : {"TRUE", "0", "\"a\"", "NA", "a", "a + 1", "max(a, 1)"}) {
    EXPECT_THAT(error_of("a \"\" i (1,2)\n[forbidden]\n" + std::string(line)),
                HasSubstr("p.txt:3:1: a value alone forbids everything or nothing"));
  }
}

TEST(ParameterFile, ReadsTheForbiddenFileOfIrace35) {
  ParameterSources sources{.parameters = {"a \"\" i (1,5)\nb \"\" c (x,y)", "p.txt"},
                           .forbidden = IraceText{"# none\n\n (a > 3) && b == \"x\" # why\nb %in% "
                                                  "c('y')\n",
                                                  "f.txt"},
                           .dependency = {},
                           .digits = {}};
  const auto file = value_of(parse_parameter_file(sources));
  ASSERT_EQ(file.space.forbidden().size(), 2U);
  EXPECT_EQ(print(file.space.forbidden()[0]), "a > 3 & b == \"x\"");
  EXPECT_THAT(file.warnings, ElementsAre("f.txt:3:10: '&&' is read as '&'"));
  sources.forbidden->text = "a == 1\nzz == 1\n";
  EXPECT_THAT(to_string(parse_parameter_file(sources).error()),
              HasSubstr("f.txt:2:1: there is no parameter 'zz'"));
}

/// The form of the files in AutoMoDe's public repositories: their generators write these lines.
std::string automode_parameters() {
  std::string text = "NumStates   \"--nstates \"   i (1,4)\n";
  for (const std::string i : {"0", "1", "2", "3"}) {
    text += "S" + i + "     \"--s" + i + " \"  c   (0,1,2,3) | as.numeric(NumStates)>" + i + " \n" +
            "RWM" + i + "   \"--rwm" + i + " \"  i (1,100) | as.numeric(S" + i + ")==0\n" + "ATT" +
            i + "   \"--att" + i + " \"  r (1,5) | as.numeric(S" + i + ")==2\n" + "REP" + i +
            "   \"--rep" + i + " \"  r (1,5) | as.numeric(S" + i + ")==3\n" + "NumConnections" + i +
            " \"--n" + i + " \" i (1,4) | as.numeric(NumStates)>" + (i == "0" ? "1" : i) + "\n";
    for (const std::string j : {"0", "1", "2", "3"}) {
      const std::string ij = i + "x" + j;
      const auto line = [&](const std::string& name, const std::string& letter,
                            const std::string& domain, const std::string& condition) {
        text += name + ij + "  \"--" + letter + ij + " \" " + domain + " | " + condition + " \n";
      };
      const std::string connected = "as.numeric(NumConnections" + i + ")>" + j;
      line("N", "n", "i   (0,3)", connected);
      line("C", "c", "c   (0,1,2,3,4,5,6)", connected);
      line("P", "p", "r   (0,1)", "as.numeric(C" + ij + ") %in% c(0,1,2,5,6)");
      line("B", "p", "i   (1,10)", "as.numeric(C" + ij + ")==3");
      line("W", "w", "r   (0,20)", "as.numeric(C" + ij + ")==3");
      line("BI", "p", "i   (1,10)", "as.numeric(C" + ij + ")==4");
      line("WI", "w", "r   (0,20)", "as.numeric(C" + ij + ")==4");
      line("L", "l", "i   (0,3)", "as.numeric(C" + ij + ")==6");
    }
  }
  return text;
}

std::string automode_dependencies() {
  std::string text;
  for (const char i : {'0', '1', '2', '3'}) {
    for (const char j : {'0', '1', '2', '3'})
      text += std::string("N") + i + "x" + j + " (|NumStates-2)\n";
  }
  return text;
}

TEST(ParameterFile, ReadsAutoMoDesParametersAndItsDependencyFile) {
  ParameterSources sources{.parameters = {automode_parameters(), "grammar.txt"},
                           .forbidden = {},
                           .dependency = IraceText{automode_dependencies(), "depend.txt"},
                           .digits = 2};
  const auto file = value_of(parse_parameter_file(sources));
  const ParameterSpace& space = file.space;
  EXPECT_EQ(space.size(), 149U);
  EXPECT_TRUE(file.warnings.empty());
  const Domain& n = space[*space.index_of("N2x3")].domain;
  EXPECT_EQ(std::get<double>(std::get<Integer>(n).lower), 0);
  EXPECT_EQ(print(std::get<Expression>(std::get<Integer>(n).upper)), "NumStates - 2");

  // Two states: the only other state is number 0. One state: no connection, and no empty domain.
  Assignment values(space);
  values.set(*space.index_of("NumStates"), 2);
  EXPECT_EQ(space.interval(*space.index_of("N0x0"), values), (Interval{0, 0}));
  Configuration one(space.size());
  one.set(*space.index_of("NumStates"), 1);
  one.set(*space.index_of("S0"), 1);
  EXPECT_TRUE(space.check(one));
}

TEST(ParameterFile, SaysWhatIsWrongWithADependencyFile) {
  const auto error = [](const std::string& line) {
    const auto file = parse_parameter_file(
        {.parameters = {"Num \"\" i (1,4)\nx \"\" r (0, 1)\nc \"\" c (a, b)", "p.txt"},
         .forbidden = {},
         .dependency = IraceText{"# first\n" + line + "\n", "d.txt"},
         .digits = {}});
    if (file) return print(std::get<Expression>(std::get<Real>(file->space[1].domain).upper));
    return to_string(file.error());
  };
  EXPECT_EQ(error("x ( 0 | Num / 2 ) # half"), "Num / 2");
  EXPECT_EQ(error("x (|\"Num / 2\")"), "Num / 2");
  EXPECT_EQ(error("x (, Num)"),
            "d.txt:2:1: expected a line 'name (lower|upper)', found \"x (, Num)\"");
  EXPECT_EQ(error("X (|Num)"), "d.txt:2:1: there is no parameter 'X' (did you mean \"x\"?)");
  EXPECT_EQ(error("c (|Num)"), "d.txt:2:1: 'c' has no bounds: it is not numeric");
  EXPECT_EQ(error("x (|Nun)"), "d.txt:2:5: there is no parameter 'Nun' (did you mean \"Num\"?)");
}

TEST(ParameterFile, WhatIsPrintedReadsBackAsTheSame) {
  Rng rng(149);
  int odd = 0;
  for (int i = 0; i < 1000; ++i) {
    const ParameterSpace space = testing::random_space(rng);
    const auto text = value_of(print_parameter_file(space));
    const auto again = read(text);
    ASSERT_TRUE(again) << to_string(again.error()) << "\n" << text;
    expect_same(space, again->space);
    EXPECT_TRUE(again->warnings.empty());

    const auto older = value_of(print_irace_35_files(space));
    EXPECT_EQ(older.parameters.find('['), std::string::npos);
    const auto from_older =
        value_of(parse_parameter_file({.parameters = {older.parameters, "p"},
                                       .forbidden = IraceText{older.forbidden, "f"},
                                       .dependency = {},
                                       .digits = older.digits}));
    expect_same(space, from_older.space);
    if (text.find("[forbidden]") != std::string::npos) ++odd;
  }
  EXPECT_GT(odd, 100);
}

TEST(ParameterFile, SaysWhatTheFormatCannotHold) {
  const auto error = [](Parameter parameter) {
    parameter.name = "a";
    std::vector<Parameter> parameters;
    parameters.push_back(std::move(parameter));
    return to_string(print_parameter_file(*ParameterSpace::make(std::move(parameters))).error());
  };
  EXPECT_EQ(error({"", "-\"x\" ", Integer{1.0, 2.0}, {}}),
            "a: irace's parameter files cannot hold the switch '-\"x\" '");
  EXPECT_EQ(error({"", "", Categorical{{"a\",b", "c"}}, {}}),
            "a: irace's parameter files cannot hold the value 'a\",b'");
  EXPECT_EQ(error({"", "", Categorical{{"a\nb", "c"}}, {}}),
            "a: irace's parameter files cannot hold the value 'a\nb'");
}

}  // namespace
}  // namespace swarmsmith
