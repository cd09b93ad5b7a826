#include "quadrille/render.h"

#include "output_frame.h"
#include "quadrille/renderer.h"

namespace quadrille {

Raster render(const VectorImage& image, const RenderOptions& options, const RunContext& context) {
  const PixelRegion region = output_frame(image, options).region;
  Renderer renderer(image);
  Raster output(region.width, region.height, renderer.opaque(options) ? 3 : 4);
  renderer.draw(options, {SampleType::float32, output.channels},
                {output.data.data(),
                 static_cast<std::ptrdiff_t>(sizeof(float)) * output.channels * region.width},
                context);
  return output;
}

}  // namespace quadrille
