// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/channel_layers.h"

#include <algorithm>

#include "ods/base/text.h"

namespace ods {

std::pair<std::string, std::string> split_name(const std::string& channel) {
  const size_t point = channel.rfind('.');
  if (point == std::string::npos) return {"", channel};
  return {channel.substr(0, point), channel.substr(point + 1)};
}

LayerRule rule_of(const std::string& layer, const std::string& channel, bool is_whole_number) {
  static const char* const kWords[] = {"z", "zback", "depth", "id", "ids", "index", "object", "material", "variance"};
  const std::string group = small_letters(layer), last = split_name(group).second;
  const bool packed = last.size() > 2 && last.find_first_not_of("0123456789", last.size() - 2) == std::string::npos;
  bool nearest = is_whole_number || packed || group.find("crypto") != std::string::npos || last.starts_with("index");
  for (const std::string& name : {last, small_letters(channel), group.substr(0, group.find('.'))}) {
    nearest = nearest || std::find(std::begin(kWords), std::end(kWords), name) != std::end(kWords);
  }
  // Normals and positions also have a Z.
  if (small_letters(channel) == "z" && !layer.empty() && last != "depth" && last != "z") nearest = packed;
  return nearest ? LayerRule::kNearest : LayerRule::kMean;
}

ViewChannels channels_of_view(const FileInfo& info, const std::string& view, bool is_default) {
  ViewChannels channels;
  for (size_t c = 0; c < info.channels.size(); c++) {
    const auto [layer, last] = split_name(info.channels[c]);
    const auto [outer, inner] = split_name(layer);
    if (view.empty() || (is_default && layer.empty())) {
      channels.emplace(info.channels[c], c);
    } else if (inner == view) {
      channels.emplace(outer.empty() ? last : outer + "." + last, c);
    }
  }
  return channels;
}

static std::optional<ChannelLayer> take_color_of(ViewChannels& channels, const std::string& layer) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  ChannelLayer light;
  light.name = layer;
  light.rule = LayerRule::kLight;
  const auto take = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) {
      if (!channels.contains(prefix + name)) return false;
    }
    for (const char* name : names) light.from.push_back(channels.at(prefix + name));
    for (const char* name : names) channels.erase(prefix + name);
    return true;
  };
  if (!take({"R", "G", "B"})) {
    if (!take({"Y"})) return std::nullopt;
    light.from = {light.from[0], light.from[0], light.from[0]};
  }
  take({"A"});
  light.channels = {"R", "G", "B", "A"};
  light.channels.resize(light.from.size());
  return light;
}

std::optional<ChannelLayer> take_color(ViewChannels& channels) {
  if (std::optional<ChannelLayer> light = take_color_of(channels, "")) return light;
  for (const auto& [name, number] : channels) {
    const std::string layer = split_name(name).first;
    if (split_name(layer).second == "Combined") return take_color_of(channels, layer);
  }
  return std::nullopt;
}

std::vector<ChannelLayer> other_layers(const ViewChannels& channels, const RowReader& reader) {
  const FileInfo& info = reader.info();
  std::map<size_t, std::string> ordered;
  for (const auto& [name, number] : channels) ordered[number] = name;
  std::vector<ChannelLayer> layers;
  for (const auto& [number, name] : ordered) {
    const auto [layer, last] = split_name(name);
    const LayerRule rule = rule_of(layer, last, reader.is_whole_number(number));
    const bool joins = !layers.empty() && !layer.empty() && layers.back().name == layer && layers.back().rule == rule &&
                       layers.back().sample == info.samples[number];
    if (!joins) layers.push_back({layer, {}, {}, rule, info.samples[number]});
    layers.back().channels.push_back(name);
    layers.back().from.push_back(number);
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const ChannelLayer& a, const ChannelLayer& b) { return a.channels[0] < b.channels[0]; });
  return layers;
}

}  // namespace ods
