// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a program asks of the C library's allocator.
#pragma once

namespace ods {

// From now on, blocks of a megabyte or more go back to the system as soon as they are freed. By default glibc keeps
// ever larger ones (up to 32 MB) in its heap, where small blocks that follow pin them: decoding a large Draco mesh then
// takes 40 % more than is in use. It affects the whole process, so programs call it, once, at their start; the library
// never does. Without effect where the C library is not glibc.
void return_large_blocks();

// Gives back what is free between the blocks in use, in the heaps of all threads.
void return_free_memory();

}  // namespace ods
