#include "coordinator/service/paused_designs.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

CommandRow command(CommandKind kind, std::int64_t design) {
  return {.kind = kind, .design = {design}, .step = std::nullopt};
}

std::vector<DesignId> designs_of(const std::vector<CommandRow>& rows) {
  std::vector<DesignId> designs;
  for (const CommandRow& row : rows)
    designs.push_back(row.design);
  return designs;
}

TEST(PausedDesigns, AreThoseOfTheLastCommands) {
  const std::vector<CommandRow> commands = {
      command(CommandKind::Pause, 1), command(CommandKind::Pause, 2),
      command(CommandKind::Resume, 1), command(CommandKind::Cancel, 2)};
  EXPECT_THAT(paused_designs(commands), ElementsAre(DesignId{2}));
}

TEST(PausedDesigns, APauseHasARowForEachDesignThatItChanges) {
  const std::vector<DesignId> unfinished = {{1}, {2}, {3}};
  const auto all = value_of(rows_of_pause(command(CommandKind::Pause, 0), unfinished, {{2}}));
  EXPECT_THAT(designs_of(all), ElementsAre(DesignId{1}, DesignId{3}));
  EXPECT_EQ(sentence_of_pause(CommandKind::Pause, all), "paused: d1, d3");
  const auto again = value_of(rows_of_pause(command(CommandKind::Resume, 3), unfinished, {{2}}));
  EXPECT_THAT(again, IsEmpty());
  EXPECT_EQ(sentence_of_pause(CommandKind::Resume, again),
            "nothing to do: every design is over, or already resumed");
  EXPECT_FALSE(rows_of_pause(command(CommandKind::Pause, 4), unfinished, {})) << "it is over";
}

}  // namespace
}  // namespace swarmsmith
