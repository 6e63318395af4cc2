#include "tools/view/merge_blocks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "tools/view/stream_numbers.h"

namespace talus {
namespace {

using Numbers = std::vector<std::uint64_t>;

/// Flags that a block turns over: those that both turn over stay as they were.
Numbers either(const Numbers& a, const Numbers& b) {
  Numbers result;
  std::ranges::set_symmetric_difference(a, b, std::back_inserter(result));
  return result;
}

/// What one block changes, as FrameEncoder describes it.
template <int Dim>
class BlockChanges {
 public:
  explicit BlockChanges(std::string_view block);

  /// Adds what the block after this one changes.
  void follow(BlockChanges next);
  std::string written() const;

 private:
  static constexpr int components = Dim == 2 ? 3 : 7;
  struct Move {
    std::uint64_t number = 0;
    std::array<std::int64_t, components> change{};
  };
  using Moves = std::vector<Move>;  // by number
  struct Event {
    std::uint64_t body = 0;
    std::uint64_t age = 0;  // steps before that of the block
    std::array<std::uint64_t, 3> rest{};
    float score = 0.0F;
  };
  struct PileChange {
    std::vector<float> form;  // empty: as before
    std::vector<std::int64_t> counts;
  };
  struct WarningText {
    std::uint64_t step = 0;
    std::string text;
  };

  static Moves read_moves(StreamReader& in);
  void read_events(StreamReader& in);
  void read_piles(StreamReader& in);
  static void write_moves(std::string& out, const Moves& moves);
  void write_piles(std::string& out) const;
  static void add(Moves& moves, const Moves& more);

