// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/http/http_exchange.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>

#include "cli/console/console.h"
#include "ods/base/gzip.h"

namespace {

using std::chrono::seconds;

constexpr seconds kPatience{5};      // for the next bytes of a body, and for a reader of ours to take some
constexpr size_t kPiece = 64 << 10;  // bytes read or written at once
constexpr const char* kText = "text/plain; charset=utf-8";

// The page loads what we serve, and shows pictures that it made itself.
constexpr const char* kFields =
    "Content-Security-Policy: default-src 'self'; img-src 'self' blob: data:; media-src 'self' blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Opener-Policy: same-origin\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cache-Control: no-store\r\n";

// Compares in a time that does not depend on how much is right.
bool same_secret(std::string_view a, std::string_view b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (size_t i = 0; i < std::min(a.size(), b.size()); i++) {
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  }
  return difference == 0;
}

// A descriptor that is closed at the end.
struct File {
  explicit File(int opened) : descriptor(opened) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor >= 0) close(descriptor);
  }
  int descriptor;
};

// An upload, until the handler moves it.
struct RemovedFile {
  ~RemovedFile() {
    if (!path.empty()) unlink(path.c_str());
  }
  const std::string& path;
};

// A connection while it is answered.
struct Reply {
  WebStream& stream;
  bool stays;     // for the next request
  bool has_body;  // else its head only
};

bool send_head(const Reply& reply, int status, const std::string& type, uint64_t length, const std::string& more) {
  return reply.stream.write(
      fmt::format("HTTP/1.1 {} {}\r\n{}Connection: {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n{}\r\n", status,
                  reason_of(status), kFields, reply.stays ? "keep-alive" : "close", type, length, more),
      kPatience);
}

bool send_text(const Reply& reply, int status, const std::string& type, std::string_view body,
               const std::string& more = "") {
  return send_head(reply, status, type, body.size(), more) &&
         (!reply.has_body || reply.stream.write(body, kPatience)) && reply.stays;
}

