#include "face_cleanup.h"

#include <algorithm>

#include "guarded_edit.h"
#include "polygon_divisions.h"

namespace quadrille {
namespace {

constexpr int kLongestChain = 4;   // faces; 5 remove a little more at twice the cost
constexpr int kTick = 1024;        // faces between two reports
constexpr double kProgress = 0.5;  // of the extraction, when the faces are cleaned up
constexpr int kMostRounds = 2;
constexpr int kMostTries = 6;  // candidates at one place that may fail the guard

class Cleaner {
 public:
  Cleaner(FaceMesh& mesh, const RunContext& context)
      : mesh_(mesh), context_(context), editor_(mesh) {}

  /// Short chains first; true when anything changed.
  bool redivide_all() {
    bool changed = false;
    for (int length = 2; length <= kLongestChain; ++length) {
      for (int f = 0; f < mesh_.face_slots(); ++f) {
        tick(f);
        // Two faces exchange an edge; longer chains bring triangles together.
        const bool is_start = length == 2 ? is_irregular(f) : mesh_.face(f).size == 3;
        if (is_start) changed = redivide(f, length) || changed;
      }
    }
    return changed;
  }

  bool collapse_all() {
    bool changed = false;
    for (int f = 0; f < mesh_.face_slots(); ++f) {
      tick(f);
      if (is_irregular(f)) changed = collapse(f) || changed;
    }
    return changed;
  }

 private:
  struct Candidate {
    int change;      // of the irregularity
    double quality;  // of the worst face before smoothing
    FaceEdit edit;
  };

  FaceMesh& mesh_;
  const RunContext& context_;
  GuardedEditor editor_;
  std::vector<int> chain_, outline_;
  std::vector<Candidate> candidates_;

  /// Lets the observer cancel.
  void tick(int f) const {
    if (f % kTick == 0) context_.progress("quads", kProgress);
  }

  bool redivide(int f, int length) {
    const Face& face = mesh_.face(f);
    chain_.assign(1, f);
    outline_.assign(face.vertex.begin(), face.vertex.begin() + face.size);
    candidates_.clear();
    extend_chain(length);
    return carry_out_best();
  }

  bool collapse(int f) {
    const Face face = mesh_.face(f);
    candidates_.clear();
    for (int k = 0; k < face.size; ++k) consider_merge(face[k], face.after(k));
    if (face.size == 4) {
      consider_merge(face[0], face[2]);
      consider_merge(face[1], face[3]);
    }
    return carry_out_best();
  }

  bool is_irregular(int f) const {
    const Face& face = mesh_.face(f);
    return face.size == 3 || std::any_of(face.vertex.begin(), face.vertex.begin() + face.size,
                                         [&](int v) { return mesh_.excess(v) != 0; });
  }

  bool carry_out_best() {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) {
                       return a.change != b.change ? a.change < b.change : a.quality > b.quality;
                     });
    const int tries = std::min(kMostTries, static_cast<int>(candidates_.size()));
    for (int i = 0; i < tries; ++i) {
      if (editor_.attempt(std::move(candidates_[i].edit))) return true;
    }
    return false;
  }

  /// Lengthens the chain in all ways and considers the re-divisions of those of the wished length.
  void extend_chain(int length) {
    if (static_cast<int>(chain_.size()) == length) {
      consider_divisions();
      return;
    }
    const int last = chain_.back();
    for (int k = 0; k < mesh_.face(last).size; ++k) {
      const int next = mesh_.across(last, k);
      if (next < 0 || mesh_.is_kept(mesh_.face(last)[k], mesh_.face(last).after(k))) continue;
      if (!attach(next, mesh_.face(last)[k], mesh_.face(last).after(k))) continue;
      chain_.push_back(next);
      extend_chain(length);
      chain_.pop_back();
      detach(next, mesh_.face(last)[k]);
    }
  }

  /// Extends the outline by a face across its side from a to b. False, and nothing changed, when
  /// that is no side of the outline or the face touches the outline elsewhere.
  bool attach(int f, int a, int b) {
    const auto at = std::find(outline_.begin(), outline_.end(), a);
    if (at == outline_.end()) return false;
    const auto i = at - outline_.begin();
    if (outline_[(i + 1) % outline_.size()] != b) return false;
    const Face& face = mesh_.face(f);
    std::array<int, 2> fresh{};
    int corner = face.corner_of(a);
    for (int n = 0; n + 2 < face.size; ++n) {
      corner = corner + 1 == face.size ? 0 : corner + 1;
      fresh[n] = face[corner];
      if (std::find(outline_.begin(), outline_.end(), fresh[n]) != outline_.end()) return false;
    }
    outline_.insert(outline_.begin() + i + 1, fresh.begin(), fresh.begin() + face.size - 2);
    return true;
  }

  void detach(int f, int a) {
    const auto first = std::find(outline_.begin(), outline_.end(), a) + 1;
    outline_.erase(first, first + mesh_.face(f).size - 2);
  }

  void consider_divisions() {
    const int n = static_cast<int>(outline_.size());
    std::array<int, kMostDivided> outside{};  // excess by the faces outside the chain
    int before = 0;
    for (const int f : chain_) before += mesh_.face(f).size == 3;
    for (int i = 0; i < n; ++i) {
      const int excess = mesh_.excess(outline_[i]);
      before += mesh_.penalty(outline_[i], excess);
      outside[i] = excess;
      for (const int f : chain_) outside[i] -= mesh_.face(f).corner_of(outline_[i]) >= 0;
    }
    if (before < 2) return;
    for (const PolygonDivision& division : polygon_divisions(n)) {
      int after = n % 2;
      for (int i = 0; i < n; ++i) {
        after += mesh_.penalty(outline_[i], outside[i] + division.pieces_at[i]);
      }
      if (after < before) add_division(division, after - before);
    }
  }

  void add_division(const PolygonDivision& division, int change) {
    Candidate candidate{change, 1, {chain_, {}, {}}};
    for (const PolygonDivision::Piece& piece : division.pieces) {
      Face face;
      face.size = piece.size;
      for (int k = 0; k < piece.size; ++k) face.vertex[k] = outline_[piece.corner[k]];
      candidate.quality = std::min(candidate.quality, face_quality(mesh_, face));
      candidate.edit.added.push_back(face);
    }
    candidates_.push_back(std::move(candidate));
  }

  void consider_merge(int a, int b) {
    FaceEdit edit;
    edit.merged.push_back({a, b});
    if (!mesh_.complete_merges(edit)) return;
    const int change = mesh_.irregularity_change(edit);
    if (change < 0) candidates_.push_back({change, 0, std::move(edit)});
  }
};

}  // namespace

void clean_up(FaceMesh& mesh, const RunContext& context) {
  Cleaner cleaner(mesh, context);
  for (int round = 0; round < kMostRounds && cleaner.redivide_all(); ++round) {
  }
  if (cleaner.collapse_all()) cleaner.redivide_all();
}

}  // namespace quadrille
