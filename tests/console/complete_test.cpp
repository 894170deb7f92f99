#include "console/complete.h"

#include <CLI/CLI.hpp>
#include <sstream>
#include <stdexcept>

#include "console/options.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// A command with an option of each kind.
class Complete : public testing::Test {
 protected:
  Complete() {
    Options options(app_);
    options.text("--design DESIGN", text_, "Design; once");
    options.texts("--seed", texts_, "Seeds");
    options.choice("--by", text_, {"source", "method"}, "What");
    options.text("-o,--output FILE", text_, "File");
    options.integer("--limit", number_, {0, 9}, "Rows");
    options.flag("--paper", flag_, "For a paper (no title)");
    options.text("KIND DESIGN", text_, "What");
    options.words("STORE", texts_, "Stores", Options::Need::Required);
    declared_ = options.declared();
  }

  static void values(std::string_view kind, std::span<const std::string> words, Offer& offer) {
    offer.words.push_back({std::string(kind) + std::to_string(words.size()), ""});
  }

  Offer offer(const std::vector<std::string>& words, std::string_view begin) const {
    return offer_next(declared_, words, begin, values);
  }

  std::vector<std::string> texts(const std::vector<std::string>& words,
                                 std::string_view begin) const {
    std::vector<std::string> found;
    for (const Offer::Word& word : offer(words, begin).words)
      found.push_back(word.text);
    return found;
  }

  const DeclaredOption& declared(const std::string& name) const {
    for (const DeclaredOption& option : declared_) {
      if (option.names.back() == name) return option;
    }
    throw std::logic_error("not declared");
  }

 private:
  CLI::App app_;
  std::string text_;
  std::vector<std::string> texts_;
  std::optional<std::int64_t> number_;
  bool flag_ = false;
  std::vector<DeclaredOption> declared_;
};

TEST_F(Complete, KnowsWhatWasDeclared) {
  EXPECT_THAT(declared("--output").names, ElementsAre("-o", "--output"));
  EXPECT_EQ(declared("--output").value, "FILE");
  EXPECT_EQ(declared("--limit").value, "N");
  EXPECT_EQ(declared("--paper").value, "");
  EXPECT_FALSE(declared("--paper").takes_value());
  EXPECT_TRUE(declared("--seed").repeats);
  EXPECT_THAT(declared("--by").choices, ElementsAre("source", "method"));
  EXPECT_TRUE(declared("STORE").is_word && declared("STORE").required && declared("STORE").repeats);
  EXPECT_EQ(declared("KIND").kind, "DESIGN");
}

TEST_F(Complete, OffersOptionsThatAreNotGivenYet) {
  EXPECT_THAT(texts({}, "-"), ElementsAre("-h", "--help", "--design", "--seed", "--by", "-o",
                                          "--output", "--limit", "--paper"));
  EXPECT_THAT(texts({"-o", "x", "--seed", "1", "--by=method"}, "-"),
              ElementsAre("-h", "--help", "--design", "--seed", "--limit", "--paper"));
  EXPECT_EQ(offer({}, "-").words.back().meaning, "For a paper");
}

TEST_F(Complete, OffersValues) {
  EXPECT_THAT(texts({"--by"}, ""), ElementsAre("source", "method"));
  EXPECT_THAT(texts({}, "--by="), ElementsAre("--by=source", "--by=method"));
  EXPECT_THAT(texts({"x", "--design"}, ""), ElementsAre("DESIGN2"));
  EXPECT_THAT(texts({}, "--paper="), IsEmpty());
  EXPECT_EQ(offer({"-o"}, "").files, Offer::Files::All);
}

TEST_F(Complete, OffersWordsByTheirPlace) {
  EXPECT_THAT(texts({}, ""), ElementsAre("DESIGN0"));
  EXPECT_EQ(offer({"d1"}, "").files, Offer::Files::Stores);
  EXPECT_EQ(offer({"d1", "--paper", "--by", "method", "a.db"}, "").files, Offer::Files::Stores);
  EXPECT_EQ(offer({"--", "-x"}, "-").files, Offer::Files::Stores);
}

TEST(TypedWords, AreWholeAgain) {
  const auto typed = [](std::vector<std::string> words) { return typed_words(words); };
  EXPECT_THAT(typed({}), ElementsAre(""));
  EXPECT_THAT(typed({"a", "--by", "=", "me"}), ElementsAre("a", "--by", "me"));
  EXPECT_THAT(typed({"--by", "="}), ElementsAre("--by", ""));
  EXPECT_THAT(typed({"a", "="}), ElementsAre("a", "="));
}

TEST(WriteOffer, LeavesOutWhatDoesNotFit) {
  std::ostringstream out;
  write_offer(
      out,
      {.words = {{"box", "Boxes"}, {"bad\tword", ""}, {"gap", ""}}, .files = Offer::Files::Folders},
      "b");
  EXPECT_EQ(out.str(), "box\tBoxes\n:folders\n");
}

}  // namespace
}  // namespace swarmsmith
