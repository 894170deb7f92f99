#include "storage/internal/candidate_code.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.h"
#include "storage/answer.h"
#include "storage/internal/schema.h"
#include "storage/internal/sqlite.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// One of them.
std::string any(Rng& rng, const std::vector<std::string>& texts) {
  return texts[rng.below(texts.size())];
}

/// A configuration of a program: choices and numbers as people write them, some switches without a
/// blank, some parameters without a switch.
void configure_program(Rng& rng, CandidateRow& row) {
  row.parameters = "{";
  const std::int64_t count = rng.uniform_int(0, 9);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string number = any(rng, {"0", "7", "12", "-3", "-0", "0.10", "1e-05", "1.5E+9",
                                         "0.30000000000000004", "123456789012345678901", "100.0"});
    const std::string text = any(rng, {"as", "", "a b", "x;y", "--z", "é", "0.10"});
    const std::string quoted = any(rng, {R"("q\"r")", R"("\\")", R"("\u00e9;,}{")", R"("")"});
    std::string value = number, json = number;
    if (rng.bernoulli(0.4)) value = text, json = '"' + text + '"';
    if (rng.bernoulli(0.1)) value = json = quoted;
    if (rng.bernoulli(0.1)) value = json = any(rng, {"true", "null"});
    row.parameters +=
        fmt::format("{}\"{}{}\":{}", i > 0 ? "," : "", any(rng, {"p", "P ", "ä"}), i, json);
    if (i > 0) row.machine += any(rng, {" ", " ", " ", "  ", ""});
    row.machine += any(rng, {"--p ", "-p", "--p=", "", "--p 1 --q "}) + value;
  }
  row.parameters += "}";
}

/// Any bytes where texts are expected, or a good text with a change somewhere.
void spoil(Rng& rng, std::string& text) {
  constexpr std::string_view kBytes("{}\",:;\\ -0a\0\xc3\n[", 16);
  const std::size_t changes = 1 + rng.below(3);
  for (std::size_t i = 0; i < changes; ++i) {
    const std::size_t at = rng.below(text.size() + 1);
    if (rng.bernoulli(0.5)) {
      text.insert(at, 1, kBytes[rng.below(kBytes.size())]);
    } else {
      text.erase(at, 1 + rng.below(4));
    }
  }
}

/// The candidates of a campaign like real ones, with programs' and strange ones among them.
std::vector<CandidateRow> candidates(std::uint64_t seed, double odd) {
  Rng rng(seed);
  std::vector<CandidateRow> rows;
  const SyntheticCampaign campaign = synthetic_campaign({.candidates = 100, .steps = 1}, seed);
  for (const auto& batch : campaign.batches) {
    for (const Row& row : batch) {
      const auto* candidate = std::get_if<CandidateRow>(&row);
      if (candidate == nullptr) continue;
      rows.push_back(*candidate);
      if (!rng.bernoulli(odd)) continue;
      CandidateRow& last = rows.back();
      if (rng.bernoulli(0.5)) {
        last.machine.clear();
        configure_program(rng, last);
      }
      for (std::string* text : {&last.machine, &last.parameters, &last.modules}) {
        if (rng.bernoulli(0.3)) spoil(rng, *text);
        if (rng.bernoulli(0.1)) text->clear();
      }
    }
  }
  return rows;
}

std::vector<CandidateRow> candidates_in(StoreReader& reader) {
  std::vector<CandidateRow> rows;
  reader.each_answer_row([&](const Row& row) {
    if (const auto* candidate = std::get_if<CandidateRow>(&row)) rows.push_back(*candidate);
  });
  return rows;
}

struct CandidateCodeTest : testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "s.db";
  SyntheticCampaign campaign = synthetic_campaign({.candidates = 1, .steps = 1});

  /// In several openings, so that phrases are found again.
  void write(const std::vector<CandidateRow>& rows) {
    const std::size_t part = rows.size() / 3 + 1;
    for (std::size_t begin = 0; begin < rows.size(); begin += part) {
      auto store = open_store(path, campaign);
      for (std::size_t i = begin; i < std::min(rows.size(), begin + part); ++i)
        store->append({Row(rows[i])});
    }
  }
  std::string one(const std::string& sql) { return cells_of(*open_reader(path), sql)[0][0]; }
  void change(const std::string& sql) {
    sqlite::Connection(path.string(), SQLITE_OPEN_READWRITE).execute(sql);
  }
};

