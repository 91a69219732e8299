// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Floats as people typed them.
#pragma once

namespace ods {

// The shortest decimal that is this float: 0.065, not 0.06499999761581421. Back as a float it has the same bits.
double decimal(float value);

}  // namespace ods
