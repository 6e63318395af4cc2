#include "tests/tools/manual_page.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/process/process.h"

namespace talus {
namespace {

const std::filesystem::path root = TALUS_SOURCE;

/// "command   # comment" without the comment.
std::string without_comment(const std::string& line) {
  const std::string text = line.substr(0, line.find(" #"));
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// The file that a line before a TOML block names: "Save this as `discs.toml`:".
std::string file_named_in(const std::string& line) {
  std::smatch match;
  return std::regex_search(line, match, std::regex("`([a-z0-9_]+\\.toml)`:$")) ? match[1].str() : "";
}

/// Takes the lines of a page one by one.
class PageReader {
 public:
  explicit PageReader(const std::string& name) { page_.name = name; }

  void take(const std::string& line) {
    ++number_;
    if (line.starts_with("```")) {
      language_ = inside_ ? "" : line.substr(3);
      inside_ = !inside_;
    } else if (inside_) {
      take_inside(line);
    } else {
      take_text(line);
    }
  }

  ManualPage finish() {
    const std::regex command("`((talus|\\./dev) [^`]*)`");
    for (std::sregex_iterator match(text_.begin(), text_.end(), command); match != std::sregex_iterator(); ++match)
      page_.inline_commands.push_back({page_.name, (*match)[1]});
    return page_;
  }

 private:
  void take_inside(const std::string& line) {
    const std::string place = page_.name + ":" + std::to_string(number_);
    if (language_ == "sh") page_.commands.push_back({place, without_comment(line)});
    if (language_ == "toml" && !file_.empty()) page_.files[file_] += line + "\n";
    if (language_.empty()) page_.outside.push_back({place, "block without a language: " + line});
  }

  void take_text(const std::string& line) {
    static const std::regex command("    (talus|\\./dev|cmake|ctest|bash|sh) .*");
    if (std::regex_match(line, command)) page_.outside.push_back({page_.name + ":" + std::to_string(number_), line});
    text_ += line + " ";
    if (!line.empty()) file_ = file_named_in(line);
  }

  ManualPage page_;
  std::string text_;
  std::string file_;
  std::string language_;
  bool inside_ = false;
  int number_ = 0;
};

}  // namespace

ManualPage read_page(const std::string& name) {
  PageReader reader(name);
  std::istringstream lines(contents(root / name));
  for (std::string line; std::getline(lines, line);) reader.take(line);
  return reader.finish();
}

std::vector<std::string> page_names() {
  std::vector<std::string> names = {"README.md", "CONTRIBUTING.md"};
  for (const auto& entry : std::filesystem::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") names.push_back("docs/" + entry.path().filename().string());
  std::sort(names.begin() + 2, names.end());
  return names;
}

}  // namespace talus