TEST_F(CandidateCodeTest, EveryRowComesBackAsItWas) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::filesystem::remove(path);
    const auto rows = candidates(seed, 0.5);
    write(rows);
    const auto reader = open_reader(path);
    const auto read = candidates_in(*reader);
    const auto cells = cells_of(*reader,
                                "SELECT candidate, fsm_config, parameters, modules,"
                                " iteration, coalesce(parent, 0), n_states, n_transitions"
                                " FROM v_candidates ORDER BY candidate");
    ASSERT_EQ(read.size(), rows.size());
    ASSERT_EQ(cells.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_TRUE(same_answer(rows[i], read[i])) << describe(rows[i]) << "\n" << describe(read[i]);
      EXPECT_THAT(cells[i],
                  ElementsAre(std::to_string(rows[i].id.value), rows[i].machine, rows[i].parameters,
                              rows[i].modules, std::to_string(rows[i].iteration),
                              std::to_string(rows[i].parent.value), std::to_string(rows[i].states),
                              std::to_string(rows[i].transitions)));
    }
  }
}

TEST_F(CandidateCodeTest, TextsOfACampaignAreAllCodedAndTakeLessThanAThird) {
  const auto rows = candidates(1, 0);
  write(rows);
  std::size_t size = 0;
  for (const CandidateRow& row : rows)
    size += row.machine.size() + row.parameters.size() + row.modules.size();
  EXPECT_EQ(one("SELECT count(*) FROM candidate WHERE code IS NULL OR module_code IS NULL"
                " OR machine || parameters || modules <> ''"),
            "0");
  EXPECT_LT(std::stoul(one("SELECT sum(length(code) + length(module_code)) FROM candidate")),
            size / 3);
}

TEST_F(CandidateCodeTest, ParametersInLongFormAreThoseOfTheText) {
  write(candidates(2, 0));
  EXPECT_EQ(one("SELECT count(*) FROM (SELECT candidate, parameter, value FROM v_parameters EXCEPT"
                " SELECT c.candidate, j.key, j.value FROM v_candidates AS c,"
                " json_each(c.parameters) AS j)"),
            "0");
  EXPECT_GT(std::stoul(one("SELECT count(*) FROM v_parameters")), 1000U);
}

CandidateRow row_of(const std::string& machine, const std::string& parameters,
                    const std::string& modules) {
  return {
      .id = {1}, .parent = {}, .parameters = parameters, .machine = machine, .modules = modules};
}

/// What is stored: "machine|parameters|modules|code|module code".
std::string text_of(const StoredTexts& texts) {
  return fmt::format("{}|{}|{}|{}|{}", texts.machine, texts.parameters, texts.modules,
                     texts.code.value_or("none"), texts.module_code.value_or("none"));
}

/// The example of candidate_code.h, with modules.
CandidateRow example() {
  return row_of("--s0 0 --rwm0 56 --n0 1 --n0x0 0 --p0x0 0.5",
                R"({"S0":"exploration","RWM0":56,"NumConnections0":1,"N0x0":0,"P0x0":0.5})",
                R"({"a":1,"b":2,"c":3})");
}

TEST(PhraseBook, CutsTextsBehindNumbersAndPairsOfModules) {
  PhraseBook book;
  std::vector<std::string> phrases;
  const StoredTexts stored = book.encode(example(), [&](std::int64_t number, const Phrase& phrase) {
    phrases.push_back(fmt::format("{}|{}|{}|{}", number, phrase.machine.value_or("none"),
                                  phrase.parameters.value_or("none"),
                                  phrase.modules.value_or("none")));
  });
  EXPECT_EQ(text_of(stored), R"(|||{"1":"56","2":"0.5"}|[3,4])");
  EXPECT_THAT(phrases,
              ElementsAre(R"(1|--s0 0 --rwm0 |"S0":"exploration","RWM0":|none)",
                          R"(2|--n0 1 --n0x0 0 --p0x0 |"NumConnections0":1,"N0x0":0,"P0x0":|none)",
                          R"(3|none|none|"a":1,"b":2)", R"(4|none|none|"c":3)"));
  CandidateRow back;
  ASSERT_TRUE(book.decode(stored, back));
  EXPECT_EQ(back.machine, example().machine);
  EXPECT_EQ(back.parameters, example().parameters);
  EXPECT_EQ(back.modules, example().modules);
}

