#include "svg_cell_writer.h"

#include "svg_text.h"

namespace quadrille {
namespace {

/// Equal gradients are found among this many recent ones.
constexpr std::size_t kRemembered = 4096;
/// A path of one colour is ended when its data is longer than this, in bytes.
constexpr std::size_t kLongestFlatPath = 1 << 16;

std::string hex(const LinearGradient::Rgb& rgb) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t value : rgb) {
    text += kDigits[value >> 4];
    text += kDigits[value & 15];
  }
  return text;
}

/// The attributes of a gradient vector that differ from what they are when left out.
std::string attributes_of(const GradientVector& v) {
  std::string text;
  const auto add = [&](const char* name, double value, const char* usual) {
    const std::string number = to_short_text(value, 4);
    if (number != usual) text += std::string(" ") + name + "=\"" + number + "\"";
  };
  add("x1", v.from.x(), "0");
  add("y1", v.from.y(), "0");
  add("x2", v.to.x(), "1");
  add("y2", v.to.y(), "0");
  return text;
}

std::string stops_of(const LinearGradient& g) {
  std::string text;
  for (int k = 0; k < g.stop_count; ++k) {
    text += "<stop offset=\"" + to_short_text(g.stops[k].offset, 2) + "\" stop-color=\"" +
            hex(g.stops[k].color) + "\"/>";
  }
  return text;
}

}  // namespace

void SvgCellWriter::add(const std::vector<SvgOutline>& outlines, const CellFill& fill) {
  if (fill.base.stop_count == 1) {
    const std::string color = hex(fill.base.stops[0].color);
    if (color != flat_color_ || flat_path_.text().size() > kLongestFlatPath) finish();
    flat_color_ = color;
    for (const SvgOutline& outline : outlines) flat_path_.append(outline);
    return;
  }
  finish();
  SvgPathData path(units_);
  for (const SvgOutline& outline : outlines) path.append(outline);
  const std::string base = gradient_id(fill.base);
  const bool layered = fill.overlay_opacity > 0;
  const std::string overlay = layered ? gradient_id(fill.overlay) : "";
  out_ << "<path fill=\"url(#" << base << ")\" d=\"" << path.text() << "\"/>\n";
  if (!layered) return;
  out_ << "<path fill=\"url(#" << overlay << ")\" d=\"" << path.text() << "\" fill-opacity=\""
       << to_short_text(fill.overlay_opacity, 2) << "\"/>\n";
}

void SvgCellWriter::finish() {
  if (flat_color_.empty()) return;
  out_ << "<path fill=\"" << flat_color_ << "\" d=\"" << flat_path_.text() << "\"/>\n";
  flat_color_.clear();
  flat_path_ = SvgPathData(units_);
}

std::string SvgCellWriter::gradient_id(const LinearGradient& gradient) {
  const std::string body =
      (gradient.vector.is_common ? " xlink:href=\"#" + vector_id(gradient.vector) + "\""
                                 : attributes_of(gradient.vector)) +
      ">" + stops_of(gradient);
  if (gradients_.size() >= kRemembered) gradients_.clear();
  const auto [entry, is_new] = gradients_.try_emplace(body);
  if (is_new) {
    entry->second = short_identifier(id_count_++);
    out_ << "<linearGradient id=\"" << entry->second << "\"" << body << "</linearGradient>\n";
  }
  return entry->second;
}

std::string SvgCellWriter::vector_id(const GradientVector& vector) {
  const auto [entry, is_new] = vectors_.try_emplace(attributes_of(vector));
  if (is_new) {
    entry->second = short_identifier(id_count_++);
    out_ << "<linearGradient id=\"" << entry->second << "\"" << entry->first << "/>\n";
  }
  return entry->second;
}

}  // namespace quadrille
