#pragma once

#include <optional>
#include <string>

#include "layer_list.h"
#include "pick.h"
#include "view.h"

namespace quadrille::viewer {

/// What a key asks of the window, beside what it changed in the session.
enum class KeyEffect {
  none,  ///< no such key
  redraw,
  save,    ///< the view as a PNG file
  cancel,  ///< the computation under way
  quit,
};

/// All that decides what the window shows of its subject.
struct Session {
  View view;
  LayerList layers;
  bool comparing = false;
  double divider = 0.5;  ///< share of the window left of the compare slider
  bool help = false;
  bool panels = true;
  std::optional<Pick> picked;

  /// The first column of the window right of the compare slider.
  int divider_column() const;
  void move_divider(int column);
  /// True within the grip of a compare slider that is shown.
  bool on_divider(int column) const;

  /// A key by its X11 name, such as "p", "question" or "Up".
  KeyEffect press(const std::string& key);
};

/// The help that is shown on screen; one line per group of keys.
const std::string& key_help();

}  // namespace quadrille::viewer
