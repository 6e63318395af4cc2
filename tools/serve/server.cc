#include "tools/serve/server.h"

#include <arpa/inet.h>
#include <civetweb.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace talus {
namespace {

constexpr std::size_t longest_command = 2'000'000;  // bytes; a scene's text is at most 1 MiB

/// 128 random bits in hexadecimal.
std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "getrandom");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

/// In a time that does not depend on where they differ.
bool same_text(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different |= static_cast<unsigned char>(a[i] ^ b[i]);
  return different == 0;
}

/// Whether sockets of this machine can have this address.
bool has_interface(const std::string& address) {
  const int socket_file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_file < 0) return true;  // not known
  sockaddr_in place{};
  place.sin_family = AF_INET;
  const bool has = inet_pton(AF_INET, address.c_str(), &place.sin_addr) == 1 &&
                   bind(socket_file, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0;
  close(socket_file);
  return has;
}

std::string_view header(const mg_connection* connection, const char* name) {
  const char* value = mg_get_header(connection, name);
  return value != nullptr ? std::string_view(value) : std::string_view();
}

class WebPage final : public PageSocket {
 public:
  explicit WebPage(mg_connection* connection) : connection_(connection) {}
  bool send_text(std::string_view text) override { return send(MG_WEBSOCKET_OPCODE_TEXT, text); }
  bool send_bytes(std::string_view bytes) override { return send(MG_WEBSOCKET_OPCODE_BINARY, bytes); }

  int number = -1;      // in the hub
  std::string command;  // the part that has arrived

 private:
  bool send(int kind, std::string_view data) {
    return mg_websocket_write(connection_, kind, data.data(), data.size()) > 0;
  }
  mg_connection* connection_;
};

}  // namespace

struct ViewServer::Service {
  std::string token = new_token();
  std::string address;
  int port = 0;
  mg_context* context = nullptr;
  std::vector<Mount> mounts;  // not changed while the server runs

  /// Whether a request is from a page of this server, or from a program that has the token.
  bool allows(const mg_connection* connection) const {
    const mg_request_info* request = mg_get_request_info(connection);
    const std::string_view query = request->query_string != nullptr ? request->query_string : "";
    std::array<char, 64> given{};
    if (mg_get_var(query.data(), query.size(), "token", given.data(), given.size()) < 0) return false;
    if (!same_text(given.data(), token)) return false;
    const std::string_view host = header(connection, "Host");
    const bool local = address == loopback && host == fmt::format("localhost:{}", port);
    if (!local && host != fmt::format("{}:{}", address, port)) return false;
    const std::string_view origin = header(connection, "Origin");
    return origin.empty() || origin == fmt::format("http://{}", host);
  }

  static int refuse(mg_connection* connection) {
    mg_send_http_error(connection, 403, "%s", "wrong token or Origin: take the address that talus view printed");
    return 403;
  }

  int answer(mg_connection* connection, const char* type, const std::string& body) const {
    if (!allows(connection)) return refuse(connection);
    mg_response_header_start(connection, 200);
    for (const auto& [name, value] : std::to_array<std::pair<const char*, std::string>>(
             {{"Content-Type", type},
              {"Content-Length", std::to_string(body.size())},
              {"Cache-Control", "no-store"},
              {"Referrer-Policy", "no-referrer"},
              {"X-Content-Type-Options", "nosniff"},
              {"Content-Security-Policy",
               "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; connect-src 'self'; "
               "base-uri 'none'; frame-src 'self'; frame-ancestors 'self'"}}))
      mg_response_header_add(connection, name, value.c_str(), -1);
    mg_response_header_send(connection);
    mg_write(connection, body.data(), body.size());
    return 200;
  }
};

/// A page and the handlers of its requests; `data` is the mount.
struct ViewServer::Mount {
  ServedPage served;
  Service* service = nullptr;

  static Mount& of(void* data) { return *static_cast<Mount*>(data); }

  static int on_page(mg_connection* connection, void* data) {
    return of(data).service->answer(connection, "text/html; charset=utf-8", of(data).served.page);
  }
  static int on_record(mg_connection* connection, void* data) {
    return of(data).service->answer(connection, "application/octet-stream", of(data).served.record);
  }

