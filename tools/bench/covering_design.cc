#include "tools/bench/covering_design.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

#include "common/math/random.h"

namespace talus {
namespace {

using DesignRow = std::vector<int>;
constexpr int undecided = -1;

/// Number from 0 to below `count`.
std::size_t draw_below(std::mt19937_64& random, std::size_t count) {
  return static_cast<std::size_t>(uniform(random) * static_cast<double>(count));
}

struct FactorPair {
  std::size_t first = 0;
  int first_value = 0;
  std::size_t second = 0;
  int second_value = 0;
};

/// How often each pair of values occurs so far.
class PairCounts {
 public:
  explicit PairCounts(std::span<const int> values) : values_(values.begin(), values.end()) {
    for (std::size_t f = 0; f < values.size(); ++f) {
      if (values[f] < 1) throw std::invalid_argument("covering_design: each factor must have a value");
      first_.push_back(f == 0 ? 0 : first_.back() + values[f - 1]);
    }
    size_ = static_cast<std::size_t>(std::accumulate(values.begin(), values.end(), 0));
    counts_.assign(size_ * size_, 0);
  }

  void add(const DesignRow& row) {
    for (std::size_t a = 0; a < row.size(); ++a)
      for (std::size_t b = 0; b < row.size(); ++b) ++counts_[entry(a, row[a], b, row[b])];
  }

  /// Worth of a pair: one that does not occur yet outweighs any number of those that do.
  double worth(std::size_t a, int value_a, std::size_t b, int value_b) const {
    return std::pow(0.01, counts_[entry(a, value_a, b, value_b)]);
  }

  /// Sum over the pairs of `value` of factor `a` with what the row has decided.
  double worth_in(const DesignRow& row, std::size_t a, int value) const {
    double sum = 0.0;
    for (std::size_t b = 0; b < row.size(); ++b)
      if (b != a && row[b] != undecided) sum += worth(a, value, b, row[b]);
    return sum;
  }

  /// Pairs that occur least.
  std::vector<FactorPair> rarest() const {
    int least = std::numeric_limits<int>::max();
    std::vector<FactorPair> found;
    for (std::size_t a = 0; a < values_.size(); ++a) {
      for (std::size_t b = a + 1; b < values_.size(); ++b) {
        for (int i = 0; i < values_[a]; ++i) {
          for (int j = 0; j < values_[b]; ++j) {
            const int count = counts_[entry(a, i, b, j)];
            if (count < least) found.clear();
            least = std::min(least, count);
            if (count == least) found.push_back({a, i, b, j});
          }
        }
      }
    }
    return found;
  }

 private:
  std::size_t entry(std::size_t a, int value_a, std::size_t b, int value_b) const {
    return static_cast<std::size_t>(first_[a] + value_a) * size_ + static_cast<std::size_t>(first_[b] + value_b);
  }

  std::vector<int> values_;
  std::vector<int> first_;  // number of each factor's first value
  std::size_t size_ = 0;    // values of all factors
  std::vector<int> counts_;
};

DesignRow candidate_row(std::span<const int> values, const PairCounts& counts, const FactorPair& start,
                        std::mt19937_64& random) {
  DesignRow row(values.size(), undecided);
  row[start.first] = start.first_value;
  row[start.second] = start.second_value;
  std::vector<std::size_t> open;
  for (std::size_t f = 0; f < values.size(); ++f)
    if (row[f] == undecided) open.push_back(f);
  while (!open.empty()) {
    const std::size_t place = draw_below(random, open.size());
    const std::size_t factor = open[place];
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(place));
    double best = -1.0;
    const auto first = static_cast<int>(draw_below(random, static_cast<std::size_t>(values[factor])));  // of equals
    for (int k = 0; k < values[factor]; ++k) {
      const int value = (first + k) % values[factor];
      const double worth = counts.worth_in(row, factor, value);
      if (worth <= best) continue;
      best = worth;
      row[factor] = value;
    }
  }
  return row;
}

}  // namespace

std::vector<std::vector<int>> covering_design(std::span<const int> values, int rows, std::uint64_t seed) {
  constexpr int candidates = 50;
  if (values.size() < 2) throw std::invalid_argument("covering_design: must have two factors or more");
  std::mt19937_64 random(seed);
  PairCounts counts(values);
  std::vector<DesignRow> design;
  while (static_cast<int>(design.size()) < rows) {
    const std::vector<FactorPair> rarest = counts.rarest();
    DesignRow best;
    double best_worth = -1.0;
    for (int k = 0; k < candidates; ++k) {
      const DesignRow row = candidate_row(values, counts, rarest[draw_below(random, rarest.size())], random);
      double worth = 0.0;
      for (std::size_t f = 0; f < row.size(); ++f) worth += counts.worth_in(row, f, row[f]);
      if (worth <= best_worth) continue;
      best_worth = worth;
      best = row;
    }
    counts.add(best);
    design.push_back(best);
  }
  return design;
}

}  // namespace talus
