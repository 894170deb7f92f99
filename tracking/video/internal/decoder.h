#pragma once

#include <string>

#include "base/expected.h"
#include "tracking/video/internal/av.h"

namespace swarmsmith::av {

/// A single-threaded decoder that reports damaged pictures. E_VIDEO_UNREADABLE for an unknown or
/// refused codec.
Expected<Codec> open_decoder(const AVCodecParameters& about, AVRational time_base,
                             const std::string& name);

/// Whether each picture is independent of the others, so that damage affects only one picture.
bool is_intra_only(AVCodecID codec);

/// The largest number of pixels that a picture of this codec may have.
std::int64_t most_pixels(AVCodecID codec);

/// Names of the accepted decoders, separated by commas.
extern const char* const kTakenDecoders;

}  // namespace swarmsmith::av
