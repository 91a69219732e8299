// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The connections of a server: how many there may be, and which one goes when there are too many.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

class HttpConnections {
 public:
  // A connected socket from an address; it waits for a request. Where there are too many, the one that has waited
  // longest is ended. False: none waits, and there is no room.
  bool add(int socket, uint32_t address);
  // Before the socket is closed.
  void remove(int socket);

  // It has a request. False: it was ended.
  bool begin(int socket);
  // It waits for the next one.
  void wait(int socket);

  // Ends all, and waits until they are removed.
  void end();

 private:
  struct Connection {
    uint32_t address = 0;
    uint64_t waits_since = 0;  // a number that grows; 0: it does not wait
    bool has_ended = false;
  };

  void end(int socket, Connection& connection);
  bool make_room(const uint32_t* address, size_t most);

  std::mutex mutex_;
  std::condition_variable removed_;
  std::map<int, Connection> connections_;
  uint64_t waits_ = 0;
};
