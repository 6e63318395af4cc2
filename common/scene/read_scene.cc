#include "common/scene/read_scene.h"

#include <cctype>
#include <fstream>
#include <utility>

#include "common/scene/read_root.h"
#include "common/scene/table_reader.h"
#include "common/scene/text_limits.h"
#include "common/scene/toml_text.h"

namespace talus {
namespace {

struct Reading {
  AnyScene scene;
  Findings findings;
};

template <int Dim>
Reading read_as(const toml::table& table, const Findings& before) {
  Reading reading{Scene<Dim>(), before};
  TableReader::read_root(table, reading.findings, [&](TableReader& root) { reading.scene = read_root<Dim>(root); });
  return reading;
}

// As what the file says it is. If it does not say so, as the one in which it makes more sense, so that its other
// errors can be told as well.
Reading read_table(const toml::table& table, const Findings& before) {
  const auto* written = table["dimension"].as_integer();
  const std::int64_t dimension = written == nullptr ? 0 : **written;
  if (dimension == 2) {
    return read_as<2>(table, before);
  }
  if (dimension == 3) {
    return read_as<3>(table, before);
  }
  Reading flat = read_as<2>(table, before);
  Reading full = read_as<3>(table, before);
  return std::move(flat.findings.errors.size() < full.findings.errors.size() ? flat : full);
}

toml::table parse(std::string_view text, std::string_view file_name) {
  check_scene_text(text, std::string(file_name));
  try {
    return toml::parse(text, file_name);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw SceneErrors({{std::string(file_name), static_cast<int>(at.line), static_cast<int>(at.column), "", "",
                        std::string(error.description()), ""}});
  }
}

// Of a file that is too large no more than shows it: it may be a device that never ends.
std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code unused;
  if (!stream || std::filesystem::is_directory(file, unused)) {
    throw SceneErrors({{file.string(), 0, 0, "", "", "no such file, or it cannot be read", ""}});
  }
  const auto size = std::filesystem::file_size(file, unused);
  if (!unused) check_scene_text_size(size, file.string());
  std::string text(max_scene_text + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

// Comments are kept where nothing had to be put in.
std::string as_run(std::string_view text, const toml::table& table, std::span<const Override> overrides) {
  if (overrides.empty()) {
    return std::string(text);
  }
  std::string as_toml;
  for (const Override& one : overrides) {
    std::string comment = one.text;
    std::erase_if(comment, [](unsigned char letter) { return std::iscntrl(letter) != 0; });
    as_toml += "# --set " + comment + "\n";
  }
  return as_toml + document_text(table);
}

}  // namespace

AnyScene parse_scene(std::string_view text, std::string_view file_name, std::span<const Override> overrides) {
  toml::table table = parse(text, file_name);
  Findings findings;
  findings.file = file_name;
  apply_overrides(table, overrides, findings.errors);
  Reading reading = read_table(table, findings);
  if (!reading.findings.errors.empty()) {
    throw SceneErrors(std::move(reading.findings.errors));
  }
  std::visit(
      [&](auto& scene) {
        scene.toml = as_run(text, table, overrides);
        check_scene_text(scene.toml, "the scene with the values of --set");
        scene.folder = std::filesystem::path(file_name).parent_path();
        scene.referred = reading.findings.referred;
        scene.reader_warnings = reading.findings.warnings;
      },
      reading.scene);
  return std::move(reading.scene);
}

AnyScene read_scene(const std::filesystem::path& file, std::span<const Override> overrides) {
  return parse_scene(contents(file), file.string(), overrides);
}

std::set<std::string> keys_looked_for(std::string_view text) {
  Findings findings;
  findings.file = "text";
  findings.keys_wanted = true;
  return read_table(parse(text, "text"), findings).findings.keys;
}

}  // namespace talus
