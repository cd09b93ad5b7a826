#include "svg_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include "quadrille/utf8_text.h"

namespace quadrille {
namespace {

template <class T>
std::string decimal(T number) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return {buffer.data(), end};
}

}  // namespace

std::string to_text(double number) { return decimal(number); }
std::string to_text(long long number) { return decimal(number); }

std::string to_short_text(double number, int digits) {
  long long power = 1;
  for (int i = 0; i < digits; ++i) power *= 10;
  const long long scaled = std::llround(number * static_cast<double>(power));
  const long long whole = std::abs(scaled) / power, fraction = std::abs(scaled) % power;
  std::string text = scaled < 0 ? "-" : "";
  if (whole > 0 || fraction == 0) text += decimal(whole);
  if (fraction > 0) {
    std::string decimals = decimal(power + fraction).substr(1);
    while (decimals.back() == '0') decimals.pop_back();
    text += "." + decimals;
  }
  return text;
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : valid_utf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (byte >= 0x20 || c == '\n' || c == '\t') {
      escaped += c;
    }
  }
  return escaped;
}

std::string svg_head(double width, double height, std::string_view title) {
  const std::string w = to_text(width), h = to_text(height);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" width=\"" +
         w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + ' ' + h + "\" role=\"img\">\n<title>" +
         xml_escaped(title) + "</title>\n";
}

std::string short_identifier(long long number) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  constexpr auto kBase = static_cast<long long>(kLetters.size());
  std::string text;
  for (; number >= kBase; number = number / kBase - 1) text += kLetters[number % kBase];
  return text += kLetters[number];
}

}  // namespace quadrille
