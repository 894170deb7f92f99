#include "tracking/video/internal/rosbag2_file.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/output_file.h"
#include "tracking/rig/issue.h"
#include "tracking/video/internal/av.h"
#include "tracking/video/internal/recorded_images.h"
#include "tracking/video/internal/ros_image.h"

namespace swarmsmith {
namespace {

Unexpected unreadable(const std::string& text, const std::string& name) {
  return Unexpected(error_of(IssueCode::VideoUnreadable, text, name));
}

struct CloseBase {
  void operator()(sqlite3* base) const { sqlite3_close_v2(base); }
};
struct CloseQuery {
  void operator()(sqlite3_stmt* query) const { sqlite3_finalize(query); }
};
using Base = std::unique_ptr<sqlite3, CloseBase>;
using Query = std::unique_ptr<sqlite3_stmt, CloseQuery>;

/// Opens a file that may be anything: nothing in it is run, and no row is larger than an image.
Expected<Base> open_base(const std::string& file) {
  constexpr int kMostBytes = 400 << 20;
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  Base base(opened);
  if (code != SQLITE_OK)
    return unreadable(std::string("cannot be opened: ") + sqlite3_errstr(code), file);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kMostBytes);
  note_input(file);
  return base;
}

Expected<Query> query_of(sqlite3* base, const char* text, const std::string& file) {
  sqlite3_stmt* made = nullptr;
  if (sqlite3_prepare_v2(base, text, -1, &made, nullptr) != SQLITE_OK) {
    return unreadable(std::string("is no bag of ROS 2: ") + sqlite3_errmsg(base), file);
  }
  return Query(made);
}

std::string text_at(sqlite3_stmt* query, int column) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(query, column));
  return text == nullptr ? std::string() : std::string(text);
}

struct Topic {
  std::int64_t id = 0;
  std::string type;
  std::string form;
  std::int64_t messages = 0;
};

Expected<std::map<std::string, Topic>> topics_of(sqlite3* base, const std::string& file) {
  auto query = query_of(base,
                        "SELECT id, name, type, serialization_format, (SELECT count(*) FROM "
                        "messages WHERE topic_id = topics.id) FROM topics",
                        file);
  if (!query) return Unexpected(query.error());
  std::map<std::string, Topic> topics;
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(query->get())) == SQLITE_ROW) {
    Topic topic{sqlite3_column_int64(query->get(), 0), text_at(query->get(), 2),
                text_at(query->get(), 3), sqlite3_column_int64(query->get(), 4)};
    if (topic.messages > 0) topics[text_at(query->get(), 1)] = std::move(topic);
  }
  if (code != SQLITE_DONE) return unreadable(sqlite3_errmsg(base), file);
  return topics;
}

class Rosbag2Messages final : public MessageReader {
 public:
  Rosbag2Messages(Base base, Query query, std::string name, std::int64_t count)
      : base_(std::move(base)), query_(std::move(query)), name_(std::move(name)), count_(count) {}

  Expected<std::optional<RecordedMessage>> next() override {
    const int code = sqlite3_step(query_.get());
    if (code == SQLITE_DONE) return std::optional<RecordedMessage>();
    if (code != SQLITE_ROW) {
      return unreadable(std::string("is damaged: ") + sqlite3_errmsg(base_.get()), name_);
    }
    const auto* const data = static_cast<const std::uint8_t*>(sqlite3_column_blob(query_.get(), 1));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(query_.get(), 1));
    bytes_.assign(data, data + (data == nullptr ? 0 : size));
    // Decoders and scalers read a little beyond the end.
    bytes_.resize(bytes_.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    return std::optional(RecordedMessage{sqlite3_column_int64(query_.get(), 0), bytes_.data(),
                                         data == nullptr ? 0 : size});
  }
  void rewind() override { sqlite3_reset(query_.get()); }
  std::int64_t count() const override { return count_; }

 private:
  Base base_;
  Query query_;
  std::string name_;
  std::int64_t count_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_rosbag2(const BagWord& word) {
  av::set_up();
  auto base = open_base(word.file);
  if (!base) return Unexpected(base.error());
  auto topics = topics_of(base->get(), word.file);
  if (!topics) return Unexpected(topics.error());
  std::map<std::string, std::string> types;
  for (const auto& [name, topic] : *topics)
    types[name] = topic.type;
  const auto name = image_topic(types, word);
  if (!name) return Unexpected(name.error());
  const Topic& topic = topics->at(*name);
  if (topic.form != "cdr") {
    return unreadable("topic " + *name + " has messages in the form `" + topic.form +
                          "`, which is not read; cdr is",
                      word.file);
  }
  auto query = query_of(base->get(),
                        "SELECT timestamp, data FROM messages WHERE topic_id = ? ORDER BY "
                        "timestamp, id",
                        word.file);
  if (!query) return Unexpected(query.error());
  sqlite3_bind_int64(query->get(), 1, topic.id);
  return open_recorded(word.file + (word.topic.empty() ? "" : ":" + word.topic),
                       std::make_unique<Rosbag2Messages>(std::move(*base), std::move(*query),
                                                         word.file, topic.messages),
                       MessageForm::Cdr, is_packed_type(topic.type));
}

}  // namespace swarmsmith
