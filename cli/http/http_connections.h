// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The connections of a server: their limit, and the choice of the one to close beyond it.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

class HttpConnections {
 public:
  // Adds a connected socket from an address; it waits for a request. If there are too many, closes the one that has
  // waited longest. Returns false if none waits, and there is no room.
  bool add(int socket, uint32_t address);
  // Call it before the socket is closed.
  void remove(int socket);

  // Marks the connection as having a request. Returns false if it was closed.
  bool begin(int socket);
  // Marks the connection as waiting for the next request.
  void wait(int socket);

  // Closes all connections, and waits until they are removed.
  void end();

 private:
  struct Connection {
    uint32_t address = 0;
    uint64_t waits_since = 0;  // a number that grows; 0: it does not wait
    bool has_ended = false;
  };

  void end(int socket, Connection& connection);
  bool make_room(const uint32_t* address, size_t maximum);

  std::mutex mutex_;
  std::condition_variable removed_;
  std::map<int, Connection> connections_;
  uint64_t waits_ = 0;
};
