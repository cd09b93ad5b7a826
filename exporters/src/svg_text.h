#pragma once

#include <string>
#include <string_view>

namespace quadrille {

/// Shortest decimal form that reads back as the same number, whatever the locale.
std::string to_text(double number);
std::string to_text(long long number);

/// The number rounded to `digits` decimals, as short as SVG allows: ".5", "-.25", "1".
std::string to_short_text(double number, int digits);

/// The text with &, <, > and " as XML entities, in valid UTF-8 and without
/// characters that XML forbids.
std::string xml_escaped(std::string_view text);

/// The head of an SVG document of width x height pixels, up to and with its title.
std::string svg_head(double width, double height, std::string_view title);

/// A short XML name for each number from 0 on.
std::string short_identifier(long long number);

}  // namespace quadrille
