// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Chooses the device that renders: the CPU, or a graphics card through Vulkan.
#pragma once
#include <memory>
#include <string>

#include "ods/render/gpu/gpu_device.h"
#include "ods/render/renderer.h"
#include "ods/scene/scene.h"

namespace ods {

struct DeviceChoice {
  int gpu = -1;      // RenderOptions::gpu; -1 for the CPU
  std::string name;  // "CPU", or the card's name
  std::string why;   // the reason for the choice
};

// The device that a word of the user names: "cpu"; "gpu", the best card that can render, software if there is no other;
// "auto", the best card of hardware that can render, else the CPU; the number of a card in list_gpus(), or a part of
// its name. Discrete cards are better than integrated ones. Throws Error(kDevice) if there is no such device, or it
// cannot render.
DeviceChoice choose_device(const std::string& word);

// choose_device() for a list of cards.
DeviceChoice choose_among(const GpuList& list, const std::string& word);

// Prepares a scene on options.gpu, with options.shader_cache, or on the CPU with options.threads. The scene must
// outlive the result. Throws Error(kDevice) for a card that fails, or is too small for the scene.
std::unique_ptr<Renderer> make_renderer(const Scene& scene, const RenderOptions& options);

}  // namespace ods
