#include "tools/view/page.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "common/scene/reference.h"
#include "common/text/base64.h"
#include "tools/output/json_text.h"
#include "tools/run/data_folder.h"
#include "tools/view/page_settings.h"

namespace talus {
namespace {

std::string deflated(std::string_view bytes) {
  std::string result(compressBound(bytes.size()), '\0');
  uLongf size = result.size();
  const int status = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw std::runtime_error(fmt::format("zlib: error {}", status));
  result.resize(size);
  return result;
}

std::string built_file(const char* name) {
  const std::filesystem::path file = data_folder("page") / name;
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::system_error(errno, std::generic_category(), file.string());
  return text.str();
}

void put(std::string& page, std::string_view mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error(fmt::format("page.html has no mark \"{}\"", mark));
  page.replace(at, mark.size(), text);
}

/// JSON that ends no script, whatever texts are in it.
std::string in_script(const nlohmann::ordered_json& data) {
  std::string text = json_text(data);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

std::string data_in_page(const char* id, const nlohmann::ordered_json& data) {
  return fmt::format(R"(<script type="application/json" id="{}">{}</script>)", id, in_script(data));
}

std::string built_script(const char* name) { return "<script>\n" + built_file(name) + "</script>"; }

/// `source`: whether the page shows a "run" or a "record", and the name of that; `more`: what else that kind needs.
std::string page_of(const nlohmann::ordered_json& source, const std::string& more) {
  std::string page = built_file("page.html");
  put(page, "<!-- vendor -->", built_script("vendor.js"));
  put(page, "<!-- data -->", data_in_page("settings", page_settings()) + data_in_page("source", source) + more);
  return page;
}

}  // namespace

std::string page_with(std::string_view log, const std::string& name) {
  return page_of({{"kind", "record"}, {"name", name}},
                 R"(<script type="application/octet-stream" id="log">)" + base64(deflated(log)) + "</script>");
}

std::string page_of_pair(const PairTexts& texts) {
  std::string page = built_file("pair.html");
  put(page, "<!-- vendor -->", built_script("vendor.js"));
  nlohmann::ordered_json data = {{"of_runs", texts.of_runs}, {"ms_per_step", texts.ms_per_step}};
  data["differences"] = nlohmann::ordered_json::array();
  for (const SettingDifference& each : texts.differences) data["differences"].push_back({each.path, each.a, each.b});
  put(page, "<!-- data -->", data_in_page("settings", page_settings()) + data_in_page("pair-data", data));
  return page;
}

std::string page_of_run() {
  return page_of({{"kind", "run"}}, data_in_page("keys-data", key_tables()) + built_script("editor.js"));
}

std::string page_of_record(const std::string& name) { return page_of({{"kind", "record"}, {"name", name}}, ""); }

}  // namespace talus
