// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Assigns the channels of a file to layers and eyes by their names. `right.N.X` and `N.right.X` are channel X of layer
// N of the right view.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ods/image/image_file.h"
#include "ods/picture/picture.h"

namespace ods {

struct ChannelLayer {
  std::string name;                   // N, albedo; empty for the colour and for single channels
  std::vector<std::string> channels;  // without the view
  std::vector<size_t> from;           // their indices in the file
  LayerRule rule = LayerRule::kMean;
  SampleType sample = SampleType::kUint8;
};

// `ViewLayer.Depth.Z` is Z of ViewLayer.Depth.
std::pair<std::string, std::string> split_name(const std::string& channel);

// Depth, ids, indices, materials, variance and cryptomatte use the nearest pixel; all other layers are averaged.
LayerRule rule_of(const std::string& layer, const std::string& channel, bool is_whole_number);

// The channels of one view: name without the view, index in the file.
using ViewChannels = std::map<std::string, size_t>;

// Bare names belong to the view that `is_default`. A file of one view ("") has all of them.
ViewChannels channels_of_view(const FileInfo& info, const std::string& view, bool is_default);

// R, G, B and perhaps A of the colour; Y and A of grey files; otherwise the layer that ends in Combined. Removes them
// from `channels`.
std::optional<ChannelLayer> take_color(ViewChannels& channels);

// The remaining layers: channels in the order of the file, layers in the order of their names, the same in both views.
std::vector<ChannelLayer> other_layers(const ViewChannels& channels, const RowReader& reader);

}  // namespace ods
