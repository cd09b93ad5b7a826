#include "quadrille/utf8_text.h"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

TEST(Utf8Text, ValidTextStays) {
  for (const std::string text :
       {"", "a", "Gr\xC3\xBC\xC3\x9F", "\xE2\x82\xAC", "\xF0\x9F\x98\x80"}) {
    EXPECT_EQ(valid_utf8(text), text);
  }
}

TEST(Utf8Text, EachByteOfNoCharacterIsReplaced) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(valid_utf8("a\xFFz"), "a" + mark + "z");
  EXPECT_EQ(valid_utf8("\xC3("), mark + "(");                            // cut short
  EXPECT_EQ(valid_utf8("\xE2\x82"), mark + mark);                        // at the end
  EXPECT_EQ(valid_utf8("\xC0\xAF"), mark + mark);                        // overlong
  EXPECT_EQ(valid_utf8("\xED\xA0\x80"), mark + mark + mark);             // a surrogate
  EXPECT_EQ(valid_utf8("\xF4\x90\x80\x80"), mark + mark + mark + mark);  // beyond U+10FFFF
}

TEST(Utf8Text, WhatXmlForbidsIsReplacedAsAWhole) {
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(valid_utf8("a\xEF\xBF\xBEz\xEF\xBF\xBF"), "a" + mark + "z" + mark);
  EXPECT_EQ(valid_utf8(mark), mark);
  EXPECT_EQ(valid_utf8("\xEF\xBE\xBF"), "\xEF\xBE\xBF");  // U+FFBF is allowed
}

}  // namespace
}  // namespace quadrille