/// Each switch of a machine belongs to a parameter, and ends with its number.
TEST(PhraseBook, KnowsWhichMachinesRunAlongTheirParameters) {
  struct Case {
    const char *machine, *parameters;
    bool runs_along;
  };
  for (const auto& [machine, parameters, runs_along] :
       {Case{"--a 1 --b 2", R"({"a":1,"b":2})", true}, Case{"--a 1 -b 2", R"({"a":1,"b":2})", true},
        Case{"x --b 2", R"({"a":"t","b":2})", true}, Case{"x -b", R"({"a":"t","b":"u"})", true},
        Case{"--a 1 --b 3", R"({"a":1,"b":2})", false}, Case{"--a 1", R"({"a":1,"b":2})", false},
        Case{"--a 1 --b 2 --c", R"({"a":1,"b":2})", false},
        // Numbers are no switches.
        Case{"--a -0 --b -9", R"({"a":-0,"b":-9})", true},
        Case{"--a -.5 --b 1", R"({"a":"t","b":1})", true}, Case{"--a -/5", R"({"a":"t"})", false},
        Case{"--a -:5", R"({"a":"t"})", false}, Case{"--a 5", R"({"a":-5})", false},
        Case{"t", R"({"a":"t"})", true}, Case{"", R"({"a":"t"})", true}}) {
    PhraseBook book;
    const StoredTexts stored =
        book.encode(row_of(machine, parameters, ""), [](std::int64_t, const Phrase&) {});
    EXPECT_TRUE(stored.code) << machine;
    EXPECT_EQ(stored.parameters, "") << machine;
    EXPECT_EQ(stored.machine, runs_along ? "" : machine);
    CandidateRow back;
    EXPECT_TRUE(book.decode(stored, back));
    EXPECT_EQ(back.machine, machine);
    EXPECT_EQ(back.parameters, parameters);
  }
}

TEST(PhraseBook, CutsFlatObjectsAndLeavesOtherTextsAsTheyAre) {
  const auto stored = [](const std::string& text) {
    PhraseBook book;
    const StoredTexts texts =
        book.encode(row_of("", text, text), [](std::int64_t, const Phrase&) {});
    EXPECT_EQ(texts.code.has_value(), texts.module_code.has_value()) << text;
    EXPECT_EQ(texts.parameters, texts.code ? "" : text);
    EXPECT_EQ(texts.modules, texts.code ? "" : text);
    CandidateRow back;
    EXPECT_TRUE(book.decode(texts, back));
    EXPECT_EQ(back.parameters, text);
    EXPECT_EQ(back.modules, text);
    return texts.code.has_value();
  };
  for (const std::string text :
       {R"({"a":1})", R"({"":0})", R"({"a":-1.5e+30})", R"({"a":1E5})", R"({"a":true,"b":null})",
        R"({"a":"\"","b":"\\"})", R"({"a":"}{,:"})", R"({"a\"":"x"})", R"({"a":""})",
        R"({"a":azAB})"})
    EXPECT_EQ(stored(text), text.find("AB") == std::string::npos) << text;
  for (const std::string& text : {std::string(),
                                  std::string("{"),
                                  std::string("{}"),
                                  std::string("x"),
                                  std::string(R"({"a":1)"),
                                  std::string(R"({"a":1}x)"),
                                  std::string(R"({"a"})"),
                                  std::string(R"({"a":})"),
                                  std::string(R"({"a":1,})"),
                                  std::string(R"({"a":1,"b"})"),
                                  std::string(R"({"a":[1]})"),
                                  std::string(R"({"a":{}})"),
                                  std::string(R"({"a": 1})"),
                                  std::string(R"({"a":1 })"),
                                  std::string(R"({"a":"x})"),
                                  std::string(R"({"a":"\"})"),
                                  std::string(R"({a:1})"),
                                  std::string(R"({"a" 1})"),
                                  std::string(R"({"a";1})"),
                                  std::string(R"({"a":1;"b":2})"),
                                  std::string(R"(["a":1})"),
                                  std::string(R"({"a":1])"),
                                  std::string(R"({"a":"x")"),
                                  std::string("{\"a\":\"\0\"}", 9)})
    EXPECT_FALSE(stored(text)) << text;
}

