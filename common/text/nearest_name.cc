#include "common/text/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace talus {
namespace {

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool contains(std::string_view longer, std::string_view shorter) {
  return shorter.size() >= 3 &&
         std::search(longer.begin(), longer.end(), shorter.begin(), shorter.end(), same_letter) != longer.end();
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // Rows of the table of edit distances between prefixes of a and b: this one, the last, the one before.
  std::vector<int> row(b.size() + 1), last(b.size() + 1), before_last(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = same_letter(a[i - 1], b[j - 1]) ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest_name(std::string_view name, std::span<const std::string> known) {
  std::string nearest;
  int least = std::max(1, static_cast<int>(name.size()) / 3) + 1;
  for (const std::string& candidate : known) {
    // Cost is the product of both lengths; a name of a megabyte is no typing error.
    const int distance = name.size() > 100 ? least : edit_distance(name, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  if (nearest.empty()) {
    const auto part = std::find_if(known.begin(), known.end(), [&](const std::string& candidate) {
      return contains(name, candidate) || contains(candidate, name);
    });
    nearest = part == known.end() ? "" : *part;
  }
  return nearest;
}

}  // namespace talus
