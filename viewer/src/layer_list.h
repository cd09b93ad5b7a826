#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace quadrille::viewer {

/// What can be shown, from the ground up.
enum class LayerId {
  source,
  picture,
  error,
  scales,
  control_net,
  patches,
  tears,
  irregular_vertices,
  cross_field,
  singularities,
};
inline constexpr int kLayerCount = 10;

struct LayerInfo {
  LayerId id;
  char key;          ///< that shows and hides it
  const char* name;  ///< for the command line
  const char* title;
};
const std::array<LayerInfo, kLayerCount>& layer_infos();

/// Which layers are shown, how strongly, and which one the opacity keys change.
class LayerList {
 public:
  /// The picture alone.
  LayerList() { set_shown(LayerId::picture, true); }

  bool shown(LayerId id) const { return state(id).shown; }
  void set_shown(LayerId id, bool shown) { state(id).shown = shown; }
  double opacity(LayerId id) const { return state(id).tenths / 10.0; }
  void set_opacity(LayerId id, double opacity);
  LayerId selected() const { return selected_; }

  /// Shows or hides the layer of a key, and selects it; false when no layer has this key.
  bool toggle(char key);
  /// Selects the next layer of the list, or the one before.
  void select_next(int step);
  /// Changes the selected layer's opacity by tenths, 0.1 to 1.
  void change_opacity(int tenths);

 private:
  struct State {
    bool shown = false;
    int tenths = 10;
  };
  State& state(LayerId id) { return states_[static_cast<int>(id)]; }
  const State& state(LayerId id) const { return states_[static_cast<int>(id)]; }

  std::array<State, kLayerCount> states_;
  LayerId selected_ = LayerId::picture;
};

/// "picture,patches:0.5": exactly these layers are shown, with opacities where given. Throws
/// Error{invalid_argument} that names the layers for a wrong list.
LayerList parse_layers(std::string_view text);

}  // namespace quadrille::viewer
