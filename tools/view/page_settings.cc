#include "tools/view/page_settings.h"

#include <fmt/format.h>

#include "common/policy/sleep_event.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/layout.h"
#include "tools/picture/picture_params.h"
#include "tools/run/version.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of_type(FieldType type) {
  switch (type) {
    case FieldType::boolean_field:
      return "boolean";
    case FieldType::int8_t_field:
      return "int8_t";
    case FieldType::int16_t_field:
      return "int16_t";
    case FieldType::int32_t_field:
      return "int32_t";
    case FieldType::int64_t_field:
      return "int64_t";
    case FieldType::float_field:
      return "float";
    case FieldType::double_field:
      return "double";
    case FieldType::string_field:
      return "string";
    case FieldType::message_field:
      return "message";
  }
  return "";
}

Json fields_json(std::span<const MessageField> fields) {
  Json list = Json::array();
  for (const MessageField& field : fields) {
    Json& json = list.emplace_back(Json{{"name", field.name}, {"type", name_of_type(field.type)}});
    if (field.count_field >= 0) json["count"] = fields[field.count_field].name;
    if (field.count_field < 0 && field.number != 1) json["count"] = field.number;
    if (!field.fields.empty()) json["fields"] = fields_json(field.fields);
  }
  return list;
}

template <class Message>
Json type_json() {
  return {{"fingerprint", fmt::format("{:016x}", static_cast<std::uint64_t>(Message::getHash()))},
          {"fields", fields_json(layout<Message>)}};
}

Json channels_json() {
  Json channels;
#define TALUS_CHANNEL_JSON(Message) channels[name_of(channel_of<Message>)] = type_json<Message>();
  TALUS_EACH_MESSAGE(TALUS_CHANNEL_JSON)
#undef TALUS_CHANNEL_JSON
  return channels;
}

Json json_of(const Colour& colour) { return Json::array({colour.red, colour.green, colour.blue}); }

Json colours_json(const PictureParams& params) {
  Json awake = Json::array();
  for (const Colour& colour : params.awake) awake.push_back(json_of(colour));
  return {{"paper", json_of(params.paper)},
          {"text", json_of(params.text)},
          {"quiet_text", json_of(params.quiet_text)},
          {"asleep", json_of(params.asleep)},
          {"asleep_outline", json_of(params.asleep_outline)},
          {"awake", awake},
          {"awake_outline", json_of(params.awake_outline)},
          {"layer", json_of(params.layer)},
          {"obstacle", json_of(params.obstacle)},
          {"obstacle_outline", json_of(params.obstacle_outline)},
          {"ground", json_of(params.ground)},
          {"sleep_shade", params.sleep_shade}};
}

}  // namespace

Json page_settings() {
  const PictureParams params;
  return {{"format", talus_lcm::talus_run::FORMAT},
          {"version", version_text()},
          {"channels", channels_json()},
          {"causes", cause_names()},
          {"colours", colours_json(params)},
          {"camera", {{"azimuth", params.azimuth}, {"elevation", params.elevation}}}};
}

}  // namespace talus
