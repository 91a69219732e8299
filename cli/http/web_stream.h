// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes of one connection, plain or by TLS (through OpenSSL), with a deadline for each step.
#pragma once
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

using WebDeadline = std::chrono::steady_clock::time_point;

// A certificate and its key, for all connections.
class WebKeys {
 public:
  // Paths of PEM files. Throws Error(kInput) for files that cannot be used.
  WebKeys(const std::string& certificate, const std::string& key);
  ~WebKeys();
  WebKeys(const WebKeys&) = delete;
  WebKeys& operator=(const WebKeys&) = delete;

 private:
  friend class WebStream;
  void* context_;
};

class WebStream {
 public:
  // Over a connected socket, which the caller closes later. keys: null for none.
  WebStream(int socket, const WebKeys* keys);
  ~WebStream();
  WebStream(const WebStream&) = delete;
  WebStream& operator=(const WebStream&) = delete;

  // Performs the TLS handshake, if any. Returns false, as do the functions below, if the deadline has passed or the
  // peer has disconnected.
  bool open(WebDeadline until);
  // Reads the available bytes, at least one; returns 0 on failure.
  size_t read(char* to, size_t maximum, WebDeadline until);
  // patience: for the other side to take more of them.
  bool write(std::string_view bytes, std::chrono::seconds patience);
  // Returns whether the peer is a program of this user on this machine.
  bool is_our_users() const;
  // Signals the end, and lets the other side read the bytes sent: closing while bytes arrive would discard them.
  void end();

 private:
  template <class Step>
  int run(const Step& step, short plain_event, WebDeadline until);

  int socket_;
  void* tls_ = nullptr;
};
