// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How much memory there is to take. Linux promises more than it has and kills who believes it.
#pragma once
#include <cstddef>
#include <string>

namespace ods {

// Bytes that this process may still take without being killed: what the kernel calls available, what the control groups
// around the process (versions 1 and 2) leave, and what its limit of address space (ulimit -v) leaves, whichever is
// least. SIZE_MAX where none of them says. Files are looked for below root, which is for tests.
size_t available_memory(const std::string& root = "");

// So little can be asked for unasked: finding out takes longer than it is worth for thousands of small pictures.
inline constexpr size_t kSmallMemory = size_t{8} << 20;

// Throws Error(kMemory) where `what` needs more bytes than are available: how much, of how much, and what to try.
void check_memory(size_t bytes, const std::string& what, const std::string& advice);

// "12.9 GB", "35 MB".
std::string bytes_text(size_t bytes);

}  // namespace ods
