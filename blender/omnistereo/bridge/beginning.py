# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""The beginning of a film, exported alone: it is rendered while another Blender still follows the rest.

Its frames have the same places and points as in the export of the whole. It also has the frames by which ods chooses
the exposure of the film.
"""
LOOKS = 5  # as many as ods::kLooks (ods/sequence/looks.h), at the same frames
REACH = 2  # frames around a frame that its denoiser and its shutter see


class Beginning:
    """frames: how many are rendered; first, last: of the film's frames, as Blender counts; None: the file's."""

    def __init__(self, frames, first=None, last=None):
        self.frames, self.first, self.last = frames, first, last

    def needed(self, start, count, saved, step, simulated):
        """The numbers of the frames to evaluate, of `count` from 0 on. step: of the points, every n-th frame is kept.
        The second result: those up to which a simulation must run through all frames. Later it stands still, so one
        frame after another is not asked for there: Blender would compute it."""
        first = min(max((start if self.first is None else self.first) - start, 0), count - 1)
        last = min(max((start + count - 1 if self.last is None else self.last) - start, first), count - 1)
        looks = {first + (2 * i + 1) * (last - first + 1) // (2 * LOOKS) for i in range(LOOKS)}
        shown = {n for n in range(first - 1, first + self.frames + REACH) if 0 <= n < count}
        between = shown if simulated else shown | looks
        kept = {n for each in between for n in (each // step * step, min(-(-each // step) * step, count - 1))}
        return shown | looks | kept | {0, saved, count - 1}, max(*shown, saved)
