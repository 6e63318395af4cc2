#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tools/serve/page_hub.h"
#include "tools/serve/run_loop.h"

namespace talus {

inline constexpr std::string_view loopback = "127.0.0.1";

/// A page that the server sends, and what stands behind it.
struct ServedPage {
  std::string path;         // of its address: begins and ends with '/'
  std::string page;         // HTML
  std::string record = {};  // what the page of a record fetches; empty: the page has none
  PageHub* hub = nullptr;   // of a run; null: the page shows none
  RunLoop* loop = nullptr;  // what obeys the page; null where it only watches
};

/// Serves pages over HTTP on one interface, that of the loopback unless another one is named: browsers of this machine.
/// Each request must have the token of the address, and a browser must name this server as the page that the request
/// comes from (Origin, Host): so neither other users nor other pages in the same browser see or steer the run.
class ViewServer {
 public:
  /// `port` 0: one that is free. `address`: of the interface, IPv4. The first page is the one of url(). Throws
  /// std::invalid_argument where no interface has the address, std::runtime_error where the port cannot be had there.
  ViewServer(int port, std::vector<ServedPage> pages, const std::string& address = std::string(loopback));
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Address with token, for a browser.
  std::string url() const;

 private:
  struct Service;
  struct Mount;
  std::unique_ptr<Service> service_;
};

}  // namespace talus
