// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts floats to the decimals that people typed.
#pragma once

namespace ods {

// The shortest decimal that rounds to this float: 0.065, not 0.06499999761581421.
// Converting it back gives the same bits.
double decimal(float value);

}  // namespace ods
