// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Closed sets: an enum, and one constexpr table with a row per member that starts with {member, name}. The table alone
// gives the name of a member, the look-up by name and the list of members:
//
//   enum class Tone { kNone, kFilmic };
//   inline constexpr NameRow<Tone> kToneTable[] = {{Tone::kNone, "none"}, {Tone::kFilmic, "filmic"}};
//   static_assert(has_every_member(kToneTable));
//
// A set with more data than names has its own row type, with `member` and `name` among its fields.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ods {

template <class Member>
struct NameRow {
  Member member;
  std::string_view name;
};

template <class Table>
using MemberOf = std::remove_cvref_t<decltype(std::declval<const Table&>()[0].member)>;

// The row of a member. Precondition: it has one.
template <class Row, size_t count>
constexpr const Row& row_in(const Row (&table)[count], MemberOf<Row[count]> member) {
  size_t i = 0;
  while (i + 1 < count && table[i].member != member) i++;
  return table[i];
}

// The name of a member. Empty if the member has no row.
template <class Row, size_t count>
constexpr std::string_view name_in(const Row (&table)[count], MemberOf<Row[count]> member) {
  const Row& row = row_in(table, member);
  return row.member == member ? row.name : std::string_view();
}

template <class Row, size_t count>
constexpr std::optional<MemberOf<Row[count]>> find_in(const Row (&table)[count], std::string_view name) {
  for (const Row& row : table) {
    if (row.name == name) return row.member;
  }
  return std::nullopt;
}

// All members, in the order of the table.
template <class Row, size_t count>
constexpr std::array<MemberOf<Row[count]>, count> members_of(const Row (&table)[count]) {
  std::array<MemberOf<Row[count]>, count> members{};
  for (size_t i = 0; i < count; i++) members[i] = table[i].member;
  return members;
}

// The names of all rows, in the order of the table, which may be any range of values with a `name`.
template <class Rows>
std::vector<std::string> names_of(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

// Returns whether each of the numbers 0 .. expected - 1 has a row and no two rows share a name; for sets whose size the
// kernel defines.
template <class Row, size_t count>
constexpr bool has_each_of(const Row (&table)[count], size_t expected) {
  for (size_t i = 0; i < expected; i++) {
    if (static_cast<size_t>(row_in(table, static_cast<MemberOf<Row[count]>>(i)).member) != i) return false;
  }
  for (size_t i = 0; i < count; i++) {
    for (size_t j = 0; j < i; j++) {
      if (table[i].name == table[j].name) return false;
    }
    if (table[i].name.empty()) return false;
  }
  return count == expected;
}

// Returns whether a value of an enum is one of its members. Compilers print `Tone::kNone` for a member, `(Tone)7` for
// others.
template <auto value>
constexpr bool is_enumerator() {
  const std::string_view text = __PRETTY_FUNCTION__;
  const size_t at = text.find("value = ") + 8;
  return text[at] != '(' && text[at] != '-' && (text[at] < '0' || text[at] > '9');
}

// The number of members of an enum that counts from 0 without gaps.
template <class Enum, size_t from = 0>
constexpr size_t enumerator_count() {
  if constexpr (is_enumerator<static_cast<Enum>(from)>()) {
    return enumerator_count<Enum, from + 1>();
  } else {
    return from;
  }
}

// Returns whether a table has one row, with a unique name, for each member of its enum, which counts from 0 without
// gaps. A static_assert of it fails if a member has no row.
template <class Row, size_t count>
constexpr bool has_every_member(const Row (&table)[count]) {
  return has_each_of(table, enumerator_count<MemberOf<Row[count]>>());
}

}  // namespace ods
