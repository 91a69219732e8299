// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A disk that has neither hard links nor the flags of renameat2(), as some network shares have none.
#pragma once

// While it is true, link() and those flags fail in this program.
extern bool poor_disk;