  /// 0 accepts.
  static int on_connect(const mg_connection* connection, void* data) {
    return of(data).service->allows(connection) && of(data).served.hub->pages() < PageHub::most_pages ? 0 : 1;
  }

  static void on_ready(mg_connection* connection, void* data) {
    const ServedPage& served = of(data).served;
    auto page = std::make_unique<WebPage>(connection);
    page->number = served.hub->add(*page);
    if (served.loop != nullptr) served.loop->greet(page->number);
    mg_set_user_connection_data(connection, page.release());
  }

  /// 1 keeps the connection.
  static int on_message(mg_connection* connection, int bits, char* bytes, std::size_t size, void* data) {
    const ServedPage& served = of(data).served;
    auto* page = static_cast<WebPage*>(mg_get_user_connection_data(connection));
    constexpr int kinds = 0xF;
    constexpr int last_part = 0x80;
    if (page == nullptr || page->number < 0 || (bits & kinds) == MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE) return 0;
    if ((bits & kinds) > MG_WEBSOCKET_OPCODE_BINARY) return 1;  // a ping or its answer
    if (page->command.size() + size > longest_command) return 0;
    page->command.append(bytes, size);
    if ((bits & last_part) == 0) return 1;
    const std::string command = std::exchange(page->command, "");
    if (command == "shown")
      served.hub->acknowledge(page->number);
    else if (served.loop != nullptr)
      served.loop->command(page->number, command);
    return 1;
  }

  static void on_close(const mg_connection* connection, void* data) {
    const std::unique_ptr<WebPage> page(static_cast<WebPage*>(mg_get_user_connection_data(connection)));
    if (page == nullptr) return;
    of(data).served.hub->remove(page->number);
    if (of(data).served.loop != nullptr) of(data).served.loop->leave(page->number);
  }

  void listen() {
    const std::string& path = served.path;
    mg_set_request_handler(service->context, (path + "$").c_str(), on_page, this);
    if (!served.record.empty()) mg_set_request_handler(service->context, (path + "record$").c_str(), on_record, this);
    if (served.hub != nullptr)
      mg_set_websocket_handler(service->context, (path + "stream$").c_str(), on_connect, on_ready, on_message, on_close,
                               this);
  }
};

ViewServer::ViewServer(int port, std::vector<ServedPage> pages, const std::string& address)
    : service_(std::make_unique<Service>()) {
  service_->address = address;
  for (ServedPage& page : pages) service_->mounts.push_back({std::move(page), service_.get()});
  mg_init_library(MG_FEATURES_WEBSOCKET);
  const std::string listened = fmt::format("{}:{}", address, port);
  // A page that is gone without closing is found by the missing answer to a ping.
  const std::array<const char*, 13> options = {"listening_ports",
                                               listened.c_str(),
                                               "num_threads",
                                               "16",
                                               "request_timeout_ms",
                                               "10000",
                                               "websocket_timeout_ms",
                                               "5000",
                                               "enable_websocket_ping_pong",
                                               "yes",
                                               "enable_directory_listing",
                                               "no",
                                               nullptr};
  mg_callbacks callbacks{};
  callbacks.log_message = [](const mg_connection*, const char*) { return 1; };
  service_->context = mg_start(&callbacks, service_.get(), const_cast<const char**>(options.data()));
  if (service_->context == nullptr) {
    if (!has_interface(address))
      throw std::invalid_argument(
          fmt::format("--listen = {}: must be the IPv4 address of an interface of this machine", address));
    throw std::runtime_error(fmt::format(
        "--port = {}: cannot be listened on at {}; another program may have it, or it is reserved", port, address));
  }
  std::array<mg_server_port, 1> ports{};
  mg_get_server_ports(service_->context, 1, ports.data());
  service_->port = ports[0].port;
  for (Mount& mount : service_->mounts) mount.listen();
}

ViewServer::~ViewServer() {
  if (service_->context != nullptr) mg_stop(service_->context);
  mg_exit_library();
}

std::string ViewServer::url() const {
  return fmt::format("http://{}:{}{}?token={}", service_->address, service_->port, service_->mounts.front().served.path,
                     service_->token);
}

}  // namespace talus
