#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"
#include "tests/support/not_empty.h"
#include "tests/support/xml_check.h"
#include "tracking/printing/survey_sheet.h"

namespace swarmsmith {
namespace {

TEST(PaperTest, KnowsItsNames) {
  EXPECT_DOUBLE_EQ(paper_from_name("A4")->height_mm, 297);
  EXPECT_EQ(turned(*paper_from_name("A3")), (Paper{"A3", 420, 297}));
  EXPECT_THAT(to_string(paper_from_name("B5").error()), HasSubstr("A4, A3, letter"));
}

TEST(SurveySheetTest, HasALineATagAndNothingOverAnother) {
  for (const char* paper : {"A4", "A3", "letter"}) {
    const auto sheet = value_of(survey_sheet(
        {regular_dodecagon(4.91), {100, 101, 102, 103, 104, 105}, 0.1, *paper_from_name(paper)}));
    EXPECT_EQ(xml_trouble(sheet), "");
    const DrawnPage page = drawn_page(sheet);
    EXPECT_THAT(page.collisions(), IsEmpty()) << paper;
    EXPECT_TRUE(page.has_text("1.127, 0.000"));
    // Side, and the other distances from corner to corner, of tracking facts, section 1.
    EXPECT_THAT(sheet, HasSubstr("0.662, 1.279, 1.809, 2.216, 2.471, 2.559"));
  }
}

TEST(SurveySheetTest, SaysWhenItIsFull) {
  std::vector<int> ids(60);
  EXPECT_THAT(
      complaint_of(survey_sheet({regular_dodecagon(4.91), ids, 0.1, *paper_from_name("A4")})),
      HasSubstr("60 tags, but the form has"));
}

TEST(SurveySheetTest, RefusesWhatCannotLieInTheArena) {
  struct Row {
    double area_m2;
    std::vector<int> ids;
    double edge_m;
    const char* wanted;
  };
  const std::vector<int> six = {100, 101, 102, 103, 104, 105};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<int> many(13);
  std::iota(many.begin(), many.end(), 100);
  const std::vector<Row> rows = {
      {4.91, six, 0.001, "--edge: 0.001 m is not from 0.015 to 1 m"},
      {4.91, six, 1e9, "--edge: 1000000000 m is not from 0.015 to 1 m"},
      {4.91, six, kInfinity, "--edge: inf m is not"},
      {1e6, six, 0.1, "--area: the arena reaches to 577.4 m"},
      {1e300, six, 0.1, "--area: the arena reaches to"},
      {kInfinity, six, 0.1, "--area: the arena reaches to"},
      {1e-9, six, 0.1, "--edge: 6 tags of 0.1 m do not fit into the arena"},
      {0.02, {100}, 0.1, "--edge: 1 tag of 0.1 m does not fit into the arena"},
      {4.91, six, 0.9, "--edge: 6 tags of 0.9 m do not fit into the arena"},
      {4.91, many, 0.4, "--edge: 13 tags of 0.4 m do not fit into the arena"},
      {4.91, {100, 65'535}, 0.1, "--ids: no family has a tag 65535"},
  };
  for (const Row& row : not_empty(rows)) {
    EXPECT_THAT(complaint_of(survey_sheet(
                    {regular_dodecagon(row.area_m2), row.ids, row.edge_m, *paper_from_name("A4")})),
                HasSubstr(row.wanted))
        << row.area_m2 << " m2, " << row.edge_m << " m";
  }
  // The largest that fit.
  EXPECT_TRUE(survey_sheet({regular_dodecagon(4.91), six, 0.5, *paper_from_name("A4")}));
  EXPECT_TRUE(survey_sheet({regular_dodecagon(20'000), six, 1, *paper_from_name("A4")}));
}

TEST(SurveySheetTest, ProposedTagsLieWithinTheWalls) {
  const Arena arena = regular_dodecagon(4.91);
  for (const std::size_t tags : {4U, 5U, 6U, 8U}) {
    for (const Pose& place : not_empty(suggested_places(arena, tags, 0.1))) {
      for (const double x : {-0.0625, 0.0625})
        for (const double y : {-0.0625, 0.0625})
          EXPECT_TRUE(is_inside(arena, {place.x + x, place.y + y}));
    }
  }
}

}  // namespace
}  // namespace swarmsmith
