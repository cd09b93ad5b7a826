#pragma once

#include "quadrille/raster.h"

namespace quadrille {

/// The picture as its opaque part (alpha_outline()) shows it, for a mesh that ends at the outline:
/// pixels outside take the colour of the nearest one inside, and pixels within two of the outline
/// take the largest alpha within two pixels, so that the anti-aliased rim does not make the mesh
/// transparent there. Without an alpha channel when nothing inside is translucent then. The picture
/// has at least one opaque pixel.
Raster opaque_picture(const Raster& picture);

}  // namespace quadrille
