#pragma once

#include <ostream>
#include <string>
#include <unordered_map>
#include <vector>

#include "svg_detail.h"
#include "svg_gradient.h"
#include "svg_path.h"

namespace quadrille {

/// Writes cells as SVG paths. Successive cells of one flat colour become one path, equal gradients
/// one element.
class SvgCellWriter {
 public:
  SvgCellWriter(std::ostream& out, const SvgDetail& detail)
      : out_(out), units_(detail.units_per_pixel), flat_path_(units_) {}
  void add(const std::vector<SvgOutline>& outlines, const CellFill& fill);
  /// Ends the open path; to be called before anything else is written to the stream.
  void finish();

 private:
  std::string gradient_id(const LinearGradient& gradient);
  /// Gradients of one direction and range take them from one element.
  std::string vector_id(const GradientVector& vector);

  std::ostream& out_;
  int units_;
  std::string flat_color_;  ///< of the open path; empty when there is none
  SvgPathData flat_path_;
  std::unordered_map<std::string, std::string> gradients_;  ///< definition to identifier
  std::unordered_map<std::string, std::string> vectors_;    ///< attributes to identifier
  long long id_count_ = 0;
};

}  // namespace quadrille
