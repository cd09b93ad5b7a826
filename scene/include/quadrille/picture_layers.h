#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "quadrille/raster.h"
#include "quadrille/run_context.h"
#include "quadrille/scene_layer.h"
#include "quadrille/scene_window.h"

namespace quadrille {

/// Layers that show a picture and its patches. Vertices, curves and control points are placed by
/// the transforms of the picture's layers.

/// "picture": the pixels of a raster over [0, width] x [0, height] of the raster.
SceneLayer raster_layer(const Raster& picture);

/// "error": where the drawn picture differs from the source. "difference" is drawn minus source in
/// 0..255 per channel (premultiplied red, green, blue, alpha where one of them has alpha), "error"
/// its root mean square over channels; colours from white (0) to red (32 and more). Throws
/// Error{invalid_argument} when the sizes differ.
SceneLayer error_layer(const Raster& source, const Raster& drawn);

/// "patches": the image itself.
SceneLayer patch_layer(std::shared_ptr<const VectorImage> image, std::vector<float> errors = {});

/// Per patch, layer after layer, the root mean square of the "error" of error_layer() at 8 x 8
/// points of the patch, weighted by area; 0 where a patch lies outside of the picture.
std::vector<float> patch_errors(const VectorImage& image, const SceneGrid& error);

/// "surface": every patch as divisions x divisions quads (1 to 64) with its colours. Neighbours
/// share the points of their edge, so there are no cracks; where colours jump at a tear, each side
/// has points of its own at the same places. Layer k of several lies at height k. Points: "color"
/// (float RGB, or "color_premultiplied" RGBA when something is transparent; unclamped), "rgba"
/// (bytes, straight, clamped). Cells: "patch", "layer", "region". Throws Error{invalid_argument}
/// for divisions out of range and Error{limit_exceeded} for 2^31 points or corners.
SceneLayer surface_layer(const VectorImage& image, int divisions = 4,
                         const RunContext& context = {});

/// "control-net": the Bezier control points, and polylines along the rows and columns of each
/// patch's net; those of an edge once. Cells: "layer".
SceneLayer control_net_layer(const VectorImage& image);

/// "patch-edges": the curves between patches, as 12 pieces each or as the window asks for. Cells:
/// "layer", "edge", "border", "feature", "tear".
SceneLayer edge_layer(const VectorImage& image, const std::optional<SceneWindow>& window = {});

/// "tears": those across which colours may jump. Cells: "layer", "edge".
SceneLayer tear_layer(const VectorImage& image, const std::optional<SceneWindow>& window = {});

/// "irregular-vertices": those inside the mesh whose valence is not 4, up to 3 red, from 5 blue.
/// Points: "vertex", "valence", "layer".
SceneLayer irregular_vertex_layer(const VectorImage& image);
/// The same of a mesh; layer 0.
SceneLayer irregular_vertex_layer(const QuadMesh& mesh);

/// "quads": the straight-edged mesh. Points: "valence", "border". Cells: "quad", "region",
/// "scaled_jacobian".
SceneLayer quad_layer(const QuadMesh& mesh);

/// "patches" or, with a source, "picture", "error" and "patches" with their errors; then "surface",
/// "control-net", "patch-edges", "tears" and "irregular-vertices", as a group "picture". The source
/// has the image's size.
SceneGroup picture_group(std::shared_ptr<const VectorImage> image, const Raster* source = nullptr,
                         const RunContext& context = {});

}  // namespace quadrille
