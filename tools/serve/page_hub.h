#pragma once
// What the pages of a run are sent.

#include <condition_variable>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "tools/serve/frame_history.h"
#include "tools/serve/merge_messages.h"

namespace talus {

/// The way to one page. Sending blocks while the page is slow, and returns false once it is gone.
class PageSocket {
 public:
  virtual ~PageSocket() = default;
  virtual bool send_text(std::string_view text) = 0;
  virtual bool send_bytes(std::string_view bytes) = 0;
};

/// One state of a run, as pages are sent it.
struct ShownFrame {
  std::int64_t step = 0;
  std::string block;  // the log events (event_log.h) of what is new since the frame before
};

/// Keeps the frames of a run and sends each page all of them, so that a page that comes late or again has the whole
/// run. A page gets those that it lacks once it has acknowledged the last ones, many at a time where it lags behind. A
/// thread for each page sends, so a slow or dead page holds up neither the run nor the others.
class PageHub {
 public:
  /// More are refused: each costs a thread.
  static constexpr std::size_t most_pages = 8;
  /// Of memory that the frames of a run take; beyond, some are left out (FrameHistory).
  static constexpr std::size_t usual_history_bytes = std::size_t{256} << 20U;

  /// `merge`: of the blocks of two frames.
  explicit PageHub(std::size_t most_history_bytes = usual_history_bytes, FrameHistory::Merge merge = merge_messages)
      : most_history_bytes_(most_history_bytes), merge_(std::move(merge)) {}
  ~PageHub();
  PageHub(const PageHub&) = delete;
  PageHub& operator=(const PageHub&) = delete;

  /// A run begins; frames of the last one are forgotten. `text`: what pages are told before its first frame.
  void begin(const std::string& text);
  void publish(ShownFrame frame);
  /// Whether a page has acknowledged all frames and waits for a newer one.
  bool wanted() const;
  /// Sent to each page once it changes, and to new pages.
  void set_status(const std::string& status);

  /// A page, by the number that the others take; -1 where there are too many. `socket` must stay until remove() has
  /// returned.
  int add(PageSocket& socket);
  void remove(int number);
  /// The page has shown the last frame that it was sent.
  void acknowledge(int number);
  /// Whether frames for this page have contacts.
  void want_contacts(int number, bool wanted);
  /// Whether any page does.
  bool contacts_wanted() const;
  /// The body of which a page is sent an account, below 0: none.
  void choose_body(int number, std::int64_t body);
  /// Pages with a body chosen, and the body.
  std::vector<std::pair<int, std::int64_t>> chosen_bodies() const;
  /// Sent to a page with its next frame, unless another one follows before.
  void set_account(int number, const std::string& account);
  /// A text for this page alone.
  void reply(int number, const std::string& text);
  std::size_t pages() const;

 private:
  struct Page {
    int number = 0;
    PageSocket* socket = nullptr;
    bool ready = true;  // for the next frame
    bool closing = false;
    bool contacts = false;   // are wanted
    std::int64_t body = -1;  // of which it is sent an account
    std::string account;     // of it; empty: sent
    std::vector<std::string> replies;
    std::string status;        // sent last
    std::int64_t run = 0;      // whose beginning was sent last; 0: none
    std::int64_t frame = -1;   // sent last, of that run
    std::int64_t spacing = 0;  // of the history, as it was told last
    std::jthread sender;
  };
  /// What a sender takes under the lock and sends without it.
  struct Parcel {
    std::vector<std::string> texts;
    std::string frames;  // their blocks; empty: none is due
  };

  void send(Page& page);
  bool due(const Page& page) const { return page.ready && (page.run != run_ || page.frame < history_.newest()); }
  Parcel take(Page& page);
  Page* find(int number);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Page> pages_;
  int next_page_ = 0;
  std::size_t most_history_bytes_;
  FrameHistory::Merge merge_;
  std::int64_t run_ = 0;   // number of the run; 0: there was none yet
  std::string beginning_;  // of it
  FrameHistory history_{0, {}};
  std::string status_;
};

}  // namespace talus