TEST(PhraseBook, ReadsCodesToTheirEndAndNothingElse) {
  PhraseBook book;
  book.encode(example(), [](std::int64_t, const Phrase&) {});
  const auto decoded = [&](const std::string& code, const std::string& module_code) {
    StoredTexts texts{.machine = "as it is", .parameters = {}, .modules = {}};
    if (!code.empty()) texts.code = code;
    if (!module_code.empty()) texts.module_code = module_code;
    CandidateRow row;
    if (!book.decode(texts, row)) return std::string("not a code");
    return row.machine + "|" + row.parameters + "|" + row.modules;
  };
  EXPECT_EQ(decoded("", ""), "as it is||");
  EXPECT_EQ(decoded(R"({"1":"7"})", ""), R"(as it is|{"S0":"exploration","RWM0":7}|)");
  EXPECT_EQ(decoded("", "[4,3]"), R"(as it is||{"c":3,"a":1,"b":2})");
  for (const char* code :
       {"{", "{}", R"("1":"7"})", R"({1":"7"})", R"({"1:"7"})", R"({"x":"7"})", R"({"1":"7})",
        R"({"1":"7",})", R"({"1":"7")", R"({"1":"7"}x)", R"({"9":"7"})", R"({"1":7})", R"({"1"})",
        R"({"1":"7",{"1":"7"}})", R"(["1":"7"})", R"({"1":"7"])"})
    EXPECT_EQ(decoded(code, ""), "not a code") << code;
  for (const char* code : {"[", "[]", "3]", "[3", "[3]x", "[3,]", "[x]", "[9]", "{3]", "[3}"})
    EXPECT_EQ(decoded("", code), "not a code") << code;
}

TEST(PhraseBook, KnowsFromItsPhrasesWhichParametersHaveManyValues) {
  sqlite::Connection memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  create_tables(memory, kSchemaVersion);
  sqlite::Statement(memory, "INSERT INTO phrase VALUES (1, ?, ?, NULL)")
      .run(std::string_view("--rwm0 "), std::string_view(R"("RWM0":)"));
  PhraseBook book;
  book.load(memory);
  std::vector<std::int64_t> fresh;
  const auto code = [&] {
    return book
        .encode(row_of("--rwm0 3", R"({"RWM0":3})", ""),
                [&](std::int64_t number, const Phrase&) { fresh.push_back(number); })
        .code;
  };
  EXPECT_EQ(code(), R"({"1":"3"})");
  EXPECT_THAT(fresh, IsEmpty());
  book.clear();
  EXPECT_EQ(code(), R"({"1":""})") << "a small number is one of few";
  EXPECT_THAT(fresh, ElementsAre(1));
}

/// A phrase with so many bytes of modules, and what is between it and the next one.
struct LongPhrase {
  PhraseBook book;
  StoredTexts texts;
  CandidateRow row;

  explicit LongPhrase(std::size_t bytes) {
    const std::string modules = R"({"k":")" + std::string(bytes - 7, 'x') + "\"}";
    texts = book.encode(row_of("", "", modules), [&](std::int64_t, const Phrase& phrase) {
      EXPECT_EQ(phrase.modules->size(), bytes - 1);
    });
  }
  bool decoded() { return book.decode(texts, row); }
};

TEST(PhraseBook, MakesEightMebibytesOfOneTextAndSixtyFourOfAll) {
  LongPhrase most(8 << 20);
  for (int text = 1; text <= 8; ++text)
    EXPECT_TRUE(most.decoded()) << text;
  EXPECT_FALSE(most.decoded());
  EXPECT_FALSE(LongPhrase((8 << 20) + 1).decoded());
}

