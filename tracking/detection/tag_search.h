#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "tracking/detection/tag_detector.h"

namespace swarmsmith {

/// Which tags to look for, and how carefully.
struct TagSearchOptions {
  std::set<int> expected;          ///< robots, reference tags, sync tag
  double full_search_every_s = 1;  ///< finds strays and tags that are there twice
  double least_margin = 20;        ///< of a detection that counts
  int most_hamming = 1;            ///< of an expected tag; others must be read without an error
};

/// Follows tags from frame to frame: the whole frame until all are found, then a window around
/// where each should be (tracking facts, section 6).
class TagSearch {
 public:
  TagSearch(TagDetector detector, TagSearchOptions options);

  /// The tags of a frame, by number; a tag that is seen twice is there twice.
  std::vector<Detection> find(const GrayImage& image, double time_s);
  std::int64_t full_searches() const { return full_searches_; }

 private:
  /// Where a tag was last, and how it moved.
  struct Followed {
    ImagePoint centre;
    ImagePoint speed;    ///< pixels a second
    double size_px = 0;  ///< of its diagonal
    double time_s = 0;
  };

  TagDetector detector_;
  TagSearchOptions options_;
  std::map<int, Followed> followed_;
  double last_full_s_ = 0;
  std::int64_t full_searches_ = 0;
};

}  // namespace swarmsmith
