#pragma once

#include <memory>
#include <string>

namespace lcm {
class LCM;
}

namespace talus {

/// A way into LCM's network, or why there is none.
struct LiveLink {
  std::unique_ptr<lcm::LCM> lcm;
  std::string problem;  // one line with the remedy; empty when `lcm` is there
};

/// The address that counts: `url`, else the variable LCM_DEFAULT_URL, else multicast that stays on this machine.
std::string effective_url(const std::string& url);

/// effective_url(url) for a receiver: a multicast address without `recv_buf_size` gets the largest receive buffer that
/// the kernel allows (sysctl net.core.rmem_max), so that bursts are not lost.
std::string receiving_url(const std::string& url);

/// Throws std::invalid_argument unless LCM can parse effective_url(url): a transport of LCM and, for multicast, a group
/// from 224.0.0.0 to 239.255.255.255 and a port. Opens no connection.
void check_url(const std::string& url);

/// Throws std::invalid_argument when packets to this address would leave the machine (ttl is not 0).
void require_local(const std::string& effective_url);

/// Opens effective_url(url). Checks for the multicast route first, since LCM would print a page of text and fail.
LiveLink open_live_link(const std::string& url);

}  // namespace talus
