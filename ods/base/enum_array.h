// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// An array with a value for each member of a closed set (names.h), indexed by the member.
#pragma once
#include <array>
#include <cstddef>

#include "ods/base/names.h"

namespace ods {

// Precondition: the enum counts from 0 without gaps.
template <class Enum, class Value>
struct EnumArray : std::array<Value, enumerator_count<Enum>()> {
  using Base = std::array<Value, enumerator_count<Enum>()>;
  constexpr Value& operator[](Enum member) { return Base::operator[](static_cast<size_t>(member)); }
  constexpr const Value& operator[](Enum member) const { return Base::operator[](static_cast<size_t>(member)); }
};

}  // namespace ods
