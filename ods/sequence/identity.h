// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The settings that frames and pictures depend on. Only work with equal settings is resumed: frames with the same
// identity may be in one video, samples with the same identity in one picture. For every member of SequenceOptions, and
// of the structures in it, the table in identity.cpp has whether it is part of the identity, and why.
#pragma once
#include <string>
#include <string_view>

#include "ods/base/settings.h"
#include "ods/sequence/sequence.h"

namespace ods {

// Returns the identity of the frames of a sequence, whatever their numbers. Names in backticks are options.
Settings frame_identity(const SequenceOptions& options);

// Returns the identity of the samples of a still picture at a time, in seconds: without settings that only its file
// depends on, or that may change while it is rendered. Parts of one picture differ in kPartSetting.
Settings sample_identity(const SequenceOptions& options, double seconds);
inline constexpr std::string_view kPartSetting = "`part`";

// Returns the options that samples depend on: the part of sample_identity() for pictures that are not of a sequence.
Settings render_settings(const RenderOptions& options);

// The value of a setting that look_first() finds. For frames that depend on it, VideoJournal records the value found.
inline constexpr std::string_view kByFirstLook = "by a first look";
inline constexpr std::string_view kExposureSetting = "`exposure`", kMergeSetting = "merge by depth";

// Returns a setting that identifies a file by its contents: a copy has the same one. confine: as in SceneOptions. A
// missing file also has a value, because reading the scene reports it. Throws Error(kInput).
Setting file_setting(const std::string& name, const std::string& path, const std::string& confine = {});

// Returns the settings that identify the input of load_scene(): a built-in scene, or a file and the files that it
// refers to. Throws as gltf_files() does.
Settings scene_settings(const std::string& name_or_path, const std::string& confine = {});

}  // namespace ods
