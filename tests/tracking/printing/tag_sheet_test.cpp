#include "tracking/printing/tag_sheet.h"

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "console/pdf.h"
#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"
#include "tests/support/not_empty.h"
#include "tests/support/printed_page.h"
#include "tests/support/xml_check.h"
#include "tracking/detection/tag_pattern.h"
#include "tracking/geometry/tag_family.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

namespace swarmsmith {
namespace {

TagSheetOptions options_for(std::vector<int> ids, double edge_m, const char* paper) {
  return {"tag36h11", std::move(ids), edge_m, *paper_from_name(paper)};
}

std::string message_of(const TagSheetOptions& options) {
  const auto sheets = tag_sheets(options);
  return sheets ? "accepted" : to_string(sheets.error());
}

TEST(TagSheetTest, ReadsIds) {
  EXPECT_THAT(*ids_from_text("1-3,100,2,7-7"), ElementsAre(1, 2, 3, 100, 7));
  EXPECT_THAT(to_string(ids_from_text("1-").error()), HasSubstr("\"1-\" is not an id"));
  EXPECT_THAT(to_string(ids_from_text("").error()), HasSubstr("\"\" is not an id"));
  EXPECT_THAT(to_string(ids_from_text("3-1").error()), HasSubstr("not a range"));
  EXPECT_THAT(to_string(ids_from_text("1,-2").error()), HasSubstr("\"-2\""));
  EXPECT_THAT(to_string(ids_from_text("0-99999999").error()), HasSubstr("at most 10000"));
}

TEST(TagSheetTest, RefusesWhatCannotBePrinted) {
  EXPECT_THAT(message_of(options_for({1}, 0.2, "A4")), HasSubstr("largest that fits has 151 mm"));
  EXPECT_EQ(message_of(options_for({1}, 0.151, "A4")), "accepted");
  EXPECT_THAT(message_of(options_for({1}, 0.152, "A4")), HasSubstr("too large for A4"));
  EXPECT_THAT(message_of(options_for({587}, 0.1, "A4")), HasSubstr("ids 0 to 586"));
  EXPECT_THAT(message_of(options_for({}, 0.1, "A4")), HasSubstr("no ids"));
  EXPECT_THAT(message_of(options_for({1}, std::nan(""), "A4")), HasSubstr("not from"));
  TagSheetOptions options = options_for({1}, 0.1, "A4");
  options.family = "tag36h12";
  EXPECT_THAT(message_of(options), HasSubstr("did you mean \"tag36h11\"?"));
}

TEST(TagSheetTest, PutsAsManyOnAPageAsFit) {
  EXPECT_EQ(tag_sheets(options_for({1, 2, 3}, 0.1, "A4"))->size(), 2U);
  EXPECT_EQ(tag_sheets(options_for({1, 2, 3, 4, 5, 6}, 0.1, "A3"))->size(), 1U) << "lying";
  EXPECT_EQ(tag_sheets(options_for({1, 2}, 0.1, "letter"))->size(), 1U) << "lying";
  EXPECT_EQ(tag_sheets(options_for({1, 2}, 0.15, "letter"))->size(), 2U);
}

TEST(TagSheetTest, DrawsTheOfficialPatternToAHundredthOfAMillimetre) {
  const double edge = 0.0371;  // no round cells
  const auto sheets = value_of(tag_sheets(options_for({42}, edge, "A4")));
  const std::string& sheet = sheets.front();
  EXPECT_EQ(xml_trouble(sheet), "");
  const DrawnPage page = drawn_page(sheet);
  const TagPattern pattern = *tag_pattern("tag36h11", 42);
  const double cell = 1000 * edge / 8;
  double left = 1e9;
  double top = 1e9;
  for (const DrawnPage::Bar& bar : page.bars) {
    left = std::min(left, bar.x);
    top = std::min(top, bar.y);
  }
  double area = 0;
  for (const DrawnPage::Bar& bar : page.bars) {
    EXPECT_NEAR(bar.thickness, cell, 0.01);
    const double row = (bar.y - top) / cell;
    const double first = (bar.x - left) / cell;
    const double end = (bar.x + bar.length - left) / cell;
    for (const double place : {row, first, end})
      EXPECT_NEAR(place * cell, std::round(place) * cell, 0.0101);
    for (long column = std::lround(first); column < std::lround(end); ++column)
      EXPECT_TRUE(
          pattern.is_black(static_cast<int>(std::lround(row)) + 1, static_cast<int>(column) + 1));
    area += (end - first);
  }
  const auto black = std::count(pattern.black.begin(), pattern.black.end(), true);
  EXPECT_NEAR(area, static_cast<double>(black), 0.05);
}

TEST(TagSheetTest, PrintsEveryKnownFamily) {
  for (const TagFamily& family : not_empty(known_tag_families())) {
    const std::string name(family.name);
    EXPECT_TRUE(tag_pattern(name, family.tags - 1)) << name;
    EXPECT_FALSE(tag_pattern(name, family.tags)) << name;
  }
}

TEST(TagSheetTest, NoTextStandsOnAnother) {
  for (const double edge : {0.015, 0.02, 0.03, 0.05, 0.1}) {
    for (const std::string family : {"tag36h11", "tagStandard41h12"}) {
      TagSheetOptions options = options_for({0, 1, 2, 3, 586}, edge, "A3");
      options.family = family;
      for (const std::string& sheet : not_empty(value_of(tag_sheets(options))))
        EXPECT_THAT(drawn_page(sheet).collisions(), IsEmpty()) << edge << family;
    }
  }
}

/// What the library sees on a page: corners in its order.
struct Seen {
  std::array<std::array<double, 2>, 4> corners{};
};
std::map<int, Seen> tags_on(PrintedPage& page) {
  const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag36h11_create(),
                                                                                tag36h11_destroy);
  const std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
      apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family(detector.get(), family.get());
  detector->quad_decimate = 1;
  image_u8_t image{page.width, page.height, page.width, page.gray.data()};
  zarray_t* found = apriltag_detector_detect(detector.get(), &image);
  std::map<int, Seen> seen;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found, i, &detection);
    EXPECT_EQ(detection->hamming, 0);
    Seen& one = seen[detection->id];
    for (std::size_t k = 0; k < 4; ++k)
      one.corners[k] = {detection->p[k][0], detection->p[k][1]};
  }
  apriltag_detections_destroy(found);
  return seen;
}

