// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The lists of slots that the stages of a round read and fill (ods/render/gpu/shaders/shared.h). A stage has a thread
// for each slot of its list, so that no thread of a card idles.
const uint kListWords = 4u;

layout(local_size_x = kGroupSize) in;

shared uint added_here[kLists];  // by this work group
shared uint first_added[kLists];

int this_round(int lists) { return lists + call.parity; }
int next_round(int lists) { return lists + 1 - call.parity; }

uint length_of(int list) { return gpu_view.lists.at[kListWords * uint(list) + 3u]; }

// Empties a list that no other thread reads or fills in this stage.
void empty_list(int list) {
  if (gl_GlobalInvocationID.x != 0u) return;
  gpu_view.lists.at[kListWords * uint(list)] = 1u;  // a work group that empties lists
  gpu_view.lists.at[kListWords * uint(list) + 3u] = 0u;
}

// The slot of this thread.
uint listed_slot(int list) {
  return gpu_view.slots_in_lists.at[uint(list) * gpu_view.slot_count + gl_GlobalInvocationID.x];
}

// Adds this thread's slot to a list, unless it is kNoList. All threads of the work group call it, once.
void append(uint slot, int list) {
  uint here = gl_LocalInvocationID.x;
  if (here < uint(kLists)) added_here[here] = 0u;
  barrier();
  uint place = 0u;
  if (list != kNoList) place = atomicAdd(added_here[list], 1u);
  barrier();
  if (here < uint(kLists) && added_here[here] > 0u) {
    uint before = atomicAdd(gpu_view.lists.at[kListWords * here + 3u], added_here[here]);
    uint groups = (before + added_here[here] + uint(kGroupSize) - 1u) / uint(kGroupSize);
    atomicMax(gpu_view.lists.at[kListWords * here], groups);
    first_added[here] = before;
  }
  barrier();
  if (list != kNoList) {
    gpu_view.slots_in_lists.at[uint(list) * gpu_view.slot_count + first_added[list] + place] = slot;
  }
}
