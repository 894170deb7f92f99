#include "sim/messages/profile_messages.h"

#include <cstddef>
#include <string>
#include <string_view>

#include "sim/engine/profile_fields.h"

namespace swarmsmith {
namespace {

/// "proximity.sd"
std::string path_of(std::string_view device, std::string_view key) {
  return (device.empty() ? "" : std::string(device) + ".") + std::string(key);
}

/// Visits a profile's fields and adds each to the message.
class FieldWriter {
 public:
  explicit FieldWriter(pb::Profile& message) : message_(&message) {}

  void device(std::string_view name) { device_ = name; }
  void number(std::string_view key, double value, FieldLimits) { add(key).add_numbers(value); }
  void flag(std::string_view key, bool value) { add(key).add_numbers(value ? 1 : 0); }

  template <class Value>
  void choice(std::string_view key, Value value, const FieldChoices<Value>& choices) {
    add(key).set_text(std::string(word_of(value, choices)));
  }
  void colors(std::string_view key, const std::vector<Rgb>& colors) {
    pb::Profile::Field& field = add(key);
    for (const Rgb color : colors) {
      for (const int channel : {color.r, color.g, color.b})
        field.add_numbers(channel);
    }
  }
  void delays(std::string_view key, const std::vector<ControlTiming::Delay>& delays) {
    pb::Profile::Field& field = add(key);
    for (const ControlTiming::Delay& delay : delays) {
      field.add_numbers(delay.sub_steps);
      field.add_numbers(delay.probability);
    }
  }
  void period(std::string_view key, double least, double most) {
    pb::Profile::Field& field = add(key);
    field.add_numbers(least);
    field.add_numbers(most);
  }
  void point(std::string_view key, Point point, FieldLimits) {
    pb::Profile::Field& field = add(key);
    field.add_numbers(point.x);
    field.add_numbers(point.y);
  }

 private:
  pb::Profile::Field& add(std::string_view key) {
    pb::Profile::Field& field = *message_->add_fields();
    field.set_key(path_of(device_, key));
    return field;
  }

  pb::Profile* message_;
  std::string_view device_;
};

/// Visits a profile's fields and takes each from the message. The first thing that is wrong is
/// kept; what follows keeps its value.
class FieldReader {
 public:
  explicit FieldReader(const pb::Profile& message) : message_(&message) {}

  const std::string& where() const { return where_; }
  const std::string& complaint() const { return complaint_; }
  /// To be called after the visit: the message may have more fields.
  void finish() {
    if (next_ < message_->fields_size()) complain(message_->fields(next_).key(), "is unknown");
  }

  void device(std::string_view name) { device_ = name; }

  void number(std::string_view key, double& value, FieldLimits limits) {
    if (const auto* field = take(key, 1)) read(*field, 0, limits, value);
  }
  void flag(std::string_view key, bool& value) {
    double number = 0;
    this->number(key, number, kRate);
    value = number == 1;
  }
  template <class Value>
  void choice(std::string_view key, Value& value, const FieldChoices<Value>& choices) {
    const auto* field = take(key, 0);
    if (field == nullptr) return;
    for (const auto& [word, meaning] : choices) {
      if (word != field->text()) continue;
      value = meaning;
      return;
    }
    complain(field->key(), "cannot be \"" + field->text() + "\"");
  }
  void colors(std::string_view key, std::vector<Rgb>& colors) {
    const auto* field = take_items(key, 3);
    if (field == nullptr) return;
    colors.clear();
    for (int i = 0; i < field->numbers_size(); i += 3) {
      double channels[3] = {};
      for (int channel = 0; channel < 3; ++channel)
        read(*field, i + channel, {0, 255}, channels[channel]);
      colors.push_back({static_cast<std::uint8_t>(channels[0]),
                        static_cast<std::uint8_t>(channels[1]),
                        static_cast<std::uint8_t>(channels[2])});
    }
  }
  void delays(std::string_view key, std::vector<ControlTiming::Delay>& delays) {
    const auto* field = take_items(key, 2);
    if (field == nullptr) return;
    delays.clear();
    for (int i = 0; i < field->numbers_size(); i += 2) {
      double sub_steps = 0;
      read(*field, i, {0, kLongestDelay}, sub_steps);
      delays.push_back({static_cast<int>(sub_steps), field->numbers(i + 1)});
    }
    if (!is_distribution(delays)) complain(field->key(), "has probabilities that do not sum to 1");
  }
  void period(std::string_view key, double& least, double& most) {
    const auto* field = take(key, 2);
    if (field == nullptr) return;
    read(*field, 0, kPeriodFactor, least);
    read(*field, 1, kPeriodFactor, most);
    if (least > most) complain(field->key(), "begins above its end");
  }
  void point(std::string_view key, Point& point, FieldLimits limits) {
    const auto* field = take(key, 2);
    if (field == nullptr) return;
    read(*field, 0, limits, point.x);
    read(*field, 1, limits, point.y);
  }

 private:
  void complain(const std::string& where, const std::string& text) {
    if (!complaint_.empty()) return;
    where_ = where;
    complaint_ = "the profile's field " + where + " " + text;
  }

  /// The next field, which must have this key; null after a complaint.
  const pb::Profile::Field* next(std::string_view key) {
    const std::string path = path_of(device_, key);
    if (next_ < message_->fields_size() && message_->fields(next_).key() == path) {
      return &message_->fields(next_++);
    }
    complain(path, "is missing");
    return nullptr;
  }
  const pb::Profile::Field* take(std::string_view key, int numbers) {
    const auto* field = next(key);
    if (field == nullptr || field->numbers_size() == numbers) return field;
    complain(field->key(), "has " + std::to_string(field->numbers_size()) + " numbers");
    return nullptr;
  }
  const pb::Profile::Field* take_items(std::string_view key, int item) {
    const auto* field = next(key);
    if (field == nullptr || field->numbers_size() % item == 0) return field;
    complain(field->key(), "has " + std::to_string(field->numbers_size()) + " numbers");
    return nullptr;
  }
  void read(const pb::Profile::Field& field, int index, FieldLimits limits, double& value) {
    const double number = field.numbers(index);
    if (limits.contain(number)) {
      value = number;
    } else {
      complain(field.key(), "is " + std::to_string(number) + "; wanted " +
                                std::to_string(limits.least) + " to " +
                                std::to_string(limits.most));
    }
  }

  const pb::Profile* message_;
  int next_ = 0;
  std::string_view device_;
  std::string where_;
  std::string complaint_;
};

}  // namespace

void to_message(const Profile& profile, pb::Profile& message) {
  message.Clear();
  message.set_name(profile.name);
  FieldWriter writer(message);
  visit_profile_fields(profile, writer);
}

Expected<Profile> from_message(const pb::Profile& message) {
  Profile profile;
  profile.name = message.name();
  FieldReader reader(message);
  visit_profile_fields(profile, reader);
  reader.finish();
  if (!reader.complaint().empty()) return bad_input(reader.complaint(), reader.where());
  return profile;
}

}  // namespace swarmsmith