TEST(PhraseBook, MakesSixtyFourTimesAStoreAndSixtyFourMebibytes) {
  constexpr std::int64_t kPart = 1 << 20;
  sqlite::Connection memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  create_tables(memory, kSchemaVersion);
  sqlite::Statement(memory, "INSERT INTO phrase VALUES (4, NULL, NULL, ?)")
      .run(std::string(kPart - 1, 'x'));
  PhraseBook book;
  book.load(memory);
  StoredTexts texts{.machine = {}, .parameters = {}, .modules = {}};
  texts.module_code = "[4]";
  std::int64_t times = 0;
  CandidateRow row;
  while (times < 1000 && book.decode(texts, row))
    ++times;
  const std::int64_t size = sqlite::integer_of(memory, "PRAGMA page_count") *
                            sqlite::integer_of(memory, "PRAGMA page_size");
  EXPECT_EQ(times, (64 * size + (64 << 20)) / kPart);
  std::vector<std::int64_t> fresh;
  book.encode(example(), [&](std::int64_t number, const Phrase&) { fresh.push_back(number); });
  EXPECT_THAT(fresh, ElementsAre(5, 6, 7, 8)) << "after those of the store";
}

TEST_F(CandidateCodeTest, AMachineThatDoesNotRunAlongItsParametersStaysAsItIs) {
  CandidateRow row{
      .id = {1}, .parameters = R"({"a":5,"b":"x"})", .machine = "x of 5", .modules = {}};
  write({row});
  EXPECT_EQ(one("SELECT machine || '|' || parameters || '|' || code FROM candidate"),
            R"(x of 5||{"1":""})");
  EXPECT_EQ(one("SELECT fsm_config || '|' || parameters FROM v_candidates"),
            R"(x of 5|{"a":5,"b":"x"})");
}

TEST_F(CandidateCodeTest, ARowThatComesAgainMakesNoPhrases) {
  const auto rows = candidates(3, 0.3);
  write(rows);
  const std::string before = one("SELECT count(*) FROM phrase");
  write(rows);
  EXPECT_EQ(one("SELECT count(*) FROM phrase"), before);
  EXPECT_EQ(one("SELECT count(*) - count(DISTINCT quote(machine) || quote(parameters) ||"
                " quote(modules)) FROM phrase"),
            "0");
}

/// A phrase has four parameters, or five with a number at the end, and is never empty.
TEST_F(CandidateCodeTest, PhrasesAreShortAndNeverEmpty) {
  const auto phrases_of = [](int choices, const std::string& number) {
    CandidateRow row{.id = {1}, .parent = {}, .parameters = {}, .machine = {}, .modules = {}};
    std::vector<std::string> parameters, switches;
    for (int i = 0; i < choices; ++i) {
      parameters.push_back(fmt::format("\"C{}\":{}", i, i % 8));
      switches.push_back(fmt::format("--c{} {}", i, i % 8));
    }
    if (!number.empty()) {
      parameters.push_back("\"P\":" + number);
      switches.push_back("--p " + number);
    }
    row.parameters = fmt::format("{{{}}}", fmt::join(parameters, ","));
    row.machine = fmt::format("{}", fmt::join(switches, " "));
    PhraseBook book;
    std::vector<std::size_t> sizes;
    const StoredTexts texts = book.encode(row, [&](std::int64_t, const Phrase& phrase) {
      EXPECT_NE(phrase.parameters.value_or(""), "");
      if (phrase.parameters)
        sizes.push_back(static_cast<std::size_t>(std::ranges::count(*phrase.parameters, ':')));
    });
    EXPECT_TRUE(texts.code);
    CandidateRow back;
    EXPECT_TRUE(book.decode(texts, back));
    EXPECT_EQ(back.parameters, row.parameters);
    EXPECT_EQ(back.machine, row.machine);
    return sizes;
  };
  using Sizes = std::vector<std::size_t>;
  EXPECT_EQ(phrases_of(3, ""), (Sizes{3}));
  EXPECT_EQ(phrases_of(4, ""), (Sizes{4}));
  EXPECT_EQ(phrases_of(5, ""), (Sizes{4, 1}));
  EXPECT_EQ(phrases_of(13, ""), (Sizes{4, 4, 4, 1}));
  EXPECT_EQ(phrases_of(3, "0.5"), (Sizes{4}));
  EXPECT_EQ(phrases_of(4, "0.5"), (Sizes{5}));
  EXPECT_EQ(phrases_of(5, "0.5"), (Sizes{4, 2}));
}

