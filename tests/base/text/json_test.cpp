#include "base/text/json.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "base/id.h"

namespace swarmsmith {
namespace {

TEST(Json, KeepsTheOrderOfKeysAndTheShortestFormOfNumbers) {
  EXPECT_EQ(JsonObject().text(), "{}");
  EXPECT_EQ(JsonObject()
                .add("z", 1.0)
                .add("a", 0.1)
                .add("whole", std::int64_t{-7})
                .add("yes", true)
                .add("list", std::vector<double>{1e-300, 2.5})
                .add("inner", JsonObject().add("k", JsonPiece{"[1]"}))
                .text(),
            R"({"z":1,"a":0.1,"whole":-7,"yes":true,"list":[1e-300,2.5],"inner":{"k":[1]}})");
}

TEST(Json, HasNullForWhatIsNotThere) {
  EXPECT_EQ(json_of(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(json_of(std::optional<double>()), "null");
  EXPECT_EQ(json_of(std::optional<std::string>("x")), "\"x\"");
  EXPECT_EQ(json_of(DesignId{}), "null");
  EXPECT_EQ(json_of(DesignId{3}), "\"d3\"");
}

TEST(Json, EscapesTexts) {
  EXPECT_EQ(json_text("a\"b\\c\n\t\x01"), R"("a\"b\\c\n\t\u0001")");
  EXPECT_EQ(json_text("\xc3\xa9\xff"), "\"\xc3\xa9\xef\xbf\xbd\"");
}

TEST(Json, ListsWhatIsMadeOfEachItem) {
  EXPECT_EQ(json_list(std::vector<int>{1, 2}, [](int i) { return 2 * i; }).text, "[2,4]");
  EXPECT_EQ(json_list(std::vector<int>{}, [](int i) { return i; }).text, "[]");
}

}  // namespace
}  // namespace swarmsmith
