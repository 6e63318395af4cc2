// What pages are sent of a run, those that come early, late and again, and those that are slow.

#include "tools/serve/page_hub.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

namespace talus::page_hub_test {
namespace {

/// A page that acknowledges what comes, unless it is slow.
class Browser final : public PageSocket {
 public:
  explicit Browser(PageHub& hub, bool slow = false) : hub_(hub), slow_(slow), number_(hub.add(*this)) {}
  ~Browser() override { hub_.remove(number_); }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  bool send_text(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    const auto message = nlohmann::json::parse(text);
    if (message["kind"] == "begin") {
      runs_.push_back(message["title"]);
      frames_.clear();
    }
    if (message["kind"] == "thinned") thinned_ = true;
    changed_.notify_all();
    return true;
  }

  /// Blocks of this test have one letter each.
  bool send_bytes(std::string_view bytes) override {
    {
      const std::lock_guard lock(mutex_);
      largest_ = std::max(largest_, bytes.size());
      frames_ += bytes;
      changed_.notify_all();
    }
    if (!slow_) acknowledge();
    return true;
  }

  void acknowledge() {
    while (number_ < 0) std::this_thread::yield();  // its sender is faster than add()
    hub_.acknowledge(number_);
  }

  bool has(const std::string& frames) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(5), [&] { return frames_ == frames; });
  }
  std::string frames() {
    const std::lock_guard lock(mutex_);
    return frames_;
  }
  std::vector<std::string> runs() {
    const std::lock_guard lock(mutex_);
    return runs_;
  }
  std::size_t largest() {
    const std::lock_guard lock(mutex_);
    return largest_;
  }
  bool thinned() {
    const std::lock_guard lock(mutex_);
    return thinned_;
  }

 private:
  PageHub& hub_;
  bool slow_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> runs_;
  std::string frames_;       // of the last run
  std::size_t largest_ = 0;  // frames that came at once
  bool thinned_ = false;
  std::atomic<int> number_ = -1;
};

std::string beginning(const std::string& title) { return nlohmann::json{{"kind", "begin"}, {"title", title}}.dump(); }

std::string first_of_both(std::string_view a, std::string_view /*b*/) { return std::string(a); }

void publish(PageHub& hub, const std::string& frames) {
  static std::int64_t step = 0;
  for (const char frame : frames) hub.publish({.step = ++step, .block = std::string(1, frame)});
}

TEST(PageHub, SendsALatePageAllFramesOfTheRun) {
  PageHub hub(PageHub::usual_history_bytes, first_of_both);
  hub.begin(beginning("run"));
  Browser early(hub);
  publish(hub, "abc");
  EXPECT_TRUE(early.has("abc"));
  publish(hub, "defgh");
  Browser late(hub);
  EXPECT_TRUE(late.has("abcdefgh"));
  EXPECT_TRUE(early.has("abcdefgh"));
  EXPECT_FALSE(late.thinned());
}

TEST(PageHub, SendsASlowPageAllThatItMissedAtOnce) {
  PageHub hub(PageHub::usual_history_bytes, first_of_both);
  hub.begin(beginning("run"));
  Browser slow(hub, true);
  publish(hub, "a");
  EXPECT_TRUE(slow.has("a"));
  publish(hub, "bcdefgh");
  EXPECT_EQ(slow.frames(), "a") << "one parcel waits for its acknowledgement";
  EXPECT_FALSE(hub.wanted());
  slow.acknowledge();
  EXPECT_TRUE(slow.has("abcdefgh"));
  EXPECT_EQ(slow.largest(), 7U);
}

TEST(PageHub, ForgetsTheFramesOfTheRunBefore) {
  PageHub hub(PageHub::usual_history_bytes, first_of_both);
  hub.begin(beginning("first"));
  Browser page(hub);
  publish(hub, "abc");
  EXPECT_TRUE(page.has("abc"));
  hub.begin(beginning("second"));
  publish(hub, "xy");
  EXPECT_TRUE(page.has("xy"));
  Browser late(hub);
  EXPECT_TRUE(late.has("xy"));
  EXPECT_EQ(late.runs(), std::vector<std::string>{"second"});
}

TEST(PageHub, TellsPagesThatFramesWereLeftOut) {
  PageHub hub(4000, first_of_both);
  hub.begin(beginning("run"));
  Browser early(hub);
  for (int i = 0; i < 100; ++i) publish(hub, "a");
  Browser late(hub);
  publish(hub, "z");
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (std::chrono::steady_clock::now() < end && (!late.frames().ends_with("z") || !early.frames().ends_with("z")))
    std::this_thread::yield();
  EXPECT_LT(late.frames().size(), 80U);
  EXPECT_TRUE(late.thinned());
  EXPECT_TRUE(early.thinned());
}

}  // namespace
}  // namespace talus::page_hub_test
