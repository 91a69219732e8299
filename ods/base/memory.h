// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Available memory. Linux overcommits, and kills processes that use the memory that it promised.
#pragma once
#include <cstddef>
#include <string>

namespace ods {

// Bytes that this process can still allocate without being killed: the minimum of the kernel's MemAvailable, the limits
// of the enclosing control groups (versions 1 and 2) and the address space limit (ulimit -v). SIZE_MAX if none is
// known. Reads the system's files below `root`, which tests set.
size_t available_memory(const std::string& root = "");

// Requests below this are not checked: for thousands of small pictures the check costs more than it saves.
inline constexpr size_t kSmallMemory = size_t{8} << 20;

// Throws Error(kMemory) if `what` needs more bytes than are available. The message gives both numbers and `advice`.
void check_memory(size_t bytes, const std::string& what, const std::string& advice);

// "12.9 GB", "35 MB".
std::string bytes_text(size_t bytes);

}  // namespace ods
