// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The settings that frames and pictures depend on. Only work with equal settings is resumed: frames with the same
// identity may stand in one video, samples with the same identity in one picture. The table in identity.cpp decides for
// every member of SequenceOptions, and of the structures in it, whether it is part of that, and says why.
#pragma once
#include <string>
#include <string_view>

#include "ods/base/settings.h"
#include "ods/sequence/sequence.h"

namespace ods {

// Names are options where they are in backticks. Of a frame of a sequence, whatever its number.
Settings frame_identity(const SequenceOptions& options);

// Of the samples of a still picture at a time, in seconds: without settings that only its file depends on, or that may
// change while it is rendered. Parts of one picture differ in kPartSetting.
Settings sample_identity(const SequenceOptions& options, double seconds);
inline constexpr std::string_view kPartSetting = "`part`";

// The value of a setting that look_first() finds: of frames that depend on it, VideoJournal keeps what was found.
inline constexpr std::string_view kByFirstLook = "by a first look";
inline constexpr std::string_view kExposureSetting = "`exposure`", kMergeSetting = "merge by depth";

// A file, by its contents: a copy is the same file. confine: as in SceneOptions. A missing file is a value, too:
// reading the scene reports it. Throws Error(kInput).
Setting file_setting(const std::string& name, const std::string& path, const std::string& confine = {});

// What load_scene() reads: a built-in scene, or a file and those that it refers to. Throws as gltf_files().
Settings scene_settings(const std::string& name_or_path, const std::string& confine = {});

}  // namespace ods
