// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/http/certificate.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"

namespace {

constexpr long kDays = 825;  // the longest that Apple's browsers accept
constexpr int kSecondsOfDay = 86400;

using KeyPointer = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using CertificatePointer = std::unique_ptr<X509, decltype(&X509_free)>;
using FilePointer = std::unique_ptr<std::FILE, decltype(&std::fclose)>;

[[noreturn]] void fail(const std::string& path) {
  throw ods::Error(ods::ErrorKind::kOutput, fmt::format("cannot make a certificate in '{}'", path));
}

bool is_address(const std::string& name) {
  return std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) || c == '.'; });
}

bool covers(X509* certificate, const std::string& name) {
  return is_address(name) ? X509_check_ip_asc(certificate, name.c_str(), 0) == 1
                          : X509_check_host(certificate, name.data(), name.size(), 0, nullptr) == 1;
}

bool is_good(const Certificate& kept, const std::vector<std::string>& names) {
  const FilePointer file(std::fopen(kept.path.c_str(), "rb"), &std::fclose);
  if (!file || !std::filesystem::exists(kept.key)) return false;
  const CertificatePointer certificate(PEM_read_X509(file.get(), nullptr, nullptr, nullptr), &X509_free);
  if (!certificate) return false;
  time_t month_ahead = std::time(nullptr) + 30 * kSecondsOfDay;
  if (X509_cmp_time(X509_get0_notAfter(certificate.get()), &month_ahead) <= 0) return false;
  return std::ranges::all_of(names, [&](const std::string& name) { return covers(certificate.get(), name); });
}

void add_extension(X509* certificate, int kind, const std::string& text) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* const extension = X509V3_EXT_conf_nid(nullptr, &context, kind, text.c_str());
  if (!extension) fail(text);
  X509_add_ext(certificate, extension, -1);
  X509_EXTENSION_free(extension);
}

CertificatePointer make_certificate(EVP_PKEY* key, const std::vector<std::string>& names) {
  CertificatePointer certificate(X509_new(), &X509_free);
  X509_set_version(certificate.get(), X509_VERSION_3);
  uint64_t serial = 0;
  RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof(serial));
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate.get()), serial >> 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -kSecondsOfDay);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), kDays * kSecondsOfDay);
  X509_set_pubkey(certificate.get(), key);
  X509_NAME* const name = X509_get_subject_name(certificate.get());
  const auto* const words = reinterpret_cast<const unsigned char*>("ods view");
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, words, -1, -1, 0);
  X509_set_issuer_name(certificate.get(), name);
  std::string alternatives;
  for (const std::string& each : names) {
    alternatives += fmt::format("{}{}:{}", alternatives.empty() ? "" : ",", is_address(each) ? "IP" : "DNS", each);
  }
  add_extension(certificate.get(), NID_subject_alt_name, alternatives);
  add_extension(certificate.get(), NID_basic_constraints, "critical,CA:FALSE");
  add_extension(certificate.get(), NID_ext_key_usage, "serverAuth");
  X509_sign(certificate.get(), key, EVP_sha256());
  return certificate;
}

}  // namespace

Certificate keep_certificate(const std::string& folder, const std::vector<std::string>& names) {
  const Certificate kept{folder + "/certificate.pem", folder + "/key.pem"};
  if (is_good(kept, names)) return kept;
  const KeyPointer key(EVP_EC_gen("P-256"), &EVP_PKEY_free);
  if (!key) fail(folder);
  const CertificatePointer certificate = make_certificate(key.get(), names);
  std::list<ods::AtomicFile> files;
  ods::AtomicFile& secret = files.emplace_back(kept.key);
  if (fchmod(fileno(secret.stream()), S_IRUSR | S_IWUSR) != 0) fail(folder);
  ods::AtomicFile& open = files.emplace_back(kept.path);
  if (PEM_write_PrivateKey(secret.stream(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1 ||
      PEM_write_X509(open.stream(), certificate.get()) != 1) {
    fail(folder);
  }
  commit_all(files);
  return kept;
}

std::string random_secret() {
  unsigned char bytes[16];
  if (RAND_bytes(bytes, sizeof(bytes)) != 1) fail("memory");
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}
