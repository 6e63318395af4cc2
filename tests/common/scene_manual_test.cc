#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "common/scene/read_scene.h"
#include "common/scene/read_shape.h"
#include "common/scene/reference.h"
#include "tests/common/scene_description.h"

namespace talus::scene_manual_test {
namespace {

std::vector<std::string> manual() {
  std::ifstream stream(std::filesystem::path(TALUS_SOURCE_DIR) / "docs" / "scenes.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// What stands between back quotes in a text.
std::vector<std::string> quoted_in(const std::string& text) {
  std::vector<std::string> names;
  std::size_t start = text.find('`');
  std::size_t end = text.find('`', start + 1);
  while (start != std::string::npos && end != std::string::npos) {
    names.push_back(text.substr(start + 1, end - start - 1));
    start = text.find('`', end + 1);
    end = text.find('`', start + 1);
  }
  return names;
}

// Keys of the tables under each `## ... HEAD` of the manual, as "HEAD key".
std::set<std::string> keys_of_the_manual() {
  std::set<std::string> keys;
  std::string section;
  for (const std::string& line : manual()) {
    if (line.starts_with("## "))
      section = line.ends_with("`") ? quoted_in(line).back() : "";
    else if (!section.empty() && line.starts_with("| `"))
      for (const std::string& name : quoted_in(line.substr(0, line.find(" |", 2)))) keys.insert(section + " " + name);
  }
  return keys;
}

// `source[].rate` as the manual has it: "[[source]] rate".
std::string in_manual(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  if (dot == std::string::npos) return "root " + key;
  std::string head = key.substr(0, dot);
  if (head == "pile[].boundary")
    head = "[pile.boundary]";
  else if (head == "obstacle[].motion")
    head = "[obstacle.motion]";
  else if (head == "source[].scale")
    head = "[source.scale]";
  else if (head == "shape.*.parts[]")
    head = "[shape.NAME]";  // under one heading with it
  else if (head == "shape.*")
    head = "[shape.NAME]";
  else if (head.ends_with("[]"))
    head = "[[" + head.substr(0, head.size() - 2) + "]]";
  else
    head = "[" + head + "]";
  return head + " " + key.substr(dot + 1);
}

// All that the reader looks for, whatever the dimension and the kinds.
template <int Dim>
std::set<std::string> keys_of_the_reader() {
  std::string text = "dimension = " + std::to_string(Dim) +
                     "\nsource = [{angle_deg = 0, scale = {}}]\n"
                     "body = [{angle_deg = 0}]\nevent = [{}]\ngate = [{}, {corners = []}]\nregion = [{}]\n"
                     "load = [{}]\n";
  std::string shapes;
  std::string obstacles = "{kind = \"container\"}";
  for (const std::string& kind : names_of_shape_kinds<Dim>()) {
    shapes += "[shape." + kind + "]\nkind = \"" + kind + "\"\n";
    obstacles += ", {kind = \"" + kind + "\", angle_deg = 0}";
  }
  obstacles += ", {kind = \"container\", radius = 1}, {kind = \"container\", corners = []}";
  for (const char* motion : {"sine", "turn", "path", "belt"})
    obstacles += fmt::format(", {{kind = \"container\", motion = {{kind = \"{}\"}}}}", motion);
  text += "obstacle = [" + obstacles + "]\n";
  text +=
      "pile = [{boundary = {kind = \"box\"}}, {boundary = {kind = \"cylinder\"}}, {boundary = {kind = \"convex\"}}]\n";
  text += shapes;
  text += "[shape.compound]\nkind = \"compound\"\nparts = [{shape = \"ball\", angle_deg = 0}]\n";
  std::set<std::string> keys = keys_looked_for(text);
  for (const char* motion : {"sine", "turn", "path"})
    keys.merge(keys_looked_for(fmt::format("dimension = {}\nworld.gravity_motion = {{kind = \"{}\"}}\n", Dim, motion)));
  return keys;
}

std::set<std::string> keys_of_the_reader() {
  std::set<std::string> keys = keys_of_the_reader<2>();
  keys.merge(keys_of_the_reader<3>());
  return keys;
}

TEST(Manual, HasEveryKeyThatTheReaderKnows) {
  const std::set<std::string> documented = keys_of_the_manual();
  const std::set<std::string> keys = keys_of_the_reader();
  EXPECT_GT(keys.size(), 60u);
  for (const std::string& key : keys) {
    const std::string name = key.substr(key.rfind('.') + 1);
    const bool of_a_kind = key.starts_with("obstacle[].") && documented.contains("[shape.NAME] " + name);
    EXPECT_TRUE(documented.contains(in_manual(key)) || of_a_kind) << key << " is not in docs/scenes.md";
  }
}

TEST(Manual, HasNoKeyThatTheReaderDoesNotKnow) {
  std::set<std::string> known;
  for (const std::string& key : keys_of_the_reader()) known.insert(in_manual(key));
  for (const std::string& key : keys_of_the_manual())
    EXPECT_TRUE(known.contains(key)) << key << " of docs/scenes.md is unknown to the reader";
}

// The TOML blocks of the manual.
std::vector<std::string> examples() {
  std::vector<std::string> blocks;
  bool inside = false;
  for (const std::string& line : manual()) {
    if (line == "```toml") {
      inside = true;
      blocks.emplace_back();
    } else if (line.starts_with("```")) {
      inside = false;
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

TEST(Manual, HasTheTablesThatTheDeclarationsGive) {
  const std::string document = fmt::format("{}\n", fmt::join(manual(), "\n"));
  EXPECT_EQ(document, with_reference(document))
      << "docs/scenes.md is not up to date; this command writes it: talus reference --update docs/scenes.md";
}

TEST(Manual, RefusesAMarkWithoutItsEndOrItsTableAndATextWithoutMarks) {
  EXPECT_EQ(with_reference("a\n<!-- keys: [run] -->\nold\n<!-- end -->\nb\n").find("old"), std::string::npos);
  EXPECT_THROW(with_reference("a\n"), std::invalid_argument);
  EXPECT_THROW(with_reference("<!-- keys: [run] -->\n"), std::invalid_argument);
  EXPECT_THROW(with_reference("<!-- end -->\n"), std::invalid_argument);
  EXPECT_THROW(with_reference("<!-- keys: [runs] -->\n<!-- end -->\n"), std::invalid_argument);
}

TEST(Manual, GivesTheDefaultsThatTheReaderHas) {
  ASSERT_FALSE(examples().empty());
  const std::string example = examples().front();
  const std::vector<Override> rings = {{"policy.adaptive.rings=1"}};  // by default the accuracy sets them
  const Scene<2> shortest = std::get<Scene<2>>(parse_scene(example, "example", rings));
  const std::string filled = with_every_default(example, "example");
  const Scene<2> written_out = std::get<Scene<2>>(parse_scene(filled, "example with every default", rings));
  EXPECT_EQ(description(shortest), description(written_out));
}

}  // namespace
}  // namespace talus::scene_manual_test