TEST(TagSheetTest, ThePrintIsReadByTheLibraryInTrueScale) {
  constexpr int kDpi = 200;
  constexpr double kPixel = 25.4 / kDpi;
  const std::vector<int> ids = {0, 3, 100, 101, 586};
  const auto sheets = tag_sheets(options_for(ids, 0.1, "A4"));
  const auto pdf = pdf_of_svgs(*sheets);
  if (!pdf) GTEST_SKIP() << "skipped: " << to_string(pdf.error());
  const auto sizes = page_sizes(*pdf);
  if (!sizes) GTEST_SKIP() << "skipped: " << to_string(sizes.error());
  ASSERT_EQ(sizes->size(), 3U);
  for (const PageSize& size : *sizes) {
    EXPECT_NEAR(size.width_mm, 210, 0.01);
    EXPECT_NEAR(size.height_mm, 297, 0.01);
  }
  auto pages = printed_pages(*pdf, kDpi);
  if (!pages) GTEST_SKIP() << "skipped: " << to_string(pages.error());
  std::set<int> found;
  for (PrintedPage& page : *pages) {
    for (const auto& [id, seen] : tags_on(page)) {
      found.insert(id);
      const auto& [bottom_left, bottom_right, top_right, top_left] = seen.corners;
      const auto distance = [](const auto& a, const auto& b) {
        return kPixel * std::hypot(a[0] - b[0], a[1] - b[1]);
      };
      EXPECT_NEAR(distance(bottom_left, bottom_right), 100, 0.1) << id;
      EXPECT_NEAR(distance(bottom_right, top_right), 100, 0.1) << id;
      EXPECT_NEAR(distance(top_left, bottom_right), 100 * std::sqrt(2), 0.15) << id;
      // Upright on the page, as the arrows beside it say.
      EXPECT_NEAR(bottom_left[0], top_left[0], 2) << id;
      EXPECT_LT(bottom_left[0], bottom_right[0]) << id;
      EXPECT_LT(top_left[1], bottom_left[1]) << id;
    }
  }
  EXPECT_THAT(found, testing::ElementsAreArray(ids));
}

TEST(TagSheetTest, SameWordsSameBytes) {
  EXPECT_EQ(*tag_sheets(options_for({1, 2}, 0.1, "A4")),
            *tag_sheets(options_for({1, 2}, 0.1, "A4")));
}

}  // namespace
}  // namespace swarmsmith
