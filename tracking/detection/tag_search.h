#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "tracking/detection/tag_detector.h"

namespace swarmsmith {

/// Which tags to look for, and how carefully.
struct TagSearchOptions {
  std::set<int> expected;  ///< robots, reference tags, sync tag
  std::set<int> still;     ///< of these, what lies on the floor: looked for now and then
  double still_search_every_s = 0.2;
  double full_search_every_s = 1;  ///< finds strays and tags that are there twice
  double least_margin = 20;        ///< of a detection that counts
  int most_hamming = 1;            ///< of an expected tag; others must be read without an error
};

/// Follows tags from frame to frame (tracking facts, section 6): the whole frame, then a window
/// around where each should be. A tag that is missed is looked for again at full resolution in a
/// larger window, then in the whole frame. What stays missing asks for the whole frame ever less
/// often, at last once in `full_search_every_s`, so that a tag that is hidden costs little more
/// than its window; what lies still and was seen before does not ask for it at all.
class TagSearch {
 public:
  TagSearch(TagDetector detector, TagSearchOptions options);

  /// The tags of a frame, by number; a tag that is seen twice is there twice. Times increase.
  std::vector<Detection> find(const GrayImage& image, double time_s);
  std::int64_t full_searches() const { return full_searches_; }

 private:
  /// Where a tag was last, and how it moved.
  struct Followed {
    ImagePoint centre;
    ImagePoint speed;        ///< pixels a second
    double diagonal_px = 0;  ///< the longer one
    double edge_px = 0;      ///< the shortest one
    double seen_s = 0;
    double searched_s = 0;
    double fine_until_s = 0;  ///< it was too faint for half the resolution
    int misses = 0;           ///< searches since it was seen
  };

  bool accepts(const Detection& detection) const;
  static bool is_small(const Followed& tag);
  bool full_is_due(double time_s) const;
  void search_whole(const GrayImage& image, double time_s, std::vector<Detection>& seen);
  void search_windows(const GrayImage& image, double time_s, std::vector<Detection>& seen);
  bool search_window(const GrayImage& image, double time_s, int tag, Followed& followed,
                     std::vector<Detection>& seen);
  bool take_window(const GrayImage& image, const PixelBox& box, int decimate, int tag,
                   std::vector<Detection>& seen);
  void follow(double time_s, const std::vector<Detection>& seen);
  std::set<int> missing_from(const std::vector<Detection>& seen) const;

  TagDetector detector_;
  TagSearchOptions options_;
  std::map<int, Followed> followed_;
  std::set<int> missing_;  ///< after the last frame
  std::optional<double> last_full_s_;
  double patience_s_ = 0;   ///< until missing tags ask for the whole frame again
  int passes_in_vain_ = 0;  ///< whole frames since tags are missing
  std::int64_t full_searches_ = 0;
};

}  // namespace swarmsmith
