#include "guarded_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadrille/remove_duplicates.h"

namespace quadrille {
namespace {

using Eigen::Vector2d;

constexpr double kGoodQuality = 0.5;  // what faces lack to it counts
constexpr double kGoodAspect = 3;
constexpr double kHold = 5;  // strong: free vertices wander off the features and blur the picture
constexpr int kSweeps = 3;

}  // namespace

double face_quality(const FaceMesh& mesh, const Face& face) {
  double smallest = 1, shortest2 = std::numeric_limits<double>::max(), longest2 = 0;
  for (int k = 0; k < face.size; ++k) {
    const Vector2d& p = mesh.points[face[k]];
    const Vector2d a = mesh.points[face.after(k)] - p, b = mesh.points[face.before(k)] - p;
    const double aa = a.squaredNorm(), bb = b.squaredNorm();
    if (aa == 0 || bb == 0) return -1;
    smallest = std::min(smallest, (a.x() * b.y() - a.y() * b.x()) / std::sqrt(aa * bb));
    shortest2 = std::min(shortest2, aa);
    longest2 = std::max(longest2, aa);
  }
  if (smallest <= 0) return smallest;
  return smallest * std::min(1.0, kGoodAspect * std::sqrt(shortest2 / longest2));
}

void GuardedEditor::note_touched(const FaceEdit& edit) {
  touched_.clear();
  const auto add = [&](const Face& face) {
    touched_.insert(touched_.end(), face.vertex.begin(), face.vertex.begin() + face.size);
  };
  for (const int f : edit.removed) add(mesh_.face(f));
  for (const Face& face : edit.added) add(face);
  remove_duplicates(touched_);
  saved_.clear();
  for (const int v : touched_) saved_.push_back(mesh_.points[v]);
}

double GuardedEditor::badness_around() const {
  std::vector<int> faces;
  for (const int v : touched_) {
    faces.insert(faces.end(), mesh_.faces_at(v).begin(), mesh_.faces_at(v).end());
  }
  remove_duplicates(faces);
  double sum = 0;
  for (const int f : faces) {
    const double lacking = std::max(0.0, kGoodQuality - face_quality(mesh_, mesh_.face(f)));
    sum += lacking * lacking;
  }
  return sum;
}

void GuardedEditor::smooth() {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const int v : touched_) {
      if (mesh_.faces_at(v).empty()) continue;
      mesh_.collect_star(v, wedges_);
      mesh_.points[v] =
          VertexStar(wedges_).improved(mesh_.points[v], mesh_.guides[v], anchors_[v], kHold);
    }
  }
}

bool GuardedEditor::attempt(FaceEdit edit) {
  note_touched(edit);
  const double before = badness_around();
  if (mesh_.apply(edit)) {
    for (const FaceEdit::Merge& m : edit.merged) {
      if (mesh_.guides[m.kept].kind != mesh_.guides[m.gone].kind) continue;
      mesh_.points[m.kept] = 0.5 * (mesh_.points[m.kept] + mesh_.points[m.gone]);
    }
    smooth();
    if (badness_around() <= before) {
      for (const FaceEdit::Merge& m : edit.merged) anchors_[m.kept] = mesh_.points[m.kept];
      return true;
    }
    mesh_.apply(edit);
  }
  for (std::size_t i = 0; i < touched_.size(); ++i) mesh_.points[touched_[i]] = saved_[i];
  return false;
}

}  // namespace quadrille
