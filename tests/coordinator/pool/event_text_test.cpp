#include "coordinator/pool/event_text.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

std::string event_text(std::initializer_list<EventField> fields) {
  return pool_event("info", "kind", fields).text;
}

TEST(EventText, IsJson) {
  EXPECT_EQ(event_text({}), "{}");
  EXPECT_EQ(event_text({{"worker", std::int64_t{3}}, {"host", "a\"b\\c"}}),
            R"({"worker":3,"host":"a\"b\\c"})");
}

TEST(EventText, TakesAnyBytes) {
  EXPECT_EQ(event_text({{"reason", std::string("a\n\x01\xff")}}), R"({"reason":"a\u000a\u0001?"})");
  EXPECT_EQ(pool_event("info", "kind", {{"reason", "a\xff"}}).fields.front(),
            (EventField{"reason", "a?"}))
      << "logs show what stores keep";
}

}  // namespace
}  // namespace swarmsmith
