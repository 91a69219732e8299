// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Settings of the C library's allocator.
#pragma once

namespace ods {

// From now on, returns blocks of a megabyte or more to the system as soon as they are freed. By default glibc keeps
// increasingly large ones (up to 32 MB) in its heap, where small blocks behind them pin them: decoding a large Draco
// mesh then takes 40 % more memory than it uses. This affects the whole process, so programs call it once when they
// start; the library never does. No effect without glibc.
void return_large_blocks();

// Returns free memory between used blocks to the system, in the heaps of all threads.
void return_free_memory();

}  // namespace ods
