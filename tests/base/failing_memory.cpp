// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/base/failing_memory.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> armed = false, lasting = false;
std::atomic<long> left = 0;  // allocations that succeed
std::atomic<size_t> failed = 0, smallest = 0;

bool fails(size_t size) {
  if (!armed || size < smallest) return false;
  const long before = left.fetch_sub(1);
  if (before > 0 || (before < 0 && !lasting)) return false;
  failed++;
  return true;
}

void* allocate(size_t size, size_t alignment) {
  if (fails(size)) return nullptr;
  size = size == 0 ? alignment : (size + alignment - 1) / alignment * alignment;
  return alignment <= alignof(std::max_align_t) ? std::malloc(size) : std::aligned_alloc(alignment, size);
}

void* allocate_or_throw(size_t size, size_t alignment) {
  void* memory = allocate(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void fail_allocations(long count, bool lasts, size_t bytes) {
  left = count, lasting = lasts, failed = 0, smallest = bytes;
  armed = true;
}

size_t allow_allocations() {
  armed = false;
  return failed;
}

void* operator new(size_t size) {
  return allocate_or_throw(size, alignof(std::max_align_t));
}
void* operator new[](size_t size) {
  return allocate_or_throw(size, alignof(std::max_align_t));
}
void* operator new(size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<size_t>(alignment));
}
void* operator new[](size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<size_t>(alignment));
}
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new[](size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, size_t, std::align_val_t) noexcept {
  std::free(memory);
}
