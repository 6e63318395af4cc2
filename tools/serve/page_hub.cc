#include "tools/serve/page_hub.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace talus {
namespace {

/// Of frames that are sent at once: the page draws between two such parcels.
constexpr std::size_t most_parcel_bytes = std::size_t{1} << 20U;

}  // namespace

PageHub::~PageHub() {
  std::vector<int> numbers;
  {
    const std::lock_guard lock(mutex_);
    for (const Page& page : pages_) numbers.push_back(page.number);
  }
  for (const int number : numbers) remove(number);
}

void PageHub::begin(const std::string& text) {
  const std::lock_guard lock(mutex_);
  for (Page& page : pages_) page.body = -1;
  ++run_;
  beginning_ = text;
  history_ = FrameHistory(most_history_bytes_, merge_);
  changed_.notify_all();
}

void PageHub::publish(ShownFrame frame) {
  const std::lock_guard lock(mutex_);
  std::vector<std::int64_t> held;
  for (const Page& page : pages_)
    if (page.run == run_) held.push_back(page.frame);
  history_.add(frame.step, std::move(frame.block), held);
  changed_.notify_all();
}

bool PageHub::wanted() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(pages_, [&](const Page& page) { return page.ready && !due(page); });
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
  for (;;) {
    Parcel parcel;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return page.closing || !page.replies.empty() || page.status != status_ || due(page); });
      if (page.closing) return;
      parcel = take(page);
    }
    for (const std::string& text : parcel.texts)
      if (!page.socket->send_text(text)) return;
    if (!parcel.frames.empty() && !page.socket->send_bytes(parcel.frames)) return;
  }
}

PageHub::Parcel PageHub::take(Page& page) {
  Parcel parcel;
  parcel.texts = std::exchange(page.replies, {});
  if (page.status != status_) parcel.texts.push_back(page.status = status_);
  if (!due(page)) return parcel;
  if (page.run != run_) {
    page.run = run_;
    page.frame = -1;
    page.spacing = 0;
    parcel.texts.push_back(beginning_);
  }
  if (page.spacing != history_.spacing()) {
    page.spacing = history_.spacing();
    const nlohmann::json text = {
        {"kind", "thinned"}, {"steps", page.spacing}, {"mebibytes", most_history_bytes_ >> 20U}};
    parcel.texts.push_back(text.dump());
  }
  if (!page.account.empty()) parcel.texts.push_back(std::exchange(page.account, ""));
  FrameHistory::Run run = history_.after(page.frame, most_parcel_bytes);
  if (run.frames == 0) return parcel;
  page.frame = run.last;
  page.ready = false;
  parcel.frames = std::move(run.bytes);
  return parcel;
}

}  // namespace talus
