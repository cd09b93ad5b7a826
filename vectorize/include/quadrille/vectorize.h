#pragma once

#include <vector>

#include "quadrille/alpha_outline.h"
#include "quadrille/cross_field.h"
#include "quadrille/feature_chains.h"
#include "quadrille/feature_snapping.h"
#include "quadrille/fit.h"
#include "quadrille/optimize.h"
#include "quadrille/position_field.h"
#include "quadrille/quad_extraction.h"
#include "quadrille/scale_field.h"
#include "quadrille/tears.h"
#include "quadrille/vector_image.h"
#include "quadrille/working_picture.h"

namespace quadrille {

/// More quads than this are refused.
inline constexpr int kMaxQuads = 2'000'000;

/// Which part of the picture the mesh covers.
enum class MeshRegion {
  whole,   ///< the rectangle
  opaque,  ///< inside alpha_outline(): components, holes and a curved border
};

struct VectorizeOptions {
  /// Wished number of quads, 1 to kMaxQuads; met within 5 % from 200 quads up. Of an opaque region
  /// it is met where the outline can be followed with so few. The fields take some 5 KB a quad.
  int quads = 3000;
  /// A picture without transparent pixels gives the same for both. Loops of the outline below 4
  /// square pixels, and the smallest ones where there are more than quads / 24, are ignored.
  MeshRegion region = MeshRegion::whole;
  /// Where more quads are wished, or empty: a picture of any size, stretched over this one. The
  /// mean of red, green and blue, times alpha, is the density beside that of the picture: twice the
  /// brightness, about twice the quads per area. Black counts as 1/64 of white; a map of a single
  /// brightness changes nothing, and the lattice does not heed it. Replaces ScaleOptions::density.
  Raster density;
  CrossFieldOptions cross_field;
  ScaleOptions scale;
  PositionOptions position;
  ChainOptions chains;
  /// The most vertices on chains, as a share of the mesh's; the weakest chains are left out.
  double chain_share = 0.5;
  /// Chains are followed where the first fit's squared error beside them, per vertex on them, is at
  /// least so many times that of the whole picture per vertex; 0 follows all.
  double least_chain_gain = 1;
  SnapOptions snap;
  /// How many times the picture is meshed again where its fit errs; see refine_by_error().
  int feedback = 1;
  /// Which of the feature edges are torn; off follows no chains.
  TearOptions tears;
  FitOptions fit;
  OptimizeOptions optimize;
  /// Use the plain axis-aligned lattice instead of the fields.
  bool lattice = false;
};

/// The front half's results, each in working pixels but for the mesh.
struct Quadrangulation {
  WorkingPicture working;
  FeatureTensor features;
  CrossField cross;
  ScaleField scale;
  PositionField position;
  ChainNetwork chains;       ///< that the mesh's feature edges follow, source pixels
  QuadMesh mesh;             ///< source pixels
  double lattice_cells = 0;  ///< that the scale and the positions were made for
  /// The axis-aligned lattice took the place of the fields' mesh, because the picture is smaller
  /// than 4 quads a side, because the quads of an opaque region are smaller than a source pixel,
  /// or, for an outline with strands that nearly touch, because no mesh of the fields was valid.
  bool fallback = false;
  /// The border that an opaque region's mesh follows, source pixels; empty for a mesh of the whole.
  std::vector<Loop> outline;
  /// What such a mesh shows: the picture with the colours and the alpha of the inside continued
  /// across the outline. Empty for a mesh of the whole.
  Raster inside;
};

struct VectorizeReport {
  int width = 0, height = 0;  ///< source pixels
  int quads = 0, vertices = 0, irregular_vertices = 0;
  int positive_singularities = 0, negative_singularities = 0;
  double misalignment_degrees = 0;
  std::vector<CrossFieldPhase> cross_field_phases;
  int chains = 0, tears = 0;  ///< chains of feature edges, and those that are torn
  double tear_length = 0;     ///< pixels, along the chords of torn edges
  int folded = 0;             ///< patches whose geometry is not certified fold-free
  bool fallback = false;
  MeshRegion region = MeshRegion::whole;  ///< of the mesh that was made
  int components = 0, holes = 0;          ///< of the mesh
  double outline_length = 0;              ///< pixels, around components and holes
  FitReport fit;
  OptimizeReport optimize;  ///< where patches have many pixels, on a reduced picture
  std::vector<StageReport> stages;
};

struct Vectorization {
  VectorImage image;
  VectorizeReport report;
};

/// Paper section 3: picture to field-aligned pure quad mesh, validated.
/// Throws Error{invalid_argument} for options out of range or a malformed picture or map,
/// Error{limit_exceeded} above kMaxQuads, Error{degenerate_input} for the opaque region of a
/// picture without an opaque pixel, Error{cancelled}.
Quadrangulation quadrangulate(const Raster& picture, const VectorizeOptions& options = {},
                              const RunContext& context = {});

/// Meshes the picture once more, with the same cross field, so that every quad comes to the same
/// error: more quads where `fitted`, a rendering at scale 1 of the picture's fit to the mesh so
/// far, differs from it more, and feature edges along the chains beside which it differs most. A
/// lattice stays as it is; where no new mesh is valid, the one so far is only snapped to features.
/// Throws as quadrangulate() does, and Error{invalid_argument} when the sizes differ.
void refine_by_error(Quadrangulation& quads, const Raster& picture, const Raster& fitted,
                     const VectorizeOptions& options, const RunContext& context = {});

/// The whole way: quadrangulate, then the steps of fit_patches() and optimize_vertices(), each
/// reported as a stage. When `stages` is not null, it receives what the patches were made from, the
/// mesh with its tears and its vertices before they are moved. Throws as these do.
Vectorization vectorize(const Raster& picture, const VectorizeOptions& options = {},
                        const RunContext& context = {}, Quadrangulation* stages = nullptr);

}  // namespace quadrille
