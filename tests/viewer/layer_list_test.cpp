#include "layer_list.h"

#include <gtest/gtest.h>

#include <set>

#include "quadrille/error.h"
#include "session.h"

namespace quadrille::viewer {
namespace {

TEST(LayerList, EveryLayerHasAKeyAndANameOfItsOwn) {
  std::set<char> keys;
  std::set<std::string> names;
  for (int i = 0; i < kLayerCount; ++i) {
    EXPECT_EQ(layer_infos()[i].id, static_cast<LayerId>(i));
    keys.insert(layer_infos()[i].key);
    names.insert(layer_infos()[i].name);
  }
  EXPECT_EQ(keys.size(), kLayerCount);
  EXPECT_EQ(names.size(), kLayerCount);
}

TEST(LayerList, NoKeyOfALayerMeansSomethingElse) {
  for (const LayerInfo& info : layer_infos()) {
    Session session{View({10, 10}, {10, 10})};
    const bool before = session.layers.shown(info.id);
    EXPECT_EQ(session.press(std::string(1, info.key)), KeyEffect::redraw);
    EXPECT_NE(session.layers.shown(info.id), before) << info.name;
    EXPECT_EQ(session.layers.selected(), info.id);
  }
}

TEST(LayerList, OpacityStaysBetweenATenthAndOne) {
  LayerList layers;
  for (int i = 0; i < 20; ++i) layers.change_opacity(-1);
  EXPECT_EQ(layers.opacity(LayerId::picture), 0.1);
  for (int i = 0; i < 20; ++i) layers.change_opacity(1);
  EXPECT_EQ(layers.opacity(LayerId::picture), 1.0);
}

TEST(LayerList, SelectionGoesAround) {
  LayerList layers;
  for (int i = 0; i < kLayerCount; ++i) layers.select_next(1);
  EXPECT_EQ(layers.selected(), LayerId::picture);
  layers.select_next(-1);
  EXPECT_EQ(layers.selected(), LayerId::source);
  layers.select_next(-1);
  EXPECT_EQ(layers.selected(), LayerId::singularities);
}

TEST(ParseLayers, ShowsExactlyThoseNamed) {
  const LayerList layers = parse_layers("patches:0.5,cross-field");
  for (const LayerInfo& info : layer_infos()) {
    EXPECT_EQ(layers.shown(info.id),
              info.id == LayerId::patches || info.id == LayerId::cross_field);
  }
  EXPECT_EQ(layers.opacity(LayerId::patches), 0.5);
}

TEST(ParseLayers, RefusesWhatIsNoList) {
  for (const char* text : {"", "pictures", "picture,", "picture:", "picture:2", "picture:0.5x"}) {
    EXPECT_THROW(parse_layers(text), Error) << text;
  }
}

TEST(Session, KeysAskForWhatTheyShould) {
  Session session{View({100, 50}, {200, 200})};
  EXPECT_EQ(session.press("s"), KeyEffect::save);
  EXPECT_EQ(session.press("q"), KeyEffect::quit);
  EXPECT_EQ(session.press("Escape"), KeyEffect::cancel);
  EXPECT_EQ(session.press("w"), KeyEffect::none);
  EXPECT_EQ(session.press("F5"), KeyEffect::none);
  for (const auto& [key, zoom] :
       {std::pair{"1", 1.0}, {"2", 2.0}, {"4", 4.0}, {"8", 8.0}, {"f", 2.0}}) {
    EXPECT_EQ(session.press(key), KeyEffect::redraw);
    EXPECT_EQ(session.view.zoom(), zoom) << key;
  }
  session.press("question");
  EXPECT_TRUE(session.help);
  session.press("h");
  EXPECT_FALSE(session.help);
  session.press("b");
  EXPECT_FALSE(session.panels);
}

TEST(Session, TheDividerStaysInTheWindow) {
  Session session{View({100, 50}, {200, 200})};
  EXPECT_FALSE(session.on_divider(100)) << "it is not shown";
  session.press("c");
  EXPECT_TRUE(session.on_divider(100));
  session.move_divider(-30);
  EXPECT_EQ(session.divider_column(), 0);
  session.move_divider(500);
  EXPECT_EQ(session.divider_column(), 200);
}

}  // namespace
}  // namespace quadrille::viewer
