// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/http/http_connections.h"

#include <sys/socket.h>

namespace {

constexpr size_t kMaxAddressBytes = 32;
constexpr size_t kMax = 256;

}  // namespace

// The socket is closed by its own thread, which notices that nothing can be read any more.
void HttpConnections::end(int socket, Connection& connection) {
  connection.has_ended = true;
  shutdown(socket, SHUT_RDWR);
}

// Searches all connections, or the connections of an address.
bool HttpConnections::make_room(const uint32_t* address, size_t maximum) {
  size_t count = 0;
  auto longest = connections_.end();
  for (auto each = connections_.begin(); each != connections_.end(); ++each) {
    const Connection& connection = each->second;
    if (connection.has_ended || (address && connection.address != *address)) continue;
    count++;
    if (connection.waits_since == 0) continue;
    if (longest == connections_.end() || connection.waits_since < longest->second.waits_since) longest = each;
  }
  if (count < maximum) return true;
  if (longest == connections_.end()) return false;
  end(longest->first, longest->second);
  return true;
}

bool HttpConnections::add(int socket, uint32_t address) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!make_room(&address, kMaxAddressBytes) || !make_room(nullptr, kMax)) return false;
  connections_[socket] = {.address = address, .waits_since = ++waits_};
  return true;
}

void HttpConnections::remove(int socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  connections_.erase(socket);
  removed_.notify_all();
}

bool HttpConnections::begin(int socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Connection& connection = connections_.at(socket);
  connection.waits_since = 0;
  return !connection.has_ended;
}

void HttpConnections::wait(int socket) {
  const std::lock_guard<std::mutex> lock(mutex_);
  connections_.at(socket).waits_since = ++waits_;
}

void HttpConnections::end() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (auto& [socket, connection] : connections_) end(socket, connection);
  removed_.wait(lock, [this] { return connections_.empty(); });
}
