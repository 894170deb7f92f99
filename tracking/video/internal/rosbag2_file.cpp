#include "tracking/video/internal/rosbag2_file.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/output_file.h"
#include "base/plain_text.h"
#include "tracking/video/internal/av.h"
#include "tracking/video/internal/recorded_images.h"
#include "tracking/video/internal/ros_image.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

struct CloseBase {
  void operator()(sqlite3* base) const { sqlite3_close_v2(base); }
};
struct CloseQuery {
  void operator()(sqlite3_stmt* query) const { sqlite3_finalize(query); }
};
using SqliteBase = std::unique_ptr<sqlite3, CloseBase>;
using Query = std::unique_ptr<sqlite3_stmt, CloseQuery>;

/// An SQLite file with untrusted contents.
struct Base {
  SqliteBase sqlite;
  /// Limits the work of SQLite: a damaged file can make it loop over more rows than the file has
  /// bytes.
  std::unique_ptr<std::int64_t> steps_left = std::make_unique<std::int64_t>(0);
  std::int64_t most_steps = 0;

  sqlite3* get() const { return sqlite.get(); }
  void begin() const { *steps_left = most_steps; }
};

/// Opens the file so that no code in it is run, and no row may be larger than the file or an image.
Expected<Base> open_base(const std::string& file) {
  constexpr std::int64_t kMostBytes = 400 << 20;
  constexpr std::int64_t kLeastBytes = 1 << 20;
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file, error));
  if (error) return unreadable("cannot be opened: " + error.message(), file);
  if (size == 0) return unreadable("the file is empty", file);
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  Base base{SqliteBase(opened)};
  if (code != SQLITE_OK)
    return unreadable(std::string("cannot be opened: ") + sqlite3_errstr(code), file);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH,
                static_cast<int>(std::clamp(size, kLeastBytes, kMostBytes)));
  constexpr std::int64_t kFewSteps = 20'000'000;
  constexpr std::int64_t kStepsOfByte = 20;
  constexpr int kStepsAtOnce = 10'000;
  base.most_steps = kFewSteps + kStepsOfByte * size;
  base.begin();
  sqlite3_progress_handler(
      opened, kStepsAtOnce,
      [](void* left) { return (*static_cast<std::int64_t*>(left) -= kStepsAtOnce) < 0 ? 1 : 0; },
      base.steps_left.get());
  note_input(file);
  return base;
}

/// SQLite's error message.
std::string complaint(sqlite3* base) {
  const std::string words = shortened(sqlite3_errmsg(base));
  switch (sqlite3_errcode(base)) {
    case SQLITE_NOTADB:
      return "is damaged, or not an SQLite file: " + words;
    case SQLITE_ERROR:
      return "is not a bag of ROS 2: " + words;
    case SQLITE_INTERRUPT:
      return "is damaged: it has more rows than bytes";
    default:
      return "is damaged: " + words;
  }
}

Expected<Query> query_of(sqlite3* base, const char* text, const std::string& file) {
  sqlite3_stmt* made = nullptr;
  if (sqlite3_prepare_v2(base, text, -1, &made, nullptr) != SQLITE_OK)
    return unreadable(complaint(base), file);
  return Query(made);
}

/// Checks that its tables are real tables with stored columns; nothing else is queried.
Expected<void> check_tables(sqlite3* base, const std::string& file) {
  for (const char* table : {"topics", "messages"}) {
    const auto count = [&](const char* text) -> Expected<std::int64_t> {
      auto query = query_of(base, text, file);
      if (!query) return Unexpected(query.error());
      sqlite3_bind_text(query->get(), 1, table, -1, SQLITE_STATIC);
      if (sqlite3_step(query->get()) != SQLITE_ROW) return unreadable(complaint(base), file);
      return sqlite3_column_int64(query->get(), 0);
    };
    const auto tables = count(
        "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ? AND rootpage > 0");
    if (!tables) return Unexpected(tables.error());
    if (*tables != 1)
      return unreadable(fmt::format("is not a bag of ROS 2: {} is not a table of it", table), file);
    const auto computed = count("SELECT count(*) FROM pragma_table_xinfo(?) WHERE hidden != 0");
    if (!computed) return Unexpected(computed.error());
    if (*computed != 0)
      return unreadable(fmt::format("is not a bag of ROS 2: a column of {} is computed", table),
                        file);
  }
  return {};
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
  std::map<std::int64_t, std::int64_t> counts;
  auto messages = query_of(base, "SELECT topic_id FROM messages", file);
  if (!messages) return Unexpected(messages.error());
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(messages->get())) == SQLITE_ROW)
    ++counts[sqlite3_column_int64(messages->get(), 0)];
  if (code != SQLITE_DONE) return unreadable(complaint(base), file);
  auto query = query_of(base, "SELECT id, name, type, serialization_format FROM topics", file);
  if (!query) return Unexpected(query.error());
  std::map<std::string, Topic> topics;
  while ((code = sqlite3_step(query->get())) == SQLITE_ROW) {
    Topic topic{sqlite3_column_int64(query->get(), 0), text_at(query->get(), 2),
                text_at(query->get(), 3), 0};
    topic.messages = counts[topic.id];
    if (topic.messages > 0) topics[text_at(query->get(), 1)] = std::move(topic);
  }
  if (code != SQLITE_DONE) return unreadable(complaint(base), file);
  return topics;
}

class Rosbag2Messages final : public MessageReader {
 public:
  Rosbag2Messages(Base base, Query query, std::string name, std::int64_t count)
      : base_(std::move(base)), query_(std::move(query)), name_(std::move(name)), count_(count) {}

  Expected<std::optional<RecordedMessage>> next() override {
    const int code = sqlite3_step(query_.get());
    if (code == SQLITE_DONE) return std::optional<RecordedMessage>();
    if (code != SQLITE_ROW)
      return unreadable(complaint(base_.get()) + " (after " + counted(given_, "image") + ")",
                        name_);
    ++given_;
    const auto* const data = static_cast<const std::uint8_t*>(sqlite3_column_blob(query_.get(), 1));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(query_.get(), 1));
    bytes_.assign(data, data + (data == nullptr ? 0 : size));
    // Decoders and scalers read slightly beyond the end.
    bytes_.resize(bytes_.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    return std::optional(RecordedMessage{sqlite3_column_int64(query_.get(), 0), bytes_.data(),
                                         data == nullptr ? 0 : size});
  }
  void rewind() override {
    sqlite3_reset(query_.get());
    base_.begin();
    given_ = 0;
  }
  std::int64_t count() const override { return count_; }

 private:
  Base base_;
  Query query_;
  std::string name_;
  std::int64_t count_;
  std::int64_t given_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

Expected<std::unique_ptr<FrameSource>> open_rosbag2(const BagWord& word) {
  av::set_up();
  auto base = open_base(word.file);
  if (!base) return Unexpected(base.error());
  if (const auto tables = check_tables(base->get(), word.file); !tables)
    return Unexpected(tables.error());
  base->begin();
  auto topics = topics_of(base->get(), word.file);
  if (!topics) return Unexpected(topics.error());
  std::map<std::string, std::string> types;
  for (const auto& [name, topic] : *topics)
    types[name] = topic.type;
  const auto name = image_topic(types, word);
  if (!name) return Unexpected(name.error());
  const Topic& topic = topics->at(*name);
  if (topic.form != "cdr") {
    return unreadable("topic " + *name + " has messages in the form `" + shortened(topic.form) +
                          "`, which is not supported; cdr is",
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
