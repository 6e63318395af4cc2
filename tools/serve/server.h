#pragma once

#include <memory>
#include <string>

#include "tools/serve/page_hub.h"
#include "tools/serve/run_loop.h"

namespace talus {

/// What the server sends.
struct ServedFiles {
  std::string page;
  std::string record;  // what the page of a record fetches; empty: the page is of a run
};

/// Serves pages to browsers of this machine: HTTP on the loopback interface only. Whoever fetches anything must know
/// the token in the address, and what a browser says of the page that it comes from (Origin, Host) must be this server:
/// so neither other users nor other pages in the same browser see or steer the run.
class ViewServer {
 public:
  /// `port` 0: one that is free. `hub`: of a run; null for a record. `loop`: what obeys the
  /// pages; null where they only watch. Throws std::runtime_error where the
  /// port cannot be had.
  ViewServer(int port, ServedFiles files, PageHub* hub, RunLoop* loop);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Address with token, for a browser.
  std::string url() const;

 private:
  struct Service;
  std::unique_ptr<Service> service_;
};

}  // namespace talus
