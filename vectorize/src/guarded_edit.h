#pragma once

#include <Eigen/Core>
#include <vector>

#include "face_mesh.h"

namespace quadrille {

/// The smallest corner sine of a face, less in proportion where its longest side is more than three
/// times its shortest.
double face_quality(const FaceMesh& mesh, const Face& face);

/// Edits a face mesh under a guard on the shape.
class GuardedEditor {
 public:
  explicit GuardedEditor(FaceMesh& mesh) : mesh_(mesh), anchors_(mesh.points) {}

  /// Carries out the edit and smooths the vertices it touches, held back by springs to where they
  /// were at first. False, and nothing changed, when the result is no mesh or the faces around lack
  /// more of a good quality than before.
  bool attempt(FaceEdit edit);

 private:
  FaceMesh& mesh_;
  std::vector<Eigen::Vector2d> anchors_;  // springs of the points
  std::vector<int> touched_;
  std::vector<Eigen::Vector2d> saved_;  // positions of the touched
  std::vector<StarWedge> wedges_;

  void note_touched(const FaceEdit& edit);
  /// Sum over the faces around of the square of what their quality lacks to a good one.
  double badness_around() const;
  void smooth();
};

}  // namespace quadrille
