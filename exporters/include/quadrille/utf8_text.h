#pragma once

#include <string>
#include <string_view>

namespace quadrille {

/// The text with U+FFFD in place of each byte that belongs to no character in UTF-8 (Unicode 15,
/// table 3-7), and of each U+FFFE and U+FFFF, which XML forbids: names of files are any bytes.
std::string valid_utf8(std::string_view text);

}  // namespace quadrille
