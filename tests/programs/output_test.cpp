#include "programs/output.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <map>

#include "base/rng.h"
#include "programs/number.h"
#include "programs/words.h"

namespace swarmsmith {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What as.numeric of R 4.2 gives for each text; nothing where it gives NA for what is not a
/// number.
TEST(Number, IsReadAsRReadsIt) {
  const std::map<std::string, double> read = {{"1e-3", 0.001},
                                              {"Inf", kInf},
                                              {"inf", kInf},
                                              {"-inf", -kInf},
                                              {"+Inf", kInf},
                                              {"INF", kInf},
                                              {"infinity", kInf},
                                              {"Infinity", kInf},
                                              {"NaN", kNaN},
                                              {"nan", kNaN},
                                              {"-NaN", kNaN},
                                              {"NA", kNaN},
                                              {"-NA", kNaN},
                                              {"0x1A", 26},
                                              {"0X1a", 26},
                                              {"0x1p3", 8},
                                              {"0x1.8p1", 3},
                                              {"1e", 1},
                                              {"1e+", 1},
                                              {"1E5", 1e5},
                                              {".5", 0.5},
                                              {"5.", 5},
                                              {"+5", 5},
                                              {"1e400", kInf},
                                              {"1e-400", 0},
                                              {"-0", -0.0},
                                              {"+0x10", 16},
                                              {"-0x1p-2", -0.25},
                                              {"0x1p", 1},
                                              {"0.1", 0.1},
                                              {"123456789", 123456789}};
  for (const auto& [text, value] : read) {
    const auto number = parse_number(text);
    ASSERT_TRUE(number) << text;
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(*number)) << text;
    } else {
      EXPECT_EQ(*number, value) << text;
    }
  }
  for (const char* text :
       {"1d3",  "1D3", "1L", "--5",  "1_0", "1,5", "0x", "TRUE", "1e5L",    "infi",
        "Infx", ".",   "-",  "0x1g", "e5",  "",    "+",  "0x.",  "0x1.2.3", "1e3x"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

Target plain() {
  return {};
}
Target with_evaluator() {
  Target target;
  target.evaluator = "/e";
  return target;
}
Target with_time() {
  Target target;
  target.prints_time = true;
  return target;
}

std::string fault(std::string_view output, const Target& target, double bound = 0) {
  const auto reading = parse_runner_output(output, target, bound);
  return reading ? "" : reading.error().message;
}
bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Output, IsACostOrACostAndATime) {
  EXPECT_EQ(parse_runner_output("3.5\n", plain()), (Reading{3.5, 0}));
  EXPECT_EQ(parse_runner_output("  3.5 \r\n\n 7 \n", plain()), (Reading{3.5, 7}));
  EXPECT_EQ(parse_runner_output("Inf", plain())->cost, kInf);
  EXPECT_EQ(parse_runner_output("-inf", plain())->cost, -kInf);
  EXPECT_EQ(parse_runner_output("3 4", with_time()), (Reading{3, 4}));
}

TEST(Output, RaisesATimeToWhatCanBeMeasured) {
  EXPECT_EQ(parse_runner_output("1 0.0001", plain())->time, 0.01);
}

TEST(Output, IsNothingOrATimeBeforeAnEvaluator) {
  EXPECT_EQ(parse_runner_output("", with_evaluator()), (Reading{0, 0}));
  EXPECT_EQ(parse_runner_output("2.5", with_evaluator()), (Reading{0, 2.5}));
  EXPECT_TRUE(mentions(fault("1 2", with_evaluator()), "more than it should"));
  Target both = with_evaluator();
  both.prints_time = true;
  EXPECT_TRUE(mentions(fault("", both), "one number, the time"));
}

TEST(Output, SaysWhatIsWrongWithIt) {
  EXPECT_TRUE(mentions(fault("", plain()), "printed nothing"));
  EXPECT_TRUE(mentions(fault(" \n\t", plain()), "printed nothing"));
  EXPECT_TRUE(mentions(fault("1 2 3", plain()), "more than it should"));
  EXPECT_TRUE(mentions(fault("1", with_time()), "less than it should"));
  EXPECT_TRUE(mentions(fault("cost: 5", plain()), "not a number, `cost:`"));
  EXPECT_TRUE(mentions(fault("NaN", plain()), "is NaN"));
  EXPECT_TRUE(mentions(fault("NA", plain()), "is NA"));
  EXPECT_TRUE(mentions(fault("-1e305", plain()), "-1e305, is beyond 1e300"));
  EXPECT_TRUE(mentions(fault("1 0", plain()), "above 0"));
  EXPECT_TRUE(mentions(fault("1 -2", plain()), "above 0"));
  EXPECT_TRUE(mentions(fault("1 Inf", plain()), "infinite"));
  EXPECT_TRUE(mentions(fault("1 NaN", plain()), "is NaN"));
  EXPECT_TRUE(mentions(fault(std::string_view("1\0 2", 4), plain()), "`1\\u0000`"));
  std::string endless(5000, '9');
  endless.push_back('x');
  EXPECT_TRUE(mentions(fault(endless, plain()), "...`"));
}

TEST(Output, MayNotOverrunItsBound) {
  EXPECT_EQ(fault("1 5.01", plain(), 5), "");
  EXPECT_TRUE(mentions(fault("1 5.1", plain(), 5), "had to stop at 5"));
}

TEST(Output, OfAnEvaluatorIsACost) {
  EXPECT_EQ(parse_evaluator_output("3\n", with_evaluator()), (Reading{3, 0}));
  EXPECT_FALSE(parse_evaluator_output("3 4", with_evaluator()));
  EXPECT_FALSE(parse_evaluator_output("", with_evaluator()));
  EXPECT_FALSE(parse_evaluator_output("NaN", with_evaluator()));
  Target batch = with_evaluator();
  batch.batch_mode = BatchMode::Slurm;
  EXPECT_EQ(parse_evaluator_output("3 4", batch), (Reading{3, 4}));
}

TEST(Aclib, ReadsTheResultLine) {
  Target target;
  target.aclib = true;
  const auto read = [&](const std::string& json) {
    return parse_runner_output("noise\nI: Result of this algorithm run: " + json + "\nmore\n",
                               target);
  };
  EXPECT_EQ(read(R"({"status": "SUCCESS", "cost": 1.5, "runtime": 2.5, "misc": ""})"),
            (Reading{1.5, 2.5}));
  EXPECT_EQ(read(R"({"status": "TIMEOUT", "cost": "1.5", "runtime": 2.5})"), (Reading{1.5, 2.5}));
  EXPECT_EQ(read(R"({"status": "SUCCESS", "cost": 1.5})"), (Reading{1.5, 0}));
  EXPECT_TRUE(mentions(read(R"({"status": "CRASHED", "cost": 1})").error().message, "CRASHED"));
  EXPECT_TRUE(mentions(read(R"({"status": "ABORT", "cost": 1})").error().message, "ABORT"));
  EXPECT_TRUE(mentions(read(R"({"status": "SUCCESS"})").error().message, "`cost`"));
  EXPECT_TRUE(mentions(read("{").error().message, "not a JSON object"));
  EXPECT_TRUE(mentions(read("[1]").error().message, "not a JSON object"));
  EXPECT_TRUE(mentions(fault("hello", target), "no line"));
  target.prints_time = true;
  EXPECT_FALSE(read(R"({"status": "SUCCESS", "cost": 1.5})"));
}

/// Whatever a program prints, it is read or refused; what is read is fit for a race.
TEST(Output, MayBeAnything) {
  constexpr std::string_view kPieces[] = {
      "1",          " ",           "\n",   "-",   "Inf", "NaN",  "0x",
      "p",          "e",           ".",    "NA",  "{",   "}",    "\"",
      ":",          "\xff",        "\xc3", "1e9", "\t",  "cost", "Result of this algorithm run:",
      "\"status\"", "\"SUCCESS\"", ",",    "'",   "\\",  "$"};
  Rng rng(3);
  Target aclib;
  aclib.aclib = true;
  for (int round = 0; round < 20'000; ++round) {
    std::string text;
    for (std::int64_t i = rng.uniform_int(0, 9); i > 0; --i) {
      text += kPieces[static_cast<std::size_t>(
          rng.uniform_int(0, static_cast<std::int64_t>(std::size(kPieces)) - 1))];
    }
    for (const Target& target : {plain(), with_time(), with_evaluator(), aclib}) {
      const auto reading = parse_runner_output(text, target, 2);
      if (!reading) continue;
      ASSERT_FALSE(std::isnan(reading->cost)) << text;
      ASSERT_TRUE(reading->time == 0 || (reading->time >= 0.01 && reading->time <= 2.01)) << text;
    }
    const std::string shown = printable(text, 12);
    ASSERT_LE(shown.size(), 12U) << text;
    ASSERT_EQ(printable(shown, 100), shown) << text;
    if (const auto split = split_words(text); split && !split->needs_shell) {
      std::string again;
      for (const std::string& word : split->words)
        again += shell_quoted(word) + " ";
      ASSERT_EQ(split_words(again)->words, split->words) << text;
    }
  }
}

TEST(JobId, IsOneWord) {
  EXPECT_EQ(parse_job_id("4711\n"), "4711");
  EXPECT_EQ(parse_job_id("17.server_0[3]"), "17.server_0[3]");
  for (const char* text : {"", "Submitted batch job 5", "-j", "5;rm", "$(x)"})
    EXPECT_FALSE(parse_job_id(text)) << text;
}

TEST(Printable, KeepsTextAndTheEndOfIt) {
  EXPECT_EQ(printable("a\tb\n", 100), "a\tb\n");
  EXPECT_EQ(printable(std::string_view("a\0\x1b[\xff", 5), 100), "a\\u0000\\u001b[\\xff");
  EXPECT_EQ(printable("gr\xc3\xbc\xc3\x9f", 100), "gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(printable("\xc3", 100), "\\xc3");
  EXPECT_EQ(printable("\xed\xa0\x80", 100), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("0123456789abc", 10), "...6789abc");
  EXPECT_EQ(printable("0123456789\xc3\xbc"
                      "bcdefg",
                      10),
            "...bcdefg");
}

}  // namespace
}  // namespace swarmsmith
