#include "window_pixels.h"

#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

namespace quadrille::viewer {

Raster window_pixels(vtkRenderWindow* window) {
  const int* size = window->GetSize();
  Raster picture(size[0], size[1], 3);
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, /*front=*/0, bytes);
  for (int y = 0; y < picture.height; ++y) {
    // VTK's rows begin at the bottom.
    const vtkIdType row = 3 * static_cast<vtkIdType>(picture.width) * (picture.height - 1 - y);
    for (int i = 0; i < 3 * picture.width; ++i) {
      picture.pixel(0, y)[i] = bytes->GetValue(row + i) / 255.0f;
    }
  }
  return picture;
}

}  // namespace quadrille::viewer
