// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ODS_WIDE before a function compiles it for any x86-64 processor and again for those with AVX2, whose registers hold
// eight numbers instead of four. The loader chooses. Both give the same bits: AVX2 alone fuses no multiplication with
// an addition, and the compiler's flags forbid reordering.
#pragma once

// Sanitizers are not initialized yet when the loader chooses; clang has other rules for inlining.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ODS_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define ODS_WIDE
#endif
