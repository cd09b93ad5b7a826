#pragma once

#include <string>

#include "quadrille/vector_image.h"

namespace quadrille {

/// The layer alone as a quantised document (.quad) in base64 (RFC 4648): the control data of its
/// patches, 5 to 13 bytes for each.
std::string control_document(const VectorImage& image, const Layer& layer);

}  // namespace quadrille
