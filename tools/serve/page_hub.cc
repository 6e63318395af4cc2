#include "tools/serve/page_hub.h"

#include <algorithm>
#include <utility>

namespace talus {
namespace {

constexpr SleepEvent no_event = {.step = -1};

/// Events that wait for a page that does not acknowledge; beyond, the oldest are given up.
constexpr std::size_t most_events = 1'000'000;

}  // namespace

PageHub::~PageHub() {
  std::vector<int> numbers;
  {
    const std::lock_guard lock(mutex_);
    for (const Page& page : pages_) numbers.push_back(page.number);
  }
  for (const int number : numbers) remove(number);
}

void PageHub::begin(std::shared_ptr<const Snapshot> first) {
  const std::lock_guard lock(mutex_);
  last_events_.clear();
  for (Page& page : pages_) {
    page.events.clear();
    page.body = -1;
  }
  newest_ = std::move(first);
  changed_.notify_all();
}

void PageHub::add_events(std::span<const SleepEvent> events) {
  if (events.empty()) return;
  const std::lock_guard lock(mutex_);
  for (const SleepEvent& event : events) {
    if (static_cast<std::size_t>(event.body) >= last_events_.size()) last_events_.resize(event.body + 1, no_event);
    last_events_[event.body] = event;
  }
  for (Page& page : pages_) {
    if (page.events.size() + events.size() > most_events) page.events.clear();
    page.events.insert(page.events.end(), events.begin(), events.end());
  }
}

bool PageHub::wanted() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(pages_, [&](const Page& page) { return page.ready && page.sent == newest_; });
}

void PageHub::publish(std::shared_ptr<const Snapshot> snapshot) {
  const std::lock_guard lock(mutex_);
  newest_ = std::move(snapshot);
  changed_.notify_all();
}

void PageHub::set_status(const std::string& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
  changed_.notify_all();
}

int PageHub::add(PageSocket& socket) {
  const std::lock_guard lock(mutex_);
  if (pages_.size() >= most_pages) return -1;
  Page& page = pages_.emplace_back();
  page.number = next_page_++;
  page.socket = &socket;
  std::ranges::copy_if(last_events_, std::back_inserter(page.events),
                       [](const SleepEvent& event) { return event.step >= 0; });
  page.sender = std::jthread([this, &page] { send(page); });
  return page.number;
}

void PageHub::remove(int number) {
  std::list<Page> removed;
  {
    const std::lock_guard lock(mutex_);
    const auto page = std::ranges::find(pages_, number, &Page::number);
    if (page == pages_.end()) return;
    page->closing = true;
    removed.splice(removed.end(), pages_, page);
    changed_.notify_all();
  }
  removed.front().sender.join();
}

void PageHub::acknowledge(int number) {
  const std::lock_guard lock(mutex_);
  if (Page* page = find(number)) page->ready = true;
  changed_.notify_all();
}

void PageHub::want_contacts(int number, bool wanted) {
  const std::lock_guard lock(mutex_);
  if (Page* page = find(number)) page->contacts = wanted;
}

bool PageHub::contacts_wanted() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(pages_, &Page::contacts);
}

void PageHub::choose_body(int number, std::int64_t body) {
  const std::lock_guard lock(mutex_);
  if (Page* page = find(number)) page->body = body;
}

std::vector<std::pair<int, std::int64_t>> PageHub::chosen_bodies() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<int, std::int64_t>> chosen;
  for (const Page& page : pages_)
    if (page.body >= 0) chosen.emplace_back(page.number, page.body);
  return chosen;
}

void PageHub::set_account(int number, const std::string& account) {
  const std::lock_guard lock(mutex_);
  if (Page* page = find(number)) page->account = account;
}

void PageHub::reply(int number, const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (Page* page = find(number)) page->replies.push_back(text);
  changed_.notify_all();
}

std::size_t PageHub::pages() const {
  const std::lock_guard lock(mutex_);
  return pages_.size();
}

PageHub::Page* PageHub::find(int number) {
  const auto page = std::ranges::find(pages_, number, &Page::number);
  return page == pages_.end() ? nullptr : &*page;
}

/// The thread of a page.
void PageHub::send(Page& page) {
  std::unique_ptr<BlockWriter> writer;
  for (;;) {
    Parcel parcel;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return page.closing || !page.replies.empty() || page.status != status_ || due(page); });
      if (page.closing) return;
      parcel = take(page);
    }
    if (!send(parcel, *page.socket, writer)) return;
  }
}

PageHub::Parcel PageHub::take(Page& page) {
  Parcel parcel;
  parcel.texts = std::exchange(page.replies, {});
  if (page.status != status_) parcel.texts.push_back(page.status = status_);
  if (!due(page)) return parcel;
  parcel.new_run = page.sent == nullptr || page.sent->head() != newest_->head();
  if (!page.account.empty()) parcel.texts.push_back(std::exchange(page.account, ""));
  parcel.contacts = page.contacts;
  parcel.snapshot = page.sent = newest_;
  // Events of steps after the snapshot stay for the next one.
  const auto later = std::stable_partition(page.events.begin(), page.events.end(),
                                           [&](const SleepEvent& event) { return event.step <= newest_->step(); });
  parcel.events.assign(page.events.begin(), later);
  page.events.erase(page.events.begin(), later);
  page.ready = false;
  return parcel;
}

bool PageHub::send(const Parcel& parcel, PageSocket& socket, std::unique_ptr<BlockWriter>& writer) {
  for (const std::string& text : parcel.texts)
    if (!socket.send_text(text)) return false;
  if (!parcel.snapshot) return true;
  if (parcel.new_run || !writer) {
    writer = parcel.snapshot->make_writer();
    if (!socket.send_text(*parcel.snapshot->head())) return false;
  }
  std::string bytes = parcel.snapshot->block(*writer, parcel.events);
  if (parcel.contacts) bytes += parcel.snapshot->contacts();
  return socket.send_bytes(bytes);
}

}  // namespace talus
