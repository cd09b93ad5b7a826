#include "session.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>

namespace quadrille::viewer {
namespace {

using Action = std::function<KeyEffect(Session&)>;

Action changing(std::function<void(Session&)> change) {
  return [change = std::move(change)](Session& session) {
    change(session);
    return KeyEffect::redraw;
  };
}

Action asking(KeyEffect effect) {
  return [effect](Session&) { return effect; };
}

const std::map<std::string, Action>& actions() {
  static const Action fit = changing([](Session& s) { s.view.fit(); });
  static const Action help = changing([](Session& s) { s.help = !s.help; });
  static const Action fainter = changing([](Session& s) { s.layers.change_opacity(-1); });
  static const Action stronger = changing([](Session& s) { s.layers.change_opacity(1); });
  static const Action next = changing([](Session& s) { s.layers.select_next(1); });
  static const auto zoom = [](double to) {
    return changing([to](Session& s) { s.view.zoom_to(to); });
  };
  static const std::map<std::string, Action> kActions = {
      {"f", fit},
      {"1", zoom(1)},
      {"2", zoom(2)},
      {"4", zoom(4)},
      {"8", zoom(8)},
      {"c", changing([](Session& s) { s.comparing = !s.comparing; })},
      {"Tab", next},
      {"Down", next},
      {"Up", changing([](Session& s) { s.layers.select_next(-1); })},
      {"minus", fainter},
      {"bracketleft", fainter},
      {"plus", stronger},
      {"equal", stronger},
      {"bracketright", stronger},
      {"h", help},
      {"question", help},
      {"b", changing([](Session& s) { s.panels = !s.panels; })},
      {"s", asking(KeyEffect::save)},
      {"Escape", asking(KeyEffect::cancel)},
      {"q", asking(KeyEffect::quit)},
  };
  return kActions;
}

}  // namespace

int Session::divider_column() const {
  return static_cast<int>(std::lround(divider * view.window().x()));
}

void Session::move_divider(int column) {
  divider = std::clamp(static_cast<double>(column) / view.window().x(), 0.0, 1.0);
}

bool Session::on_divider(int column) const {
  constexpr int kGrip = 6;
  return comparing && std::abs(column - divider_column()) <= kGrip;
}

KeyEffect Session::press(const std::string& key) {
  if (const auto action = actions().find(key); action != actions().end()) {
    return action->second(*this);
  }
  return key.size() == 1 && layers.toggle(key[0]) ? KeyEffect::redraw : KeyEffect::none;
}

const std::string& key_help() {
  static const std::string kHelp =
      "drag                  move the picture\n"
      "wheel                 zoom at the cursor\n"
      "click                 numbers of a patch or vertex\n"
      "f                     fit the picture to the window\n"
      "1 2 4 8               zoom 1:1, 2:1, 4:1, 8:1\n"
      "p o e l n m t v x i   show and hide a layer\n"
      "Up Down               select a layer\n"
      "- +                   fade it, strengthen it\n"
      "c                     compare: drag the divider\n"
      "Esc                   stop vectorizing, or let go a click\n"
      "s                     save the view as PNG\n"
      "b                     show and hide lists and sliders\n"
      "h ?                   this help\n"
      "q                     quit";
  return kHelp;
}

}  // namespace quadrille::viewer
