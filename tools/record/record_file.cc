#include "tools/record/record_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "lcmtypes/layout.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/run_message.h"
#include "tools/run/run_files.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

/// Reads the fields of one message, whose layout holds (layout_fault()).
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  Json fields(std::span<const MessageField> all) {
    Json json = Json::object();
    for (const MessageField& field : all) {
      const std::string name(field.name);
      if (field.count_field < 0 && field.number == 1) {
        json[name] = entry(field);
        continue;
      }
      const std::size_t number =
          field.count_field < 0 ? field.number : json[std::string(all[field.count_field].name)].get<std::size_t>();
      Json list = Json::array();
      for (std::size_t i = 0; i < number; ++i) list.push_back(entry(field));
      json[name] = std::move(list);
    }
    return json;
  }

 private:
  Json entry(const MessageField& field) {
    switch (field.type) {
      case FieldType::boolean_field:
        return take(1) != 0;
      case FieldType::int8_t_field:
        return static_cast<std::int8_t>(take(1));
      case FieldType::int16_t_field:
        return static_cast<std::int16_t>(take(2));
      case FieldType::int32_t_field:
        return static_cast<std::int32_t>(take(4));
      case FieldType::int64_t_field:
        return static_cast<std::int64_t>(take(8));
      case FieldType::float_field:
        return std::bit_cast<float>(static_cast<std::uint32_t>(take(4)));
      case FieldType::double_field:
        return std::bit_cast<double>(take(8));
      case FieldType::string_field:
        return text();
      case FieldType::message_field:
        return fields(field.fields);
    }
    return nullptr;
  }

  Json text() {
    const std::size_t length = take(4);
    const std::string text(reinterpret_cast<const char*>(rest_.data()), length - 1);
    rest_ = rest_.subspan(length);
    return text;
  }

  std::uint64_t take(std::size_t size) {
    const std::uint64_t value = big_endian(rest_.first(size));
    rest_ = rest_.subspan(size);
    return value;
  }

  std::span<const std::uint8_t> rest_;
};

template <class Message>
bool is_whole(const LogEvent& event) {
  return event.channel == name_of(channel_of<Message>) && event.data.size() > fingerprint_bytes &&
         big_endian(std::span(event.data).first(fingerprint_bytes)) == static_cast<std::uint64_t>(Message::getHash()) &&
         layout_fault(layout<Message>, event.data).empty();
}

}  // namespace

std::filesystem::path record_file(const std::filesystem::path& run) {
  if (std::filesystem::is_regular_file(run)) return run;
  if (std::filesystem::is_regular_file(run / run_files::record)) return run / run_files::record;
  throw std::invalid_argument(
      fmt::format("{}: must be a folder that `talus run` left, or an LCM event log", run.string()));
}

void refuse_own_file(const std::filesystem::path& run, const std::string& out) {
  namespace fs = std::filesystem;
  std::error_code unused;
  const fs::path record = record_file(run);
  const fs::path target = fs::weakly_canonical(out, unused);  // what a link leads to
  const bool in_run_folder = fs::exists(target.parent_path() / run_files::record, unused);
  const bool own = fs::equivalent(out, record, unused) ||
                   (in_run_folder && std::ranges::find(run_files::all, target.filename()) != run_files::all.end());
  if (own)
    throw std::invalid_argument(
        fmt::format("--out = {}: must be none of the files that a run left in its folder", out));
}

std::invalid_argument no_event_log(const std::filesystem::path& file) {
  return std::invalid_argument(
      fmt::format("{}: must be a folder that `talus run` left, or an LCM event log, but no event is in its {} bytes",
                  file.string(), std::filesystem::file_size(file)));
}

bool is_event_log(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 4> begin{};
  return in.read(begin.data(), begin.size()) && std::string_view(begin.data(), begin.size()) == "\xED\xA1\xDA\x01";
}

void OneRun::see(const LogEvent& event, const std::filesystem::path& file) {
  if (!is_of_run(event)) return;
  const std::int64_t run = header_of(event).run_id;
  if (run_.value_or(run) != run) {
    throw std::invalid_argument(fmt::format(
        "{}: holds the runs {} and {}: must be of one run; `talus info --repair --run {} --out FOLDER` takes "
        "one of them out",
        file.string(), short_id(*run_), short_id(run), short_id(*run_)));
  }
  run_ = run;
}

void refuse_other_format(const LogEvent& event, const std::filesystem::path& file) {
  try {
    if (const auto channel = channel_named(event.channel)) refuse_other_format(*channel, event.data);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", file.string(), error.what()));
  }
}

bool is_of_run(const LogEvent& event) {
  return channel_named(event.channel).has_value() && event.data.size() >= header_bytes;
}

MessageHeader header_of(const LogEvent& event) {
  const auto number = [&](std::size_t field) {
    return big_endian(std::span(event.data).subspan(fingerprint_bytes + 8 * field, 8));
  };
  return {.utime = static_cast<std::int64_t>(number(0)),
          .run_id = static_cast<std::int64_t>(number(1)),
          .step = static_cast<std::int64_t>(number(2)),
          .time = std::bit_cast<double>(number(3)),
          .seq = static_cast<std::int64_t>(number(4))};
}

Json message_json(const LogEvent& event) {
#define TALUS_JSON(Message)     \
  if (is_whole<Message>(event)) \
    return FieldReader(std::span(event.data).subspan(fingerprint_bytes)).fields(layout<Message>);
  TALUS_EACH_MESSAGE(TALUS_JSON)
#undef TALUS_JSON
  return nullptr;
}

}  // namespace talus
