#include "tools/monitor/receiver_process.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "tools/output/output.h"

namespace talus {
namespace {

constexpr std::uint8_t sign_of_life = 0xFF;  // in place of a channel

void send_or_end(int socket, std::uint8_t kind, const void* bytes, std::size_t size) {
  iovec parts[] = {{&kind, 1}, {const_cast<void*>(bytes), size}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = size > 0 ? 2 : 1;
  while (sendmsg(socket, &message, MSG_NOSIGNAL) < 0)
    if (errno != EINTR) _exit(0);  // the monitor is gone
}

std::string description_of(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  const char* name = sigdescr_np(WTERMSIG(status));
  return fmt::format("signal {} ({})", WTERMSIG(status), name != nullptr ? name : "unknown");
}

}  // namespace

void DatagramSender::send(Channel channel, const void* bytes, std::size_t size) const {
  send_or_end(socket_, static_cast<std::uint8_t>(channel), bytes, std::min(size, max_message_bytes + 1));
}

void DatagramSender::alive() const { send_or_end(socket_, sign_of_life, nullptr, 0); }

ReceiverProcess::ReceiverProcess(Body body) : body_(std::move(body)) { start(); }

ReceiverProcess::~ReceiverProcess() {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  close(socket_);
}

std::optional<Datagram> ReceiverProcess::next(std::chrono::milliseconds timeout) {
  if (pid_ < 0) {
    const auto wait = std::chrono::duration_cast<std::chrono::milliseconds>(next_start_ - Clock::now());
    if (wait.count() > 0) {
      std::this_thread::sleep_for(std::min(wait, timeout));
      return std::nullopt;
    }
    start();
    if (pid_ < 0) return std::nullopt;
  }
  pollfd readable{socket_, POLLIN, 0};
  if (poll(&readable, 1, static_cast<int>(timeout.count())) > 0) return read();
  if (Clock::now() - heard_ > stall_limit) {
    kill(pid_, SIGKILL);
    bury();
    last_crash_ = fmt::format("no sign of life for {} s", stall_limit.count());
  }
  return std::nullopt;
}

std::optional<Datagram> ReceiverProcess::read() {
  Datagram datagram;
  datagram.bytes.resize(max_message_bytes + 1);
  std::uint8_t kind = sign_of_life;
  iovec parts[] = {{&kind, 1}, {datagram.bytes.data(), datagram.bytes.size()}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  const ssize_t size = recvmsg(socket_, &message, 0);
  if (size < 0 && errno == EINTR) return std::nullopt;
  if (size <= 0) {
    bury();
    return std::nullopt;
  }
  heard_ = Clock::now();
  if (kind >= channel_names.size()) return std::nullopt;
  datagram.channel = static_cast<Channel>(kind);
  datagram.bytes.resize(size - 1);
  return datagram;
}

void ReceiverProcess::start() {
  int sockets[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) != 0) {
    note_crash(fmt::format("no socket: {}", std::strerror(errno)));
    return;
  }
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    close(sockets[0]);
    run_child(sockets[1], parent);
  }
  const int error = errno;
  close(sockets[1]);
  socket_ = sockets[0];
  started_ = heard_ = Clock::now();
  if (pid_ > 0) return;
  close(socket_);
  note_crash(fmt::format("no process: {}", std::strerror(error)));
}

void ReceiverProcess::run_child(int socket, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);  // the monitor died before the line above
  prctl(PR_SET_DUMPABLE, 0);          // forged packets should not fill the disk with core files
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_IGN);  // the monitor decides when to end
  try {
    body_(DatagramSender(socket));
  } catch (const std::exception& error) {
    print_message("live: {}", error.what());
  }
  _exit(1);
}

/// Takes leave of a child that died or was killed.
void ReceiverProcess::bury() {
  close(socket_);
  kill(pid_, SIGKILL);  // without effect on one that is dead
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (Clock::now() - started_ > sound_life) delay_ = {};
  note_crash(description_of(status));
}

void ReceiverProcess::note_crash(const std::string& how) {
  ++crashes_;
  last_crash_ = how;
  delay_ = std::clamp<std::chrono::milliseconds>(2 * delay_, first_delay, longest_delay);
  next_start_ = Clock::now() + delay_;
}

}  // namespace talus