  std::uint64_t step_ = 0;
  Numbers shapes_;                // of the new bodies
  std::array<Numbers, 3> flags_;  // removed, asleep, hidden
  Moves moved_;
  std::vector<Event> events_;
  std::uint64_t piles_ = 0;
  std::map<std::uint64_t, PileChange> changed_piles_;
  std::array<float, 4> measured_{};
  std::map<std::uint64_t, WarningText> warnings_;
  std::vector<std::pair<std::uint64_t, float>> scene_events_;
  Moves obstacles_;
};

Numbers read_list(StreamReader& in) {
  Numbers list(in.number());
  auto number = static_cast<std::uint64_t>(-1);
  for (std::uint64_t& each : list) each = number += in.number();
  return list;
}

template <class Range, class NumberOf>
void write_list(std::string& out, const Range& range, NumberOf number_of) {
  write_unsigned(out, range.size());
  auto before = static_cast<std::uint64_t>(-1);
  for (const auto& each : range) write_unsigned(out, number_of(each) - std::exchange(before, number_of(each)));
}

template <int Dim>
BlockChanges<Dim>::BlockChanges(std::string_view block) {
  StreamReader in(block);
  step_ = in.number();
  shapes_.resize(in.number());
  for (std::uint64_t& shape : shapes_) shape = in.number();
  for (Numbers& flags : flags_) flags = read_list(in);
  moved_ = read_moves(in);
  read_events(in);
  read_piles(in);
  for (float& value : measured_) value = in.real();
  for (std::uint64_t left = in.number(); left > 0; --left) {
    const std::uint64_t kind = in.number();
    const std::uint64_t step = in.number();
    warnings_[kind] = {step, in.text(in.number())};
  }
  for (std::uint64_t left = in.number(); left > 0; --left) {
    const std::uint64_t number = in.number();
    scene_events_.emplace_back(number, in.real());
  }
  obstacles_ = read_moves(in);
}

template <int Dim>
typename BlockChanges<Dim>::Moves BlockChanges<Dim>::read_moves(StreamReader& in) {
  Moves moves;
  for (const std::uint64_t number : read_list(in)) moves.push_back({number});
  for (int i = 0; i < components; ++i)
    for (Move& move : moves) move.change[i] = in.difference();
  return moves;
}

template <int Dim>
void BlockChanges<Dim>::read_events(StreamReader& in) {
  events_.resize(in.number());
  for (Event& event : events_) {
    event.body = in.number();
    event.age = in.number();
    for (std::uint64_t& number : event.rest) number = in.number();
    event.score = in.real();
  }
}

template <int Dim>
void BlockChanges<Dim>::read_piles(StreamReader& in) {
  piles_ = in.number();
  for (std::uint64_t left = in.number(); left > 0; --left) {
    PileChange& pile = changed_piles_[in.number()];
    pile.form.resize(in.number());
    for (float& value : pile.form) value = in.real();
    pile.counts.resize(in.number());
    for (std::int64_t& count : pile.counts) count = in.difference();
  }
}

template <int Dim>
void BlockChanges<Dim>::add(Moves& moves, const Moves& more) {
  Moves all;
  std::ranges::merge(moves, more, std::back_inserter(all), {}, &Move::number, &Move::number);
  moves.clear();
  for (const Move& move : all)
    if (moves.empty() || moves.back().number != move.number)
      moves.push_back(move);
    else
      std::ranges::transform(moves.back().change, move.change, moves.back().change.begin(), std::plus());
}

template <int Dim>
void BlockChanges<Dim>::follow(BlockChanges next) {
  for (Event& event : events_) event.age += next.step_ - step_;
  step_ = next.step_;
  shapes_.insert(shapes_.end(), next.shapes_.begin(), next.shapes_.end());
  for (std::size_t i = 0; i < flags_.size(); ++i) flags_[i] = either(flags_[i], next.flags_[i]);
  add(moved_, next.moved_);
  events_.insert(events_.end(), next.events_.begin(), next.events_.end());
  piles_ = next.piles_;
  std::erase_if(changed_piles_, [&](const auto& pile) { return pile.first >= piles_; });
  for (auto& [number, change] : next.changed_piles_) {
    const auto [known, fresh] = changed_piles_.try_emplace(number);
    PileChange& pile = known->second;
    if (fresh || !change.form.empty())
      pile = std::move(change);
    else
      std::ranges::transform(pile.counts, change.counts, pile.counts.begin(), std::plus());
  }
  measured_ = next.measured_;
  for (auto& [kind, warning] : next.warnings_) warnings_[kind] = std::move(warning);
  scene_events_.insert(scene_events_.end(), next.scene_events_.begin(), next.scene_events_.end());
  add(obstacles_, next.obstacles_);
}

template <int Dim>
std::string BlockChanges<Dim>::written() const {
  std::string out;
  write_unsigned(out, step_);
  write_unsigned(out, shapes_.size());
  for (const std::uint64_t shape : shapes_) write_unsigned(out, shape);
  for (const Numbers& flags : flags_) write_list(out, flags, [](std::uint64_t number) { return number; });
  write_moves(out, moved_);
  write_unsigned(out, events_.size());
  for (const Event& event : events_) {
    write_unsigned(out, event.body);
    write_unsigned(out, event.age);
    for (const std::uint64_t number : event.rest) write_unsigned(out, number);
    write_float(out, event.score);
  }
  write_piles(out);
  for (const float value : measured_) write_float(out, value);
  write_unsigned(out, warnings_.size());
  for (const auto& [kind, warning] : warnings_) {
    for (const std::uint64_t number : {kind, warning.step, warning.text.size()}) write_unsigned(out, number);
    out += warning.text;
  }
  write_unsigned(out, scene_events_.size());
  for (const auto& [number, time] : scene_events_) {
    write_unsigned(out, number);
    write_float(out, time);
  }
  write_moves(out, obstacles_);
  return out;
}

template <int Dim>
void BlockChanges<Dim>::write_moves(std::string& out, const Moves& moves) {
  write_list(out, moves, [](const Move& move) { return move.number; });
  for (int i = 0; i < components; ++i)
    for (const Move& move : moves) write_signed(out, move.change[i]);
}

template <int Dim>
void BlockChanges<Dim>::write_piles(std::string& out) const {
  write_unsigned(out, piles_);
  write_unsigned(out, changed_piles_.size());
  for (const auto& [number, pile] : changed_piles_) {
    write_unsigned(out, number);
    write_unsigned(out, pile.form.size());
    for (const float value : pile.form) write_float(out, value);
    write_unsigned(out, pile.counts.size());
    for (const std::int64_t count : pile.counts) write_signed(out, count);
  }
}

}  // namespace

template <int Dim>
std::string merge_blocks(std::string_view first, std::string_view second) {
  BlockChanges<Dim> both(first);
  both.follow(BlockChanges<Dim>(second));
  return both.written();
}

template std::string merge_blocks<2>(std::string_view, std::string_view);
template std::string merge_blocks<3>(std::string_view, std::string_view);

}  // namespace talus
