#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "tracking/detection/tag_detector.h"

namespace swarmsmith {

/// The tags to look for, and the effort of the search.
struct TagSearchOptions {
  std::set<int> expected;  ///< robots, reference tags, sync tag
  std::set<int> still;     ///< expected tags on the floor; searched less often
  double still_search_every_s = 0.2;
  double full_search_every_s = 1;  ///< finds stray tags and duplicates
  double least_margin = 20;        ///< smallest margin of a valid detection
  int most_hamming = 1;            ///< for expected tags; other tags must have no wrong bit
};

/// Follows tags from frame to frame (tracking facts, section 6): first in the whole frame, then in
/// a window around the place where each tag should be. A tag that is not found is searched again at
/// full resolution in a larger window, then in the whole frame. While tags stay missing, the whole
/// frame is searched less and less often, down to once per `full_search_every_s`, so that a hidden
/// tag costs little more than its window. A tag that does not move and was seen before never causes
/// a search of the whole frame.
class TagSearch {
 public:
  TagSearch(TagDetector detector, TagSearchOptions options);

  /// The tags of a frame, by number; a tag that is seen twice is in the list twice. Times must
  /// increase.
  std::vector<Detection> find(const GrayImage& image, double time_s);
  std::int64_t full_searches() const { return full_searches_; }

 private:
  /// The last position of a tag, and its motion.
  struct Followed {
    ImagePoint centre;
    ImagePoint speed;        ///< pixels per second
    double diagonal_px = 0;  ///< its longer diagonal
    double edge_px = 0;      ///< its shortest edge
    double seen_s = 0;
    double searched_s = 0;
    double fine_until_s = 0;  ///< until then at full resolution, since it was too faint for half
    int misses = 0;           ///< number of searches since it was last seen
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
  std::set<int> missing_;  ///< missing after the last frame
  std::optional<double> last_full_s_;
  double patience_s_ = 0;   ///< time until missing tags cause the next search of the whole frame
  int passes_in_vain_ = 0;  ///< searches of whole frames since tags are missing
  std::int64_t full_searches_ = 0;
};

}  // namespace swarmsmith
