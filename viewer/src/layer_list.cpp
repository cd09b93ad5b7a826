#include "layer_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "quadrille/error.h"

namespace quadrille::viewer {
namespace {

std::string all_names() {
  std::string names;
  for (const LayerInfo& info : layer_infos())
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

std::optional<double> parse_opacity(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!(value >= 0.1 && value <= 1)) return std::nullopt;
  return value;
}

}  // namespace

const std::array<LayerInfo, kLayerCount>& layer_infos() {
  static constexpr std::array<LayerInfo, kLayerCount> kInfos = {{
      {LayerId::source, 'o', "source", "source (original)"},
      {LayerId::picture, 'p', "picture", "picture"},
      {LayerId::error, 'e', "error", "error"},
      {LayerId::scales, 'l', "scales", "scales (lengths)"},
      {LayerId::control_net, 'n', "control-net", "control net"},
      {LayerId::patches, 'm', "patches", "patches (mesh)"},
      {LayerId::tears, 't', "tears", "tears"},
      {LayerId::irregular_vertices, 'v', "irregular-vertices", "irregular vertices"},
      {LayerId::cross_field, 'x', "cross-field", "cross field"},
      {LayerId::singularities, 'i', "singularities", "singularities"},
  }};
  return kInfos;
}

void LayerList::set_opacity(LayerId id, double opacity) {
  state(id).tenths = std::clamp(static_cast<int>(std::lround(10 * opacity)), 1, 10);
}

bool LayerList::toggle(char key) {
  const auto info = std::ranges::find(layer_infos(), key, &LayerInfo::key);
  if (info == layer_infos().end()) return false;
  selected_ = info->id;
  set_shown(selected_, !shown(selected_));
  return true;
}

void LayerList::select_next(int step) {
  const int next = static_cast<int>(selected_) + step;
  selected_ = static_cast<LayerId>((next % kLayerCount + kLayerCount) % kLayerCount);
}

void LayerList::change_opacity(int tenths) {
  set_opacity(selected_, opacity(selected_) + tenths / 10.0);
}

LayerList parse_layers(std::string_view text) {
  LayerList layers;
  layers.set_shown(LayerId::picture, false);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string_view item = text.substr(begin, comma - begin);
    const std::size_t colon = std::min(item.find(':'), item.size());
    const auto info = std::ranges::find_if(layer_infos(), [&](const LayerInfo& candidate) {
      return item.substr(0, colon) == candidate.name;
    });
    if (info == layer_infos().end()) {
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("there is no layer '{}'; choose among {}", item.substr(0, colon),
                              all_names()));
    }
    layers.set_shown(info->id, true);
    if (colon < item.size()) {
      const auto opacity = parse_opacity(item.substr(colon + 1));
      if (!opacity) {
        throw Error(
            ErrorCode::invalid_argument,
            fmt::format("'{}' is not an opacity; give one from 0.1 to 1", item.substr(colon + 1)));
      }
      layers.set_opacity(info->id, *opacity);
    }
    begin = comma + 1;
  }
  return layers;
}

}  // namespace quadrille::viewer