TEST_F(CandidateCodeTest, TextsThatNeverRepeatAreStoredAsTheyAreOnceTheBookIsFull) {
  PhraseBook book;
  std::map<std::int64_t, Phrase> made;
  std::size_t coded = 0;
  for (std::int64_t i = 1; i <= 60'000; ++i) {
    const CandidateRow row{.id = {i},
                           .parent = {},
                           .parameters = fmt::format("{{\"file\":\"{}\"}}", i),
                           .machine = fmt::format("--file {}", i),
                           .modules = {}};
    const StoredTexts texts =
        book.encode(row, [&](std::int64_t number, const Phrase& phrase) { made[number] = phrase; });
    coded += texts.code ? 1U : 0U;
    CandidateRow back;
    ASSERT_TRUE(book.decode(texts, back));
    ASSERT_EQ(back.parameters, row.parameters);
    ASSERT_EQ(back.machine, row.machine);
  }
  const CandidateRow with_modules = row_of("", R"({"file":"1"})", R"({"module":1})");
  const StoredTexts last =
      book.encode(with_modules, [](std::int64_t, const Phrase&) { ADD_FAILURE(); });
  EXPECT_EQ(last.modules, with_modules.modules);
  EXPECT_FALSE(last.module_code);
  EXPECT_EQ(coded, 50'000U);
  EXPECT_EQ(made.size(), 50'000U);
}

TEST_F(CandidateCodeTest, APhraseThatIsMissingIsFoundAndNothingIsMadeUp) {
  write(candidates(4, 0));
  change("DELETE FROM phrase WHERE id = 3");
  const auto reader = open_reader(path);
  EXPECT_THAT(reader->integrity(), Contains(HasSubstr("phrases that do not exist")));
  EXPECT_THROW(candidates_in(*reader), StoreFailure);
}

TEST_F(CandidateCodeTest, ACodeThatMakesMoreThanATextHasIsRefusedBeforeItIsMade) {
  write(candidates(4, 0));
  change(
      "UPDATE phrase SET modules = printf('%.900000c', 'x') WHERE id = 1;"
      "UPDATE candidate SET module_code = '[' || printf('%.20000c', '1') || ']' WHERE id = 2;"
      "UPDATE candidate SET module_code = replace(module_code, '11', '1,1') WHERE id = 2;"
      "UPDATE candidate SET module_code = replace(module_code, '11', '1,1') WHERE id = 2");
  EXPECT_EQ(one("SELECT length(module_code) > 20000 FROM candidate WHERE id = 2"), "1");
  const auto reader = open_reader(path);
  EXPECT_THROW(candidates_in(*reader), StoreFailure);
  EXPECT_THAT(reader->integrity(), Contains(HasSubstr("longer than a store's")));
}

TEST_F(CandidateCodeTest, ATextHasEightMebibytesAtMost) {
  PhraseBook book;
  CandidateRow row;
  for (const auto text : {&StoredTexts::machine, &StoredTexts::parameters, &StoredTexts::modules}) {
    StoredTexts stored;
    stored.*text = std::string(8 << 20, 'x');
    EXPECT_TRUE(book.decode(stored, row));
    stored.*text += 'x';
    EXPECT_FALSE(book.decode(stored, row));
  }
}

TEST_F(CandidateCodeTest, CodesThatMakeManyTimesTheFileAreRefused) {
  write(candidates(4, 0));
  // Each text is one that a store may have; together they are not.
  change(
      "UPDATE phrase SET modules = printf('%.100000c', 'x') WHERE id = 1;"
      "UPDATE candidate SET module_code = '[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]'");
  EXPECT_GT(std::stoi(one("SELECT count(*) FROM candidate")), 60);
  EXPECT_THROW(candidates_in(*open_reader(path)), StoreFailure);
}

TEST_F(CandidateCodeTest, ACodeThatIsNoneIsFound) {
  write(candidates(4, 0));
  EXPECT_THAT(open_reader(path)->integrity(), IsEmpty());
  change("UPDATE candidate SET code = 'spoilt' WHERE id = 2");
  EXPECT_THROW(candidates_in(*open_reader(path)), StoreFailure);
  EXPECT_THAT(open_reader(path)->integrity(), Not(IsEmpty()));
}

}  // namespace
}  // namespace swarmsmith
