// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// HTTP/1.1 as text, without a connection: the head of a request (RFC 9112), and the part of a file that a browser asks
// for (RFC 9110, section 14).
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

struct RequestHead {
  std::string method;
  std::string path;                           // decoded: /item/0/left.jpg
  std::map<std::string, std::string> query;   // decoded
  std::map<std::string, std::string> fields;  // the names in small letters
  bool stays = false;                         // the connection is for more requests

  // Empty if there is none.
  std::string field(const std::string& name) const;
};

// text: up to and including the empty line. Returns nullopt if it is not a request that we support: another version, a
// repeated field, stray bytes.
std::optional<RequestHead> read_request_head(std::string_view text);

struct FilePart {
  int status = 200;  // 206: a part; 416: there is no such part
  uint64_t first = 0;
  uint64_t count = 0;
};

// asked: the request's field Range; a malformed one, and several ranges at once, mean the whole file.
FilePart part_of_file(std::string_view asked, uint64_t size);

// The text of the status line.
const char* reason_of(int status);
