#pragma once
// What the pages of a run are sent.

#include <condition_variable>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "tools/serve/shown_run.h"

namespace talus {

/// The way to one page. Sending blocks while the page is slow, and returns false once it is gone.
class PageSocket {
 public:
  virtual ~PageSocket() = default;
  virtual bool send_text(std::string_view text) = 0;
  virtual bool send_bytes(std::string_view bytes) = 0;
};

/// Sends each page the newest state, the next one only once the page has acknowledged the last: never more than the
/// newest waits. A thread for each page sends, so a slow or dead page holds up neither the run nor the others.
class PageHub {
 public:
  /// More are refused: each costs a thread.
  static constexpr std::size_t most_pages = 8;

  PageHub() = default;
  ~PageHub();
  PageHub(const PageHub&) = delete;
  PageHub& operator=(const PageHub&) = delete;

  /// A run begins with this state; events of the last one are forgotten.
  void begin(std::shared_ptr<const Snapshot> first);
  /// Events of one step. A page gets all since its last frame, a new page the last of each body.
  void add_events(std::span<const SleepEvent> events);
  /// Whether a page waits for a newer state than the last one published.
  bool wanted() const;
  void publish(std::shared_ptr<const Snapshot> snapshot);
  /// Sent to each page once it changes, and to new pages.
  void set_status(const std::string& status);

  /// A page, by the number that the others take; -1 where there are too many. `socket` must stay until remove() has
  /// returned.
  int add(PageSocket& socket);
  void remove(int number);
  /// The page has shown the last frame that it was sent.
  void acknowledge(int number);
  /// Whether this page is sent contacts.
  void want_contacts(int number, bool wanted);
  /// Whether any page is.
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
    bool contacts = false;   // are sent to it
    std::int64_t body = -1;  // of which it is sent an account
    std::string account;     // of it; empty: sent
    std::vector<std::string> replies;
    std::vector<SleepEvent> events;  // since the last frame sent
    std::string status;              // sent last
    std::shared_ptr<const Snapshot> sent;
    std::jthread sender;
  };
  /// What a sender takes under the lock and sends without it.
  struct Parcel {
    std::vector<std::string> texts;
    std::shared_ptr<const Snapshot> snapshot;  // null: none is due
    std::vector<SleepEvent> events;
    bool new_run = false;
    bool contacts = false;
  };

  void send(Page& page);
  bool due(const Page& page) const { return page.ready && newest_ && newest_ != page.sent; }
  Parcel take(Page& page);
  static bool send(const Parcel& parcel, PageSocket& socket, std::unique_ptr<BlockWriter>& writer);
  Page* find(int number);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Page> pages_;
  int next_page_ = 0;
  std::shared_ptr<const Snapshot> newest_;
  std::vector<SleepEvent> last_events_;  // of each body that had one, by body; `step` < 0: none
  std::string status_;
};

}  // namespace talus
