#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "tracking/video/internal/av.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith::av {

/// A kind of file, by its ending.
struct Container {
  std::string_view ending;
  const char* muxer;
  AVRational grain;  ///< of its times; 0: the rate's
};

/// A codec, by the word of VideoOptions.
struct CodecChoice {
  std::string_view name;
  const char* encoder;
  AVPixelFormat format;
};

/// What a video is written with.
struct VideoChoice {
  const Container* container = nullptr;
  const CodecChoice* codec = nullptr;
};

/// E_CONFIG for what cannot be.
Expected<VideoChoice> video_choice(const std::string& path, ImageSize size,
                                   const VideoOptions& options);

/// An encoder that gives the same bytes whenever and wherever, not opened yet.
Codec make_encoder(const AVCodec& encoder, const VideoChoice& choice, ImageSize size,
                   const VideoOptions& options);

}  // namespace swarmsmith::av
