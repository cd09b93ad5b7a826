#include "svg_path.h"

#include <cmath>

#include "svg_text.h"

namespace quadrille {
namespace {

/// Extends the box by the points where a coordinate of the cubic has its extremes.
void extend(Eigen::AlignedBox2d& box, const PlaneCurve& p) {
  const BicubicBezier<Eigen::Vector2d> strip{{p, p, p, p}};
  for (int axis = 0; axis < 2; ++axis) {
    const double d0 = p[1][axis] - p[0][axis], d1 = p[2][axis] - p[1][axis],
                 d2 = p[3][axis] - p[2][axis];
    const double a = d0 - 2 * d1 + d2, b = d0 - d1, discriminant = b * b - a * d0;
    if (discriminant < 0) continue;
    // The stable form of the roots of a t^2 - 2 b t + d0.
    const double sum = b + std::copysign(std::sqrt(discriminant), b);
    for (const double t : {sum / a, d0 / sum}) {
      if (t > 0 && t < 1) box.extend(strip.at(t, 0));
    }
  }
}

}  // namespace

SvgPathData::Point SvgPathData::to_exact(const Eigen::Vector2d& p, bool is_exact) const {
  const int step = is_exact ? 1 : kExact;
  const double scale = double(units_) * kExact / step;
  return {step * std::llround(p.x() * scale), step * std::llround(p.y() * scale)};
}

void SvgPathData::append(const SvgOutline& outline) {
  if (outline.pieces.empty()) return;
  const Point start = to_exact(outline.start, outline.pieces.back().is_exact);
  command_ = 0;  // each subpath says its own m
  write('m', {start - at_});
  at_ = start;
  bounds_.extend(start.cast<double>());
  for (std::size_t i = 0; i < outline.pieces.size(); ++i) {
    const SvgOutline::Piece& piece = outline.pieces[i];
    const Point end = to_exact(piece.end, piece.is_exact);
    const bool closes = i + 1 == outline.pieces.size() && end == start;  // as filling does
    if (!piece.is_line) {
      cubic_to(to_exact(piece.control1, true), to_exact(piece.control2, true), end);
    } else if (end != at_ && !closes) {
      line_to(end);
    }
  }
}

Eigen::AlignedBox2d SvgPathData::bounds() const {
  const double scale = 1.0 / (units_ * kExact);
  return {bounds_.min() * scale, bounds_.max() * scale};
}

void SvgPathData::line_to(const Point& target) {
  const Point by = target - at_;
  if (by.x() != 0 && by.y() != 0) {
    write('l', {by});
  } else {
    const char command = by.y() == 0 ? 'h' : 'v';
    const bool repeated = command == command_;
    if (!repeated) text_ += command_ = command;
    write_number(by.y() == 0 ? by.x() : by.y(), repeated);
  }
  at_ = target;
  bounds_.extend(target.cast<double>());
}

void SvgPathData::cubic_to(const Point& control1, const Point& control2, const Point& end) {
  write('c', {control1 - at_, control2 - at_, end - at_});
  extend(bounds_, {at_.cast<double>(), control1.cast<double>(), control2.cast<double>(),
                   end.cast<double>()});
  at_ = end;
  bounds_.extend(end.cast<double>());
}

void SvgPathData::write(char command, std::initializer_list<Point> points) {
  // Pairs after those of an m are an l's.
  const bool implied = command == command_ || (command == 'l' && command_ == 'm');
  if (!implied) text_ += command_ = command;
  bool separate = implied;
  for (const Point& p : points) {
    write_number(p.x(), separate);
    write_number(p.y(), true);
    separate = true;
  }
}

void SvgPathData::write_number(long long number, bool separate) {
  if (separate && number >= 0) text_ += ' ';
  text_ += to_short_text(double(number) / kExact, 3);
}

}  // namespace quadrille