bool send_file(const Reply& reply, const WebAnswer& answer, std::string_view range) {
  const File file(open(answer.file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat about {};
  if (file.descriptor < 0 || fstat(file.descriptor, &about) != 0 || !S_ISREG(about.st_mode)) {
    return send_text(reply, 404, kText, "that file is gone\n");
  }
  const auto size = static_cast<uint64_t>(about.st_size);
  FilePart part = part_of_file(range, size);
  std::string more = "Accept-Ranges: bytes\r\n";
  if (part.status == 206) {
    more += fmt::format("Content-Range: bytes {}-{}/{}\r\n", part.first, part.first + part.count - 1, size);
  } else if (part.status == 416) {
    more += fmt::format("Content-Range: bytes */{}\r\n", size);
  }
  if (!send_head(reply, part.status, answer.type, part.count, more)) return false;
  char piece[kPiece];
  while (reply.has_body && part.count > 0) {
    const size_t wanted = std::min<uint64_t>(part.count, sizeof(piece));
    const ssize_t read = pread(file.descriptor, piece, wanted, static_cast<off_t>(part.first));
    if (read <= 0 || !reply.stream.write({piece, static_cast<size_t>(read)}, kPatience)) return false;
    part.first += static_cast<uint64_t>(read), part.count -= static_cast<uint64_t>(read);
  }
  return reply.stays;
}

bool is_worth_packing(const WebAnswer& answer) {
  return answer.body.size() > 1000 && (answer.type.starts_with("text/") || answer.type == "application/json");
}

bool takes_gzip(const RequestHead& head) {
  const std::string takes = head.field("accept-encoding");
  return takes.find("gzip") != std::string::npos && takes.find("gzip;q=0") == std::string::npos;
}

// Behind the secret.
std::string path_of(const RequestHead& head) {
  return head.path.substr(head.path.find('/', 1) + 1);
}

std::optional<uint64_t> length_of(const RequestHead& head) {
  const std::string text = head.field("content-length");
  uint64_t length = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (text.empty() || fault != std::errc() || end != text.data() + text.size()) return {};
  return length;
}

}  // namespace

HttpExchange::HttpExchange(const WebOptions& options, int port, WebHandler handler)
    : options_(options), port_(port), handler_(std::move(handler)) {}

bool HttpExchange::refuse(WebStream& stream, int status, const std::string& why) {
  return send_text({.stream = stream, .stays = false, .has_body = true}, status, kText, why + "\n");
}

bool HttpExchange::is_our_name(const std::string& host) const {
  return std::ranges::any_of(options_.hosts,
                             [&](const std::string& name) { return host == fmt::format("{}:{}", name, port_); });
}

bool HttpExchange::is_upload(const RequestHead& head) const {
  return head.method == "POST" && !options_.upload.empty() && path_of(head) == options_.upload;
}

// Returns whether it requests the opener for the first time.
bool HttpExchange::opens(const WebStream& stream, const RequestHead& head) {
  return !options_.opener.empty() && head.method == "GET" && is_our_name(head.field("host")) &&
         same_secret(head.path, "/" + options_.opener) && stream.is_our_users() && !has_opened_.exchange(true);
}

std::string HttpExchange::refusal(const RequestHead& head, int& status) const {
  status = 405;
  const bool is_post = head.method == "POST";
  if (!is_post && head.method != "GET" && head.method != "HEAD") return "only GET and POST are supported";
  status = 403;
  const std::string host = head.field("host"), origin = head.field("origin");
  if (!is_our_name(host)) return "unknown host name";
  const char* const scheme = options_.certificate.empty() ? "http" : "https";
  if (!origin.empty() && origin != fmt::format("{}://{}", scheme, host)) return "requests from other sites are refused";
  status = 404;
  const size_t slash = head.path.find('/', 1);
  if (slash == std::string::npos || !same_secret(head.path.substr(1, slash - 1), options_.secret)) {
    return "open the address that ods view printed, all of it";
  }
  status = 411;
  const std::optional<uint64_t> length = length_of(head);
  if (!head.field("transfer-encoding").empty()) return "Content-Length is missing";
  if (!length) return is_post || head.fields.contains("content-length") ? "Content-Length is missing" : "";
  status = 413;
  return *length > (is_upload(head) ? options_.max_upload : options_.max_body) ? "that is too large" : "";
}

// Hands a body over in pieces. False: it does not come, or is not taken.
bool HttpExchange::read_body(WebStream& stream, std::string& bytes, uint64_t size,
                             const std::function<bool(std::string_view)>& take) {
  char piece[kPiece];
  while (size > 0) {
    if (bytes.empty()) {
      bytes.assign(piece, stream.read(piece, sizeof(piece), std::chrono::steady_clock::now() + kPatience));
    }
    const size_t count = std::min<uint64_t>(bytes.size(), size);
    if (count == 0 || !take(std::string_view(bytes).substr(0, count))) return false;
    bytes.erase(0, count);
    size -= count;
  }
  return true;
}

WebAnswer HttpExchange::ask(const WebRequest& request) const {
  try {
    return handler_(request);
  } catch (const ods::Error& error) {
    const bool by_user = error.kind() == ods::ErrorKind::kInput || error.kind() == ods::ErrorKind::kUsage;
    return {.status = by_user ? 400 : 500, .body = with_options(error.what()) + "\n"};
  } catch (const std::exception& error) {
    warn(error.what());  // other users of the network must not see the details
    return {.status = 500, .body = "that failed: the terminal of ods view shows why\n"};
  }
}

// Reads the body, into memory or a file. Otherwise sets the status that refuses it, or 0 if the client has gone.
int HttpExchange::receive(WebStream& stream, std::string& bytes, uint64_t length, WebRequest& request) {
  if (request.file.empty()) {
    const auto keep = [&](std::string_view piece) { return request.body.append(piece), true; };
    return read_body(stream, bytes, length, keep) ? 200 : 0;
  }
  const File file(open(request.file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR));
  int status = file.descriptor < 0 ? 500 : 0;
  const auto write_all = [&](std::string_view piece) {
    while (!piece.empty()) {
      const ssize_t written = write(file.descriptor, piece.data(), piece.size());
      if (written <= 0) return status = 500, false;
      piece.remove_prefix(static_cast<size_t>(written));
    }
    return true;
  };
  return status == 0 && read_body(stream, bytes, length, write_all) ? 200 : status;
}

bool HttpExchange::answer(WebStream& stream, std::string_view head_text, std::string& bytes) {
  const std::optional<RequestHead> head = read_request_head(head_text);
  if (!head) return refuse(stream, 400, "malformed request");
  if (opens(stream, *head)) {
    send_head({.stream = stream, .stays = false, .has_body = false}, 303, kText, 0,
              fmt::format("Location: /{}/\r\n", options_.secret));
    return false;
  }
  int status = 0;
  const std::string why = refusal(*head, status);
  if (!why.empty()) return refuse(stream, status, why);
  WebRequest request;
  request.is_post = head->method == "POST";
  request.path = path_of(*head);
  request.query = head->query;
  std::unique_lock<std::mutex> turn(uploads_, std::defer_lock);
  if (is_upload(*head)) {
    if (!turn.try_lock()) return refuse(stream, 503, "another file is being sent: try again after it");
    request.file = options_.upload_folder + "/upload";
  }
  const RemovedFile leftover{request.file};
  if (head->field("expect") == "100-continue" && !stream.write("HTTP/1.1 100 Continue\r\n\r\n", kPatience))
    return false;
  status = receive(stream, bytes, length_of(*head).value_or(0), request);
  if (status != 200) return status != 0 && refuse(stream, status, "there is no room for that file here");
  const WebAnswer answer = ask(request);
  const Reply reply{.stream = stream, .stays = head->stays, .has_body = head->method != "HEAD"};
  if (answer.file.empty() && is_worth_packing(answer) && takes_gzip(*head)) {
    return send_text(reply, answer.status, answer.type, ods::gzip(answer.body), "Content-Encoding: gzip\r\n");
  }
  if (answer.file.empty()) return send_text(reply, answer.status, answer.type, answer.body);
  return send_file(reply, answer, head->fields.contains("if-range") ? "" : head->field("range"));
}
