#pragma once
// The names that docs/files.md documents, and those that a program wrote.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace talus {

using Names = std::set<std::string>;

/// A row "| `b.*` | as `a.*` ... |" documents a name "b.NAME" for each "a.NAME".
inline void add_alike(const std::string& row, Names& names) {
  const std::string prefix = row.substr(3, row.find(".*`") - 2);
  const std::size_t begin = row.find("`", row.find("| as `")) + 1;
  const std::string other = row.substr(begin, row.find(".*`", begin) - begin + 1);
  Names alike;
  for (const std::string& name : names)
    if (name.starts_with(other)) alike.insert(prefix + name.substr(other.size()));
  names.merge(alike);
}

/// The first cells of the tables under a heading "## HEADING" of docs/files.md.
inline Names documented(const std::string& heading) {
  std::ifstream page(std::string(TALUS_SOURCE_DIR) + "/docs/files.md");
  Names names;
  std::vector<std::string> alike;
  bool within = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) within = line == "## " + heading;
    if (!within || !line.starts_with("| `")) continue;
    if (line.find(".*` | as `") != std::string::npos)
      alike.push_back(line);
    else
      names.insert(line.substr(3, line.find('`', 3) - 3));
  }
  for (const std::string& row : alike) add_alike(row, names);
  return names;
}

/// Adds the paths of all plain values: "shape.r50_m", "piles[].layers".
inline void collect(const nlohmann::json& value, const std::string& path, Names& names) {
  if (value.is_object())
    for (const auto& [key, child] : value.items()) collect(child, path.empty() ? key : path + "." + key, names);
  else if (value.is_array())
    for (const nlohmann::json& child : value) collect(child, path + "[]", names);
  else
    names.insert(path);
}

/// Those of `names` that `others` lacks.
inline std::string missing(const Names& names, const Names& others) {
  std::string list;
  for (const std::string& name : names)
    if (!others.contains(name)) list += name + " ";
  return list;
}

/// A table documents what was written, no more and no less.
inline void expect_documented(const Names& written, const std::string& heading) {
  EXPECT_EQ(missing(written, documented(heading)), "") << "written, but not in docs/files.md under " << heading;
  EXPECT_EQ(missing(documented(heading), written), "") << "in docs/files.md under " << heading << ", but not written";
}

}  // namespace talus
