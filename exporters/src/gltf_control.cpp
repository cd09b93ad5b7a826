#include "gltf_control.h"

#include <glib.h>

#include <memory>

#include "quadrille/document.h"

namespace quadrille {

std::string control_document(const VectorImage& image, const Layer& layer) {
  const VectorImage alone{image.width, image.height, {layer}, {}};
  const std::vector<std::byte> bytes = to_document(alone);
  const std::unique_ptr<gchar, decltype(&g_free)> text(
      g_base64_encode(reinterpret_cast<const guchar*>(bytes.data()), bytes.size()), g_free);
  return text.get();
}

}  // namespace quadrille
