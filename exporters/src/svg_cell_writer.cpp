#include "svg_cell_writer.h"

#include <cmath>

#include "svg_text.h"

namespace quadrille {
namespace {

/// Equal gradients are found among this many recent ones.
constexpr std::size_t kRemembered = 4096;
/// Decimals of gradient vectors, in parts of the cell's bounds.
constexpr int kVectorDigits = 2;

std::string hex(const GradientFill::Rgb& rgb) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t value : rgb) {
    text += kDigits[value >> 4];
    text += kDigits[value & 15];
  }
  return text;
}

/// The gradient vector in units of the bounding box (objectBoundingBox, the default), where it is
/// short to write. The gradient is an affine function of the position, 0 at the first stop and 1 at
/// the last; it stays one in the box. Lines of equal colour are free to slide along, so that the
/// vector may start on an axis of the box.
std::string vector_of(const GradientFill& fill, const Eigen::AlignedBox2d& bounds) {
  const Eigen::Vector2d along = fill.to - fill.from;
  const Eigen::Vector2d slope = (along / along.squaredNorm()).cwiseProduct(bounds.sizes());
  const double at_origin = along.dot(bounds.min() - fill.from) / along.squaredNorm();
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  const int axis = std::abs(slope.x()) >= std::abs(slope.y()) ? 0 : 1;
  first[axis] = -at_origin / slope[axis];
  const Eigen::Vector2d last = first + slope / slope.squaredNorm();

  std::string text;
  const auto add = [&](const char* name, double value, const char* preset) {
    const std::string number = to_short_text(value, kVectorDigits);
    if (number != preset) text += std::string(" ") + name + "=\"" + number + "\"";
  };
  add("x1", first.x(), "0");
  add("y1", first.y(), "0");
  add("x2", last.x(), "1");
  add("y2", last.y(), "0");
  return text;
}

std::string stops_of(const GradientFill& fill) {
  std::string text;
  for (int k = 0; k < fill.stop_count; ++k) {
    text += "<stop offset=\"" + to_short_text(double(k) / (fill.stop_count - 1), 3) +
            "\" stop-color=\"" + hex(fill.stops[k]) + "\"/>";
  }
  return text;
}

}  // namespace

void SvgCellWriter::add(const SvgOutline& outline, const GradientFill& fill) {
  if (fill.stop_count == 1) {
    const std::string color = hex(fill.stops[0]);
    if (color != flat_color_) finish();
    flat_color_ = color;
    flat_path_.append(outline);
    return;
  }
  finish();
  SvgPathData path;
  path.append(outline);
  const std::string id = gradient_id(fill, path.bounds());
  out_ << "<path fill=\"url(#" << id << ")\" d=\"" << path.text() << "\"/>\n";
}

void SvgCellWriter::finish() {
  if (flat_color_.empty()) return;
  out_ << "<path fill=\"" << flat_color_ << "\" d=\"" << flat_path_.text() << "\"/>\n";
  flat_color_.clear();
  flat_path_ = {};
}

std::string SvgCellWriter::gradient_id(const GradientFill& fill,
                                       const Eigen::AlignedBox2d& bounds) {
  const std::string body = vector_of(fill, bounds) + ">" + stops_of(fill);
  if (gradients_.size() >= kRemembered) gradients_.clear();
  const auto [entry, is_new] = gradients_.try_emplace(body);
  if (is_new) {
    entry->second = short_identifier(gradient_count_++);
    out_ << "<linearGradient id=\"" << entry->second << "\"" << body << "</linearGradient>\n";
  }
  return entry->second;
}

}  // namespace quadrille
