#include "lcmtypes/live_link.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <string_view>

#include "common/math/require.h"

namespace talus {
namespace {

constexpr const char* default_url = "udpm://239.255.76.67:7667?ttl=0";

bool is_multicast(std::string_view url) { return url.starts_with("udpm://") || url.starts_with("mpudpm://"); }

/// The group's address of a multicast url.
std::string group_of(std::string_view url) {
  url.remove_prefix(url.find("://") + 3);
  const std::string_view address = url.substr(0, url.find_first_of(":?"));
  return address.empty() ? "239.255.76.67" : std::string(address);
}

bool is_multicast_group(const std::string& group) {
  in_addr address{};
  return inet_pton(AF_INET, group.c_str(), &address) == 1 && IN_MULTICAST(ntohl(address.s_addr));
}

/// Whether the port of a multicast url is one, or left out.
bool port_holds(std::string_view url) {
  url.remove_prefix(url.find("://") + 3);
  url = url.substr(0, url.find('?'));
  const std::size_t colon = url.find(':');
  if (colon == std::string_view::npos) return true;
  const std::string_view text = url.substr(colon + 1);
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size() && port >= 1 && port <= 65535;
}

/// Whether the operating system has a route for an address. True for what is no address: LCM reports more
/// about that than we could.
bool has_route(const std::string& group) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(7667);
  if (inet_pton(AF_INET, group.c_str(), &address.sin_addr) != 1) return true;
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  const bool reached = connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(descriptor);
  return reached;
}

/// The largest receive buffer [bytes] that a socket gets here; 0: unknown.
int largest_receive_buffer() {
  constexpr int wanted = 64 << 20;  // more is of no use: seconds of what a run sends
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  int given = 0;
  socklen_t size = sizeof given;
  const bool set = setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &wanted, sizeof wanted) == 0 &&
                   getsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &given, &size) == 0;
  close(descriptor);
  return set ? given / 2 : 0;  // Linux grants at most rmem_max, and reports twice what it granted
}

}  // namespace

std::string effective_url(const std::string& url) {
  if (!url.empty()) return url;
  const char* from_environment = std::getenv("LCM_DEFAULT_URL");
  return from_environment != nullptr && *from_environment != '\0' ? from_environment : default_url;
}

std::string receiving_url(const std::string& url) {
  std::string address = effective_url(url);
  const int bytes = largest_receive_buffer();
  if (!is_multicast(address) || address.find("recv_buf_size=") != std::string::npos || bytes == 0) return address;
  return fmt::format("{}{}recv_buf_size={}", address, address.find('?') == std::string::npos ? '?' : '&', bytes);
}

void check_url(const std::string& url) {
  const std::string address = effective_url(url);
  const std::string_view option = url.empty() ? "LCM_DEFAULT_URL" : "--lcm-url";
  constexpr std::string_view transports[] = {"udpm", "mpudpm", "tcpq", "memq", "file"};
  const std::size_t colon = std::min(address.find("://"), address.size());
  const bool known =
      std::find(std::begin(transports), std::end(transports), address.substr(0, colon)) != std::end(transports);
  require(known && colon < address.size(), option, address,
          fmt::format("must begin with {}://", fmt::join(transports, "://, ")));
  if (!is_multicast(address)) return;
  require(is_multicast_group(group_of(address)), option, address,
          "must name a group from 224.0.0.0 to 239.255.255.255");
  require(port_holds(address), option, address, "must name a port from 1 to 65535");
}

void require_local(const std::string& url) {
  if (!is_multicast(url)) return;
  std::string_view options = url;
  options.remove_prefix(std::min(options.find('?'), options.size() - 1) + 1);
  while (!options.empty()) {
    const std::string_view option = options.substr(0, options.find('&'));
    options.remove_prefix(std::min(option.size() + 1, options.size()));
    if (option.starts_with("ttl=") && option != "ttl=0") {
      throw std::invalid_argument(
          fmt::format("LCM address = {}: must have ttl=0: {} sends to the whole network", url, option));
    }
  }
}

LiveLink open_live_link(const std::string& url) {
  const std::string address = effective_url(url);
  if (is_multicast(address) && !has_route(group_of(address))) {
    return {nullptr, fmt::format("no route for multicast to {}; cure: ip link set lo up && ip route add 224.0.0.0/4 "
                                 "dev lo (as root)",
                                 group_of(address))};
  }
  auto link = std::make_unique<lcm::LCM>(address);
  if (!link->good()) return {nullptr, fmt::format("LCM does not open \"{}\"", address)};
  return {std::move(link), {}};
}

}  // namespace talus
